// SPDX-License-Identifier: MIT
#include "dynamic_filter/bag.hpp"

#include "support/bag_support.hpp"

namespace dynamic_filter::io {
namespace bag_writers_test {

class Kinds : public testing::TestWithParam<std::string> {
protected:
    [[nodiscard]] std::filesystem::path path() const { return folder_ / ("a" + GetParam()); }
    [[nodiscard]] std::vector<WrittenMessage> messages(std::size_t rounds,
                                                       std::size_t points) const {
        return some_messages(encoding_of(GetParam()), rounds, points);
    }
    [[nodiscard]] bool is_empty() const { return std::filesystem::is_empty(folder_.path()); }
    TemporaryFolder folder_;
};

TEST_P(Kinds, GiveBackWhatWasWritten) {
    for (const std::size_t points : {3U, 5000U}) {  // within a chunk, and over several
        const auto written = messages(20, points);
        write_bag(path(), written);
        const ReadBack back = read_all(path());
        EXPECT_TRUE(back.messages == written);
        EXPECT_EQ(back.notes, std::vector<std::string>{});
    }
}

TEST_P(Kinds, AreTheSameBytesEachTime) {
    write_bag(path(), messages(5, 3000));
    const std::string first = slurp(path());
    write_bag(path(), messages(5, 3000));
    EXPECT_TRUE(slurp(path()) == first);
}

TEST_P(Kinds, MayHoldNothing) {
    write_bag(path(), {});
    const ReadBack back = read_all(path());
    EXPECT_TRUE(back.messages.empty());
    EXPECT_TRUE(back.notes.empty());
}

TEST_P(Kinds, MayHoldAMessageWithoutBytes) {
    const std::vector<WrittenMessage> written = {
        {{"/tf", "tf2_msgs/TFMessage", encoding_of(GetParam())}, 0, {}}};
    write_bag(path(), written);
    EXPECT_TRUE(read_all(path()).messages == written);
}

TEST_P(Kinds, LeaveNothingWithoutCommit) {
    {
        const auto writer = BagWriter::create(path());
        for (const WrittenMessage& m : messages(3, 20000))
            writer->write(m.topic, m.time_ns, m.data);
    }
    EXPECT_TRUE(is_empty());
}

TEST_P(Kinds, RefuseWhatTheyCannotHold) {
    const MessageEncoding encoding = encoding_of(GetParam());
    const MessageEncoding other =
        encoding == MessageEncoding::cdr ? MessageEncoding::ros1 : MessageEncoding::cdr;
    const auto writer = BagWriter::create(path());
    EXPECT_EQ(writer->encoding(), encoding);
    const auto error = [&](const Topic& topic, std::int64_t time) {
        return error_of<OutputError>([&] { writer->write(topic, time, {}); });
    };
    writer->write({"/a", "nav_msgs/Odometry", encoding}, 1, {});
    EXPECT_HAS(error({"/a", "tf2_msgs/TFMessage", encoding}, 1), "already");
    EXPECT_HAS(error({"/b", "std_msgs/Int8", encoding}, 1), "std_msgs/Int8 is not known");
    EXPECT_HAS(error({"/c", "nav_msgs/Odometry", other}, 1), "the encoding of ROS");
    EXPECT_HAS(error({"/a", "nav_msgs/Odometry", encoding}, -1), "before 1970");
}

TEST_P(Kinds, SayWhyTheyCannotBeCreated) {
    EXPECT_HAS(
        error_of<OutputError>([&] { (void)BagWriter::create(folder_ / ("none/a" + GetParam())); }),
        "No such file");
}

INSTANTIATE_TEST_SUITE_P(BagWriter, Kinds, testing::Values(".mcap", ".bag", ".db3"),
                         [](const auto& kind) { return kind.param.substr(1); });

TEST(BagWriter, KnowsItsExtensions) {
    EXPECT_HAS(error_of<ConfigError>([] { (void)BagWriter::create("a.pcd"); }), ".mcap");
}

}  // namespace bag_writers_test
}  // namespace dynamic_filter::io
