// SPDX-License-Identifier: MIT
#include "dynamic_filter/io/bag_writer.hpp"
#include "io/bag_support.hpp"

namespace dynamic_filter::io {
namespace {

TEST(Rosbag1Writer, HasNoTimesAfter2106) {
    const TemporaryFolder folder;
    const auto writer = BagWriter::create(folder / "a.bag");
    EXPECT_THROW(writer->write({"/a", "nav_msgs/Odometry", MessageEncoding::ros1},
                               std::int64_t{1} << 62U, {}),
                 OutputError);
}

// Version 2.0: the line, then the record of the file with the place of the index and two counts.
TEST(Rosbag1Writer, BeginsWithTheRecordThatLeadsToTheIndex) {
    const TemporaryFolder folder;
    const auto messages = some_messages(MessageEncoding::ros1, 2, 3);
    std::set<std::string> topics;
    for (const Written& message : messages) topics.insert(message.topic.name);
    const std::size_t connections = topics.size();
    write_bag(folder / "a.bag", messages);
    const std::string bytes = slurp(folder / "a.bag");
    EXPECT_EQ(bytes.substr(0, 13), "#ROSBAG V2.0\n");
    const auto value = [&]<class T>(const std::string& key, T) {
        T number{};
        const std::size_t at = bytes.find(key) + key.size();
        std::memcpy(&number, bytes.data() + at, sizeof number);
        return number;
    };
    EXPECT_EQ(value("op=", std::uint8_t{}), 3);  // the record of the file
    EXPECT_EQ(value("conn_count=", std::uint32_t{}), connections);
    EXPECT_EQ(value("chunk_count=", std::uint32_t{}), 1U);
    const auto index = value("index_pos=", std::uint64_t{});
    ASSERT_LT(index, bytes.size());
    // There the connections are repeated: records with op 7.
    EXPECT_NE(bytes.substr(index, 200).find("op=\x07"), std::string::npos);
}

}  // namespace
}  // namespace dynamic_filter::io
