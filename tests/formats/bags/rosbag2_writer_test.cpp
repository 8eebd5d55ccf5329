// SPDX-License-Identifier: MIT
// The tables of a ROS 2 bag, read with SQLite alone.
#include <sqlite3.h>

#include "formats/messages/definitions.hpp"
#include "support/bag_support.hpp"

namespace dynamic_filter::io {
namespace rosbag2_writer_test {

const Topic odom{"/odom", "nav_msgs/Odometry", MessageEncoding::cdr};
const Topic slam{"/slam", "nav_msgs/Odometry", MessageEncoding::cdr};
const Topic tf{"/tf_static", "tf2_msgs/TFMessage", MessageEncoding::cdr};

using Row = std::vector<std::string>;
using Rows = std::vector<Row>;

class Rosbag2WriterTest : public testing::Test {
protected:
    void SetUp() override {
        const std::vector<std::byte> data = {std::byte{0}, std::byte{0xAB}};
        write_bag(path(), {{odom, 50, data}, {tf, 20, {}}, {slam, 0, data}, {odom, 40, data}});
    }
    [[nodiscard]] std::filesystem::path path() const { return folder_ / "a.db3"; }
    /// All values as text, those of NULL as "NULL".
    [[nodiscard]] Rows rows(const std::string& query) const {
        sqlite3* database = nullptr;
        EXPECT_EQ(sqlite3_open_v2(path().c_str(), &database, SQLITE_OPEN_READONLY, nullptr),
                  SQLITE_OK);
        Rows all;
        const auto add = [](void* to, int count, char** values, char**) {
            Row row;
            for (int i = 0; i < count; ++i) row.emplace_back(values[i] ? values[i] : "NULL");
            static_cast<Rows*>(to)->push_back(row);
            return 0;
        };
        EXPECT_EQ(sqlite3_exec(database, query.c_str(), add, &all, nullptr), SQLITE_OK)
            << sqlite3_errmsg(database);
        sqlite3_close(database);
        return all;
    }
    TemporaryFolder folder_;
};

TEST_F(Rosbag2WriterTest, TheSchemaIsOfVersion4) {
    EXPECT_EQ(rows("SELECT * FROM schema"), (Rows{{"4", "unknown"}}));
    EXPECT_EQ(rows("SELECT COUNT(*) FROM metadata"), (Rows{{"0"}}));
    EXPECT_EQ(rows("SELECT name, tbl_name FROM sqlite_master WHERE type = 'index'"),
              (Rows{{"timestamp_idx", "messages"}}));
    EXPECT_EQ(rows("PRAGMA integrity_check"), (Rows{{"ok"}}));
}

TEST_F(Rosbag2WriterTest, TopicsAreInTheOrderOfTheirFirstUse) {
    EXPECT_EQ(rows("SELECT id, name, type, serialization_format, type_description_hash, "
                   "offered_qos_profiles FROM topics"),
              (Rows{{"1", "/odom", "nav_msgs/msg/Odometry", "cdr", "", offered_qos(odom)},
                    {"2", "/tf_static", "tf2_msgs/msg/TFMessage", "cdr", "", offered_qos(tf)},
                    {"3", "/slam", "nav_msgs/msg/Odometry", "cdr", "", offered_qos(slam)}}));
}

TEST_F(Rosbag2WriterTest, EachTypeIsDefinedOnce) {
    const auto definition = [](const Topic& topic) {
        return full_definition(topic.type, MessageEncoding::cdr);
    };
    EXPECT_EQ(rows("SELECT topic_type, encoding, encoded_message_definition, "
                   "type_description_hash FROM message_definitions"),
              (Rows{{"nav_msgs/msg/Odometry", "ros2msg", definition(odom), ""},
                    {"tf2_msgs/msg/TFMessage", "ros2msg", definition(tf), ""}}));
}

TEST_F(Rosbag2WriterTest, MessagesAreInTheOrderOfWritingAndNeverNull) {
    EXPECT_EQ(rows("SELECT id, topic_id, timestamp, typeof(data), hex(data) FROM messages"),
              (Rows{{"1", "1", "50", "blob", "00AB"},
                    {"2", "2", "20", "blob", ""},
                    {"3", "3", "0", "blob", "00AB"},
                    {"4", "1", "40", "blob", "00AB"}}));
}

TEST_F(Rosbag2WriterTest, OnlyTheFileIsLeft) {
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
        EXPECT_EQ(entry.path(), path());
        ++files;
    }
    EXPECT_EQ(files, 1U);
}

TEST_F(Rosbag2WriterTest, TheFileAppearsWithCommit) {
    std::filesystem::remove(path());
    const auto writer = BagWriter::create(path());
    writer->write(odom, 1, {});
    EXPECT_FALSE(std::filesystem::exists(path()));
    writer->commit();
    EXPECT_EQ(rows("SELECT COUNT(*) FROM messages"), (Rows{{"1"}}));
}

}  // namespace rosbag2_writer_test
}  // namespace dynamic_filter::io
