// SPDX-License-Identifier: MIT
// Records of ROS 1 bags that are wrong: what comes before them is read, and why it ends is said.
#include "support/tiny_bags.hpp"

namespace dynamic_filter::io {
namespace rosbag1_test {

const std::string good =
    rosbag1::connection(0, "/a", "nav_msgs/Odometry") + rosbag1::message(0, 1, "good");

class Rosbag1 : public testing::Test {
protected:
    /// The first note, of a file with one good message before the record.
    [[nodiscard]] std::string note(const std::string& record) const {
        const ReadBack back = read_all(folder_.put("a.bag", rosbag1::file(good + record)));
        EXPECT_EQ(back.messages.size(), 1U);
        return back.notes.empty() ? "" : back.notes.front();
    }
    TemporaryFolder folder_;
};

TEST_F(Rosbag1, HeadersThatAreNone) {
    using namespace rosbag1;
    EXPECT_EQ(note(record(4, "", "an index")), "");
    EXPECT_HAS(note(behind_length(behind_length("no equals")) + behind_length("")), "without '='");
    EXPECT_HAS(note(behind_length(field("conn", "1234")) + behind_length("")), "has no 'op'");
    EXPECT_HAS(note(record(2, field("conn", "1"), "x")), "'conn' is 1 bytes long");
    EXPECT_HAS(note(record(2, conn(0), "x")), "has no 'time'");
    EXPECT_HAS(note(bytes_of(0xFFFFFFFFU) + "x"), "is cut off");
}

/// Not the checksum of the definition but the name says the type, as of the bags of other writers.
TEST_F(Rosbag1, ChecksumsOfDefinitionsAreNotCompared) {
    using namespace rosbag1;
    const std::string data = field("topic", "/b") + field("type", "nav_msgs/Odometry") +
                             field("md5sum", "0123456789abcdef0123456789abcdef");
    const std::string other = record(7, conn(1) + field("topic", "/b"), data);
    const ReadBack back =
        read_all(folder_.put("a.bag", file(good + other + message(1, 2, "other"))));
    ASSERT_EQ(back.messages.size(), 2U);
    EXPECT_EQ(back.messages[1].topic, (Topic{"/b", "nav_msgs/Odometry", MessageEncoding::ros1}));
}

/// bzip2 has checksums of its own.
TEST_F(Rosbag1, ADamagedChunkGivesNothingWrong) {
    std::string bytes = rosbag1::chunk("bz2", std::string(good.size(), ' ') + good);
    const std::size_t packed_at = bytes.find("BZh");
    bytes[packed_at + (bytes.size() - packed_at) / 2] ^= 0x10;
    EXPECT_HAS(note(bytes), "is damaged or cut off");
}

}  // namespace rosbag1_test
}  // namespace dynamic_filter::io
