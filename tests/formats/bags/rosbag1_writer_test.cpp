// SPDX-License-Identifier: MIT
// What the format of ROS 1 bags asks for, read without the reader of bags.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "formats/bags/decompress.hpp"
#include "formats/byte_reader.hpp"
#include "formats/messages/definitions.hpp"
#include "support/tiny_bags.hpp"

namespace dynamic_filter::io {
namespace rosbag1_writer_test {

constexpr int kMessage = 2, kBagHeader = 3, kIndex = 4, kChunk = 5, kChunkInfo = 6, kConnection = 7;
constexpr std::int64_t kSecond = 1'000'000'000;

using Fields = std::map<std::string, std::string>;
Fields fields_in(std::span<const std::byte> bytes) {
    Fields fields;
    for (ByteReader reader(bytes); reader.left() > 0;) {
        const std::string field(reader.text());
        fields[field.substr(0, field.find('='))] = field.substr(field.find('=') + 1);
    }
    return fields;
}

struct Record {
    std::size_t at = 0;  ///< [bytes] in the file or the chunk
    Fields fields;
    std::string data;
    [[nodiscard]] int opcode() const { return fields.at("op").at(0); }
    template <class T = std::uint32_t>
    [[nodiscard]] T number(const std::string& name) const {
        EXPECT_EQ(fields.at(name).size(), sizeof(T)) << name;
        return little_endian<T>(as_byte_span(fields.at(name)).data());
    }
};
std::vector<Record> records_in(const std::string& bytes, std::size_t from = 0) {
    std::vector<Record> records;
    for (ByteReader reader(as_byte_span(bytes), from); reader.left() > 0;) {
        Record record;
        record.at = reader.at();
        record.fields = fields_in(reader.block());
        record.data = std::string(reader.text());
        records.push_back(record);
    }
    return records;
}
std::string plain_of(const Record& chunk) {
    EXPECT_EQ(chunk.fields.at("compression"), "lz4");
    const Decompressed out = decompress("lz4", as_byte_span(chunk.data), chunk.number("size"));
    EXPECT_TRUE(out.complete);
    return {reinterpret_cast<const char*>(out.bytes.data()), out.bytes.size()};
}
/// "seconds.nanoseconds" of a time as it is in the file.
std::string time_of(std::uint64_t time) {
    return fmt::format("{}.{:09}", time & 0xFFFFFFFFU, time >> 32U);
}

const Topic odom{"/odom", "nav_msgs/Odometry", MessageEncoding::ros1};
const Topic tf{"/tf_static", "tf2_msgs/TFMessage", MessageEncoding::ros1};

/// A file of two chunks; the first holds messages of two topics, the second of one.
class Rosbag1WriterTest : public testing::Test {
protected:
    void SetUp() override {
        const std::vector<std::byte> small(3), large(kChunkBytes);
        write({{odom, 5 * kSecond + 7, small},
               {tf, 2 * kSecond, small},
               {odom, 4 * kSecond, large},
               {odom, 6 * kSecond + 999'999'999, small},
               {odom, 6 * kSecond, small}});
    }
    void write(const std::vector<WrittenMessage>& messages) {
        write_bag(folder_ / "a.bag", messages);
        const std::string bytes = slurp(folder_ / "a.bag");
        ASSERT_EQ(bytes.substr(0, rosbag1::magic.size()), rosbag1::magic);
        records_ = records_in(bytes, rosbag1::magic.size());
    }
    [[nodiscard]] std::vector<Record> all(int opcode) const {
        std::vector<Record> found;
        std::copy_if(records_.begin(), records_.end(), std::back_inserter(found),
                     [&](const Record& record) { return record.opcode() == opcode; });
        return found;
    }
    [[nodiscard]] std::vector<int> opcodes() const {
        std::vector<int> all;
        for (const Record& record : records_) all.push_back(record.opcode());
        return all;
    }
    TemporaryFolder folder_;
    std::vector<Record> records_;
};

TEST_F(Rosbag1WriterTest, RecordsAreInTheirOrderAndTheHeaderPointsBehindTheChunks) {
    EXPECT_EQ(opcodes(), (std::vector<int>{kBagHeader, kChunk, kIndex, kIndex, kChunk, kIndex,
                                           kConnection, kConnection, kChunkInfo, kChunkInfo}));
    const Record& header = records_[0];
    EXPECT_EQ(records_[1].at, rosbag1::magic.size() + 4096);
    EXPECT_EQ(header.data, std::string(header.data.size(), ' '));
    EXPECT_EQ(header.number<std::uint64_t>("index_pos"), all(kConnection)[0].at);
    EXPECT_EQ(header.number("conn_count"), 2U);
    EXPECT_EQ(header.number("chunk_count"), 2U);
}

TEST_F(Rosbag1WriterTest, ChunksHoldConnectionsAndMessages) {
    std::vector<std::string> told;
    for (const Record& chunk : all(kChunk)) {
        for (const Record& record : records_in(plain_of(chunk))) {
            std::string text = fmt::format("{} of {}", record.opcode(), record.number("conn"));
            if (record.opcode() == kMessage) {
                text += fmt::format(" at {}: {}", time_of(record.number<std::uint64_t>("time")),
                                    record.data.size());
            }
            told.push_back(text);
        }
    }
    EXPECT_EQ(told, (std::vector<std::string>{
                        "7 of 0", "2 of 0 at 5.000000007: 3", "7 of 1", "2 of 1 at 2.000000000: 3",
                        "2 of 0 at 4.000000000: 1048576", "2 of 0 at 6.999999999: 3",
                        "2 of 0 at 6.000000000: 3"}));
}

TEST_F(Rosbag1WriterTest, ConnectionsSayTypeChecksumAndDefinition) {
    const auto connections = all(kConnection);
    for (std::size_t i = 0; i < 2; ++i) {
        const Topic& topic = i == 0 ? odom : tf;
        EXPECT_EQ(connections[i].number("conn"), i);
        EXPECT_EQ(connections[i].fields.at("topic"), topic.name);
        Fields expected = {
            {"topic", topic.name},
            {"type", topic.type},
            {"md5sum", find_definition(topic.type)->md5},
            {"message_definition", full_definition(topic.type, MessageEncoding::ros1)}};
        if (i == 1) expected["latching"] = "1";
        EXPECT_EQ(fields_in(as_byte_span(connections[i].data)), expected);
        const auto announced = records_in(plain_of(all(kChunk)[0]));
        EXPECT_EQ(announced[2 * i].data, connections[i].data);
    }
}

TEST_F(Rosbag1WriterTest, TheIndexOfAChunkPointsToItsMessages) {
    std::string plain;
    std::vector<std::string> entries;
    for (const Record& record : records_) {
        if (record.opcode() == kChunk) plain = plain_of(record);
        if (record.opcode() != kIndex) continue;
        EXPECT_EQ(record.number("ver"), 1U);
        EXPECT_EQ(record.number("count") * 12, record.data.size());
        for (ByteReader list(as_byte_span(record.data)); list.left() > 0;) {
            const auto time = list.number<std::uint64_t>();
            const Record message = records_in(plain, list.number<std::uint32_t>()).front();
            EXPECT_EQ(message.opcode(), kMessage);
            EXPECT_EQ(message.number("conn"), record.number("conn"));
            EXPECT_EQ(message.number<std::uint64_t>("time"), time);
            entries.push_back(fmt::format("{} {}", record.number("conn"), time_of(time)));
        }
    }
    EXPECT_EQ(entries, (std::vector<std::string>{"0 5.000000007", "0 4.000000000", "1 2.000000000",
                                                 "0 6.999999999", "0 6.000000000"}));
}

TEST_F(Rosbag1WriterTest, TheEndPointsToTheChunks) {
    const auto infos = all(kChunkInfo), chunks = all(kChunk);
    const std::array<std::string, 2> starts = {"2.000000000", "6.000000000"},
                                     ends = {"5.000000007", "6.999999999"},
                                     counts = {
                                         bytes_of(0) + bytes_of(2) + bytes_of(1) + bytes_of(1),
                                         bytes_of(0) + bytes_of(2)};
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(infos[i].number("ver"), 1U);
        EXPECT_EQ(infos[i].number<std::uint64_t>("chunk_pos"), chunks[i].at);
        EXPECT_EQ(time_of(infos[i].number<std::uint64_t>("start_time")), starts[i]);
        EXPECT_EQ(time_of(infos[i].number<std::uint64_t>("end_time")), ends[i]);
        EXPECT_EQ(infos[i].number("count"), 2 - i);
        EXPECT_EQ(infos[i].data, counts[i]);
    }
}

TEST_F(Rosbag1WriterTest, AChunkEndsWhenItIsFull) {
    write({{odom, 1, {}}});
    const std::size_t announced = plain_of(all(kChunk)[0]).size();
    const auto chunks_of = [&](std::size_t size) {  // of two messages, the first of this size
        write({{odom, 1, std::vector<std::byte>(size)}, {odom, 2, {}}});
        return all(kChunk).size();
    };
    EXPECT_EQ(chunks_of(kChunkBytes - announced), 2U);
    EXPECT_EQ(chunks_of(kChunkBytes - announced - 1), 1U);
}

/// As ROS needs them: independent blocks of at most 1 MiB, and a checksum of the content.
TEST_F(Rosbag1WriterTest, ChunksAreFramesThatRosReads) {
    const std::string frame = all(kChunk)[0].data;
    EXPECT_EQ(frame.substr(0, 4), bytes_of(std::uint32_t{0x184D2204}));
    EXPECT_EQ(frame[4], '\x64');  // version 1, independent blocks, checksum of the content
    EXPECT_EQ(frame[5], '\x60');  // 1 MiB
}

TEST_F(Rosbag1WriterTest, WithoutMessagesThereIsOnlyTheHeader) {
    write({});
    EXPECT_EQ(opcodes(), std::vector<int>{kBagHeader});
    EXPECT_EQ(records_[0].number<std::uint64_t>("index_pos"), rosbag1::magic.size() + 4096);
    EXPECT_EQ(records_[0].number("conn_count") + records_[0].number("chunk_count"), 0U);
}

TEST_F(Rosbag1WriterTest, ThereAreNoTimesAfter2106) {
    const std::int64_t last = (std::int64_t{1} << 32U) * kSecond - 1;
    const auto writer = BagWriter::create(folder_ / "b.bag");
    writer->write(odom, last, {});
    EXPECT_EQ(
        error_of<OutputError>([&] { writer->write(odom, last + 1, {}); }),
        (folder_ / "b.bag").string() + ": a message of 4294967296000000000 ns is too late for it");
    writer->commit();
    EXPECT_EQ(read_all(folder_ / "b.bag").messages.at(0).time_ns, last);
}

}  // namespace rosbag1_writer_test
}  // namespace dynamic_filter::io
