// SPDX-License-Identifier: MIT
// SQLite bags as ROS 2 leaves them: compressed, older, damaged.
#include <sqlite3.h>

#include <fstream>
#include <thread>

#include "support/tiny_bags.hpp"

namespace dynamic_filter::io {
namespace rosbag2_test {

class Rosbag2 : public testing::Test {
protected:
    [[nodiscard]] std::filesystem::path path() const { return folder_ / "a.db3"; }
    /// The schema of version 1, which later ones only add to.
    void create() const {
        run("CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL, "
            "serialization_format TEXT NOT NULL);"
            "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp "
            "INTEGER NOT NULL, data BLOB NOT NULL);"
            "INSERT INTO topics VALUES (1, '/a', 'nav_msgs/msg/Odometry', 'cdr');");
    }
    void run(const std::string& sql) const {
        sqlite3* database = nullptr;
        ASSERT_EQ(sqlite3_open(path().c_str(), &database), SQLITE_OK);
        EXPECT_EQ(sqlite3_exec(database, sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK)
            << sqlite3_errmsg(database);
        sqlite3_close(database);
    }
    void add(int id, int topic, int time, const std::string& data) const {
        std::string hex;
        for (const char c : data) {
            constexpr const char* kDigits = "0123456789ABCDEF";
            const auto byte = static_cast<unsigned char>(c);
            hex += {kDigits[byte / 16], kDigits[byte % 16]};
        }
        run("INSERT INTO messages VALUES (" + std::to_string(id) + ", " + std::to_string(topic) +
            ", " + std::to_string(time) + ", X'" + hex + "')");
    }
    [[nodiscard]] std::vector<std::string> data() const {
        std::vector<std::string> all;
        for (const WrittenMessage& m : read_all(path()).messages) {
            all.emplace_back(reinterpret_cast<const char*>(m.data.data()), m.data.size());
        }
        return all;
    }
    TemporaryFolder folder_;
};
using Data = std::vector<std::string>;

TEST_F(Rosbag2, InTheOrderOfWriting) {
    create();
    add(1, 1, 50, "first");
    add(2, 1, 10, "second");
    EXPECT_EQ(data(), (Data{"first", "second"}));
    EXPECT_EQ(read_all(path()).messages[1].time_ns, 10);
    EXPECT_EQ(read_all(folder_.path()).messages.size(), 2U);  // a folder without metadata.yaml
}

TEST_F(Rosbag2, MessagesMayBeCompressedEach) {
    create();
    const std::string plain(1000, 'x');
    add(1, 1, 1, packed("zstd", plain));
    add(2, 1, 2, plain);
    EXPECT_EQ(data(), (Data{plain, plain}));
    add(3, 1, 3, packed("zstd", plain).substr(0, 15));
    const ReadBack back = read_all(path());
    EXPECT_EQ(back.messages.size(), 2U);
    EXPECT_HAS(back.notes.at(0), "message 3 is compressed, and damaged");
}

/// As a stream is, whose end the writer did not know when it began.
std::string packed_without_size(const std::string& plain) {
    std::string out(plain.size() + 100, '\0');
    ZSTD_CCtx* context = ZSTD_createCCtx();
    ZSTD_CCtx_setParameter(context, ZSTD_c_contentSizeFlag, 0);
    out.resize(ZSTD_compress2(context, out.data(), out.size(), plain.data(), plain.size()));
    ZSTD_freeCCtx(context);
    return out;
}

TEST_F(Rosbag2, MessagesThatCannotBeHadAreNamed) {
    create();
    add(1, 1, 1, packed_without_size("plain"));
    const Bag bag(path());
    EXPECT_HAS(bag.for_each([](const Message&) { FAIL(); }).at(0).what,
               "does not contain its uncompressed size");
    EXPECT_HAS(error_of([&] { (void)bag.read({0, 0, 1}); }), "(message 1): is compressed");
    EXPECT_HAS(error_of([&] { (void)bag.read({0, 0, 2}); }), "message 2");
}

TEST_F(Rosbag2, TopicsOfAnotherSchema) {
    run("CREATE TABLE topics(id INTEGER PRIMARY KEY)");
    EXPECT_HAS(read_all(path()).notes.at(0), "list of topics is damaged");
}

/// What a recorder has not yet put into the file proper lies in a log beside it.
TEST_F(Rosbag2, ALogBesideItIsReadToo) {
    create();
    sqlite3* recorder = nullptr;
    ASSERT_EQ(sqlite3_open(path().c_str(), &recorder), SQLITE_OK);
    const auto record = [&](const char* sql) {
        ASSERT_EQ(sqlite3_exec(recorder, sql, nullptr, nullptr, nullptr), SQLITE_OK);
    };
    record("PRAGMA journal_mode = WAL");
    record("INSERT INTO messages VALUES (1, 1, 1, 'x')");
    ASSERT_GT(std::filesystem::file_size(path().string() + "-wal"), 0U);
    const std::string before = slurp(path());
    EXPECT_EQ(data(), Data{"x"});
    EXPECT_EQ(slurp(path()), before) << "it was only read";
    sqlite3_close(recorder);
}

TEST_F(Rosbag2, OtherEncodingsAreLeftOut) {
    create();
    run("INSERT INTO topics VALUES (2, '/b', 'Thing', 'json')");
    add(1, 2, 1, "{}");
    add(2, 1, 2, "x");
    EXPECT_EQ(data(), Data{"x"});
}

TEST_F(Rosbag2, ReadingWhileReading) {
    create();
    add(1, 1, 1, "one");
    add(2, 1, 2, "two");
    const Bag bag(path());
    std::size_t same = 0;
    bag.for_each([&](const Message& m) {
        const auto again = bag.read(m.ref);
        same += std::equal(again.begin(), again.end(), m.data.begin(), m.data.end()) ? 1 : 0;
        std::thread([&] { EXPECT_EQ(bag.read(m.ref), again); }).join();
    });
    EXPECT_EQ(same, 2U);
}

TEST_F(Rosbag2, PathsWithSpecialCharacters) {
    create();
    add(1, 1, 1, "x");
    const auto odd = folder_ / "100% of? it #1 ü.db3";
    std::filesystem::rename(path(), odd);
    EXPECT_EQ(read_all(odd).messages.size(), 1U);
}

/// Each page in turn is overwritten: what is read was written, and what is missing is noted.
TEST_F(Rosbag2, DamagedPages) {
    const auto written = some_messages(MessageEncoding::cdr, 20, 50);
    write_bag(path(), written);
    const std::string bytes = slurp(path());
    constexpr std::size_t kPage = 4096;
    std::size_t damaged = 0;
    for (std::size_t at = 0; at < bytes.size(); at += kPage) {
        for (const char filling : {'\0', '\xFF', '\x05'}) {
            std::string changed = bytes;
            changed.replace(at, kPage, std::string(kPage, filling));
            folder_.put("a.db3", changed);
            try {
                const ReadBack back = read_all(path());
                damaged += back.messages.size() < written.size() ? 1 : 0;
                EXPECT_LE(back.messages.size(), written.size());
                if (back.messages.size() < written.size() && filling == '\x05') {
                    EXPECT_FALSE(back.notes.empty()) << "page " << at / kPage;
                }
            } catch (const InputError&) {
            }
        }
    }
    EXPECT_GT(damaged, 0U);
}

TEST_F(Rosbag2, TruncatedFiles) {
    const auto written = some_messages(MessageEncoding::cdr, 20, 50);
    write_bag(path(), written);
    for (std::size_t size = std::filesystem::file_size(path()); size > 1000;) {
        size -= 1000;
        std::filesystem::resize_file(path(), size);
        try {
            const ReadBack back = read_all(path());
            EXPECT_TRUE(back.messages == written || !back.notes.empty()) << size;
        } catch (const InputError&) {
        }
    }
}

}  // namespace rosbag2_test
}  // namespace dynamic_filter::io
