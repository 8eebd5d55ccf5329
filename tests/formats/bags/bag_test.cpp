// SPDX-License-Identifier: MIT
// Bags of other writers, and damaged ones.
#include "dynamic_filter/bag.hpp"

#include <sys/resource.h>

#include <chrono>
#include <fstream>

#include "formats/bags/decompress.hpp"
#include "support/tiny_bags.hpp"

namespace dynamic_filter::io {
namespace bag_test {

const std::string odometry = "nav_msgs/Odometry";

class Bags : public testing::Test {
protected:
    [[nodiscard]] ReadBack read(const std::string& name, const std::string& bytes) const {
        return read_all(folder_.put(name, bytes));
    }
    [[nodiscard]] std::string error(const std::string& name, const std::string& bytes) const {
        return error_of([&] { (void)read(name, bytes); });
    }
    TemporaryFolder folder_;
};

std::string data_of(const WrittenMessage& message) {
    return {reinterpret_cast<const char*>(message.data.data()), message.data.size()};
}
std::vector<std::string> all_data(const ReadBack& back) {
    std::vector<std::string> data;
    for (const WrittenMessage& message : back.messages) data.push_back(data_of(message));
    return data;
}
using Data = std::vector<std::string>;

/// Compresses well, and differs from the others.
std::string data(char letter) { return letter + std::string(300, 'x') + letter; }

/// Two chunks of two messages each; the connection or channel is announced in the first.
std::string two_chunk_mcap(const std::string& kind) {
    return mcap::file(
        mcap::chunk(kind, mcap::schema(1, "nav_msgs/msg/Odometry") + mcap::channel(0, 1, "/a") +
                              mcap::message(0, 10, data('a')) + mcap::message(0, 20, data('b'))) +
        mcap::chunk(kind, mcap::message(0, 30, data('c')) + mcap::message(0, 40, data('d'))));
}
std::string two_chunk_bag(const std::string& kind) {
    return rosbag1::file(rosbag1::chunk(kind, rosbag1::connection(0, "/a", odometry) +
                                                  rosbag1::message(0, 10, data('a')) +
                                                  rosbag1::message(0, 20, data('b'))) +
                         rosbag1::chunk(kind, rosbag1::message(0, 30, data('c')) +
                                                  rosbag1::message(0, 40, data('d'))));
}
const Data four = {data('a'), data('b'), data('c'), data('d')};

TEST_F(Bags, AllCompressionsOfMcap) {
    for (const char* kind : {"", "none", "zstd", "lz4", "lz4 block"}) {
        const ReadBack back = read("a.mcap", two_chunk_mcap(kind));
        EXPECT_EQ(all_data(back), four) << kind;
        EXPECT_EQ(back.notes, Data{});
        EXPECT_EQ(back.messages.at(1).time_ns, 20);
        EXPECT_EQ(back.messages[1].topic, (Topic{"/a", odometry, MessageEncoding::cdr}));
    }
}

TEST_F(Bags, AllCompressionsOfRos1) {
    for (const char* kind : {"none", "lz4", "lz4 block", "bz2"}) {
        const ReadBack back = read("a.bag", two_chunk_bag(kind));
        EXPECT_EQ(all_data(back), four) << kind;
        EXPECT_EQ(back.notes, Data{});
        EXPECT_EQ(back.messages.at(1).time_ns, 20'000'000'000);
        EXPECT_EQ(back.messages[1].topic, (Topic{"/a", odometry, MessageEncoding::ros1}));
    }
    EXPECT_HAS(read("a.bag", two_chunk_bag("snappy")).notes.at(0), "'snappy'; expected");
}

/// Every prefix gives whole messages of those written, in order, and says so if some are missing.
void expect_survives_truncation(const TemporaryFolder& folder, const std::string& name,
                                const std::string& bytes, std::size_t magic) {
    const ReadBack whole = read_all(folder.put(name, bytes));
    ASSERT_EQ(whole.notes, Data{});
    const auto path = folder / name;
    for (std::size_t n = bytes.size(); n-- > 0;) {
        std::filesystem::resize_file(path, n);
        if (n < magic) {
            EXPECT_THROW(Bag{path}, InputError);
            continue;
        }
        const ReadBack back = read_all(path);
        std::size_t next = 0;
        for (const WrittenMessage& message : back.messages) {
            while (next < whole.messages.size() && !(whole.messages[next] == message)) ++next;
            ASSERT_LT(next++, whole.messages.size()) << name << " cut at " << n;
        }
        const bool complete = back.messages.size() == whole.messages.size();
        EXPECT_TRUE(complete || !back.notes.empty()) << name << " cut at " << n;
        EXPECT_TRUE(back.lost || back.notes.size() < 2) << name << " cut at " << n;
    }
}

TEST_F(Bags, EveryTruncation) {
    for (const char* kind : {"", "zstd", "lz4", "lz4 block"}) {
        expect_survives_truncation(folder_, "a.mcap", two_chunk_mcap(kind), 8);
    }
    for (const char* kind : {"none", "lz4", "lz4 block", "bz2"}) {
        expect_survives_truncation(folder_, "a.bag", two_chunk_bag(kind), 13);
    }
}

TEST_F(Bags, EveryTruncationOfWhatIsWritten) {
    for (const char* name : {"a.mcap", "a.bag"}) {
        const auto path = folder_ / name;
        write_bag(path, some_messages(encoding_of(path.extension().string()), 3, 5));
        expect_survives_truncation(folder_, name, slurp(path), name[2] == 'm' ? 8 : 13);
    }
}

/// Whatever byte is changed, and however: an error is one of ours, and of an MCAP file, which has
/// checksums, no changed message is delivered. A ROS 1 bag has none; there are never more messages.
TEST_F(Bags, EveryChangedByte) {
    for (const std::string name : {"a.mcap", "a.bag"}) {
        const std::string bytes = name == "a.bag" ? two_chunk_bag("lz4") : two_chunk_mcap("zstd");
        std::fstream file(folder_.put(name, bytes), std::ios::in | std::ios::out);
        const auto put_byte = [&](std::size_t at, char value) {
            file.seekp(static_cast<std::streamoff>(at)).put(value).flush();
        };
        for (std::size_t n = 0; n < bytes.size(); ++n) {
            for (const int value : {0x00, 0x01, 0x7F, 0x80, 0xFF}) {
                put_byte(n, static_cast<char>(value));
                try {
                    const ReadBack back = read_all(folder_ / name);
                    EXPECT_LE(back.messages.size(), four.size()) << name << " byte " << n;
                    for (const std::string& found : all_data(back)) {
                        const bool known = std::find(four.begin(), four.end(), found) != four.end();
                        EXPECT_TRUE(known || name == "a.bag") << name << " byte " << n;
                    }
                } catch (const InputError&) {
                }
            }
            put_byte(n, bytes[n]);
        }
    }
}

/// A message that was damaged or lost does not pass for a good one: the reader notes it. An MCAP
/// file has a checksum of each chunk, so there no damaged message is delivered at all.
TEST_F(Bags, AChangedByteGivesNoOtherMessageUnnoticed) {
    for (const std::string name : {"a.mcap", "a.bag"}) {
        const auto path = folder_ / name;
        const auto written = some_messages(encoding_of(path.extension().string()), 2, 3);
        write_bag(path, written);
        const std::string bytes = slurp(path);
        const auto is_written = [&](const WrittenMessage& message) {
            return std::any_of(written.begin(), written.end(),
                               [&](const WrittenMessage& w) { return w.data == message.data; });
        };
        std::size_t noted = 0;
        constexpr std::size_t kStep = 3;  // a prime, so that it meets all parts of the records
        for (std::size_t n = 0; n < bytes.size(); n += kStep) {
            std::string changed = bytes;
            changed[n] = static_cast<char>(~changed[n]);
            folder_.put(name, changed);
            try {
                const ReadBack back = read_all(path);
                const bool all_written =
                    std::all_of(back.messages.begin(), back.messages.end(), is_written);
                const bool some_missing =
                    !back.messages.empty() && back.messages.size() < written.size();
                EXPECT_TRUE(all_written || (name == "a.bag" && !back.notes.empty()))
                    << name << " byte " << n;
                EXPECT_TRUE(!some_missing || !back.notes.empty()) << name << " byte " << n;
                noted += back.notes.empty() ? 0 : 1;
            } catch (const InputError& e) {
                EXPECT_HAS(std::string(e.what()), name);
            }
        }
        EXPECT_GT(noted, bytes.size() / kStep / 10) << name;
    }
}

TEST_F(Bags, WithoutIndexNothingIsMissing) {
    for (const char* name : {"a.mcap", "a.bag"}) {
        const auto path = folder_ / name;
        const auto written = some_messages(encoding_of(path.extension().string()), 30, 2000);
        write_bag(path, written);
        std::string bytes = slurp(path);
        if (name[2] == 'm') {
            bytes.resize(bytes.rfind(mcap::record(0x0F, std::string(4, '\0'))));
        } else {
            const std::size_t at = bytes.find("index_pos=") + 10;
            std::uint64_t index_at = 0;
            std::memcpy(&index_at, &bytes[at], sizeof index_at);
            bytes.replace(at, sizeof index_at, std::string(sizeof index_at, '\0'));
            bytes.resize(index_at);
        }
        const ReadBack back = read(name, bytes);
        EXPECT_TRUE(back.messages == written);
        EXPECT_FALSE(back.notes.empty());
    }
}

TEST_F(Bags, AFlippedByteIsNoted) {
    std::string bytes = two_chunk_mcap("");
    bytes[bytes.find(data('c')) + 7] ^= 1;
    const ReadBack back = read("a.mcap", bytes);
    EXPECT_EQ(all_data(back), (Data{data('a'), data('b')}));
    ASSERT_EQ(back.notes.size(), 1U);
    EXPECT_HAS(back.notes[0], "checksum differs");
    EXPECT_TRUE(back.lost);
    EXPECT_HAS(back.notes[0], "a.mcap: the chunk at byte ");
}

/// The first chunk, where all topics are announced, is damaged; they are told again at the end.
TEST_F(Bags, ADamagedFirstChunkTakesNothingElseWithIt) {
    for (const char* name : {"a.mcap", "a.bag"}) {
        const auto path = folder_ / name;
        const auto written = some_messages(encoding_of(path.extension().string()), 30, 2000);
        write_bag(path, written);
        std::string bytes = slurp(path);
        const std::size_t in_first_chunk = 6000;
        bytes.replace(in_first_chunk, 100, std::string(100, '\x55'));
        const ReadBack back = read(name, bytes);
        EXPECT_FALSE(back.notes.empty());
        EXPECT_LT(back.messages.size(), written.size());
        EXPECT_GT(back.messages.size(), written.size() / 3) << name;
        EXPECT_TRUE(back.messages.back() == written.back());
    }
}

TEST_F(Bags, AChecksumMayBeMissing) {
    const std::string records = mcap::schema(1, "nav_msgs/msg/Odometry") +
                                mcap::channel(0, 1, "/a") + mcap::message(0, 1, "data");
    const ReadBack back = read("a.mcap", mcap::file(mcap::chunk("lz4", records, {}, false)));
    EXPECT_EQ(all_data(back), Data{"data"});
    EXPECT_EQ(back.notes, Data{});
}

TEST_F(Bags, MessagesOutsideChunks) {
    const std::string a = mcap::schema(1, "nav_msgs/msg/Odometry") + mcap::channel(0, 1, "/a") +
                          mcap::message(0, 1, "one") + mcap::message(0, 2, "two");
    EXPECT_EQ(all_data(read("a.mcap", mcap::file(a))), (Data{"one", "two"}));
    const std::string b = rosbag1::connection(4, "/a", odometry) + rosbag1::message(4, 1, "one");
    const ReadBack back = read("a.bag", rosbag1::file(b));
    EXPECT_EQ(all_data(back), Data{"one"});
    EXPECT_EQ(back.notes, Data{});
}

TEST_F(Bags, UnknownKindsOfMessagesAreLeftOut) {
    const ReadBack back =
        read("a.mcap", mcap::file(mcap::schema(1, "Thing") + mcap::channel(0, 1, "/a", "json") +
                                  mcap::channel(1, 1, "/b", "ros1") + mcap::message(0, 1, "{}") +
                                  mcap::message(1, 2, "x")));
    EXPECT_EQ(all_data(back), Data{"x"});
    EXPECT_EQ(back.notes, Data{});
}

TEST_F(Bags, WhatWasNeverAnnouncedIsNoted) {
    const ReadBack first = read("a.mcap", mcap::file(mcap::message(0, 1, "x")));
    EXPECT_TRUE(first.messages.empty());
    EXPECT_HAS(first.notes.at(0), "1 messages of channels without a channel record");
    const std::string records = rosbag1::connection(0, "/a", odometry) +
                                rosbag1::message(9, 1, "x") + rosbag1::message(0, 1, "y");
    const ReadBack second = read("a.bag", rosbag1::file(rosbag1::chunk("none", records)));
    EXPECT_EQ(all_data(second), Data{"y"});
    EXPECT_HAS(second.notes.at(0), "1 messages of connections without a connection record");
}

TEST_F(Bags, NeverClosed) {
    std::string bytes = two_chunk_bag("none");
    const std::size_t at = bytes.find("index_pos=") + 10;
    bytes.replace(at, 8, std::string(8, '\0'));
    const ReadBack back = read("a.bag.active", bytes);
    EXPECT_EQ(all_data(back), four);
    EXPECT_HAS(back.notes.at(0), "never closed");
    EXPECT_FALSE(back.lost) << "nothing says that the end is missing";
}

TEST_F(Bags, WhatIsNoBag) {
    EXPECT_HAS(error("a.mcap", ""), "is empty");
    EXPECT_HAS(error("a.mcap", "x"), "no MCAP");
    EXPECT_HAS(error("a.bag", ""), "is empty");
    EXPECT_HAS(error("a.bag", "x"), "no ROS bag");
    EXPECT_HAS(error("a.bag", "#ROSBAG V1.2\nmore"), "version 1; convert");
    EXPECT_HAS(error("a.db3", ""), "is empty");
    EXPECT_HAS(error("a.db3", "x"), "no ROS 2 bag");
    EXPECT_HAS(error("a.db3", std::string("SQLite format 3\0", 16) + "more"), "no ROS 2 bag");
    EXPECT_HAS(error("a.pcd", "x"), "is no bag");
}

TEST_F(Bags, NamesInCapitalsAndNamesThatSayNothing) {
    for (const char* name : {"A.MCAP", "data.bin", "misnamed.bag", "no_extension"}) {
        EXPECT_EQ(all_data(read(name, two_chunk_mcap("zstd"))), four) << name;
        EXPECT_EQ(all_data(read(name, two_chunk_bag("lz4"))), four) << name;
    }
    EXPECT_TRUE(Bag::recognises("A.MCAP"));
    EXPECT_TRUE(Bag::recognises("A.Bag.Active"));
    EXPECT_FALSE(Bag::recognises(folder_ / "data.bin"));
    write_bag(folder_ / "B.MCAP", some_messages(encoding_of(".mcap"), 2, 5));
    EXPECT_FALSE(read_all(folder_ / "B.MCAP").messages.empty());
}

TEST_F(Bags, Folders) {
    const auto message = [](const std::string& text) {
        return mcap::file(mcap::schema(1, "nav_msgs/msg/Odometry") + mcap::channel(0, 1, "/a") +
                          mcap::message(0, 1, text));
    };
    EXPECT_FALSE(Bag::recognises(folder_.path()));
    folder_.put("bag_10.mcap", message("third"));
    folder_.put("bag_2.mcap", message("second"));
    folder_.put("bag_0.mcap", message("first"));
    folder_.put(".bag_1.mcap", "hidden");
    EXPECT_TRUE(Bag::recognises(folder_.path()));
    EXPECT_EQ(all_data(read_all(folder_.path())), (Data{"first", "second", "third"}));
    folder_.put("bag_3.bag", two_chunk_bag("none"));
    EXPECT_HAS(error_of([&] { Bag{folder_.path()}; }), "give the one to use");
    std::filesystem::remove(folder_ / "bag_3.bag");
    folder_.put("bag_3.mcap.zstd", "");
    EXPECT_HAS(error_of([&] { Bag{folder_.path()}; }), "zstd -d");
    EXPECT_TRUE(Bag::recognises(folder_ / "bag_3.mcap.zstd"));
    EXPECT_HAS(error_of([&] { Bag{folder_ / "bag_3.mcap.zstd"}; }), "bag_3.mcap.zstd`");
    EXPECT_FALSE(Bag::recognises(folder_ / "notes.txt.zstd"));
    const TemporaryFolder empty;
    empty.put("metadata.yaml", "");
    EXPECT_HAS(error_of([&] { Bag{empty.path()}; }), "holds no bag");
}

/// 20 bytes that say they hold 4 GiB, and zeros that really are that many when unpacked.
TEST(BagDecompress, BombsEndAtOnce) {
    using Clock = std::chrono::steady_clock;
    struct rusage before {};
    ::getrusage(RUSAGE_SELF, &before);
    const auto start = Clock::now();
    const std::string zeros(1U << 20U, '\0');
    for (const char* kind : {"zstd", "lz4", "lz4 block", "bz2"}) {
        const std::string some = packed(kind, zeros);
        for (const std::string& bytes :
             {packed(kind, "abcdefgh"), some.substr(0, 20), some, std::string(20, 'x')}) {
            const Decompressed out = decompress(name_of(kind), as_byte_span(bytes), 0xFFFFFFFFU);
            EXPECT_FALSE(out.complete) << kind;
            EXPECT_LE(out.bytes.size(), zeros.size());
        }
    }
    EXPECT_LT(Clock::now() - start, std::chrono::seconds(5));
    struct rusage after {};
    ::getrusage(RUSAGE_SELF, &after);
    EXPECT_LT(after.ru_maxrss - before.ru_maxrss, 64 * 1024);  // [KiB]
}

TEST(BagDecompress, RealBombsStopAtTheLimit) {
    std::string zeros(200U << 20U, '\0');
    const std::string bytes = packed("zstd", zeros);
    zeros = {};
    ASSERT_LT(bytes.size(), 100'000U);
    const Decompressed out = decompress("zstd", as_byte_span(bytes), 200U << 20U);
    EXPECT_FALSE(out.complete);
    EXPECT_LE(out.bytes.size(), (64U << 20U) + 1000 * bytes.size());
}

TEST(BagDecompress, SizesThatAreWrong) {
    for (const char* kind : {"none", "zstd", "lz4", "lz4 block", "bz2"}) {
        const std::string bytes = packed(kind, data('a'));
        const auto out = [&](std::uint64_t size) {
            return decompress(name_of(kind), as_byte_span(bytes), size);
        };
        EXPECT_TRUE(out(data('a').size()).complete) << kind;
        EXPECT_FALSE(out(data('a').size() + 1).complete) << kind;
        if (std::string(kind) != "none") {
            EXPECT_LE(out(10).bytes.size(), 10U) << kind;
        }
    }
}

TEST_F(Bags, BombsInChunks) {
    const std::string m = mcap::file(mcap::chunk("zstd", "tiny", 0xFFFFFFFFFFULL));
    EXPECT_HAS(read("a.mcap", m).notes.at(0), "should hold 1099511627775 bytes, but gave only 4");
    const std::string b = rosbag1::file(rosbag1::chunk("bz2", "tiny", 0xFFFFFFFFU));
    EXPECT_HAS(read("a.bag", b).notes.at(0), "damaged");
}

}  // namespace bag_test
}  // namespace dynamic_filter::io
