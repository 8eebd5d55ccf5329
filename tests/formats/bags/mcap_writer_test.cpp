// SPDX-License-Identifier: MIT
// What the specification of MCAP asks for, read without the reader of MCAP.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "formats/bags/decompress.hpp"
#include "formats/byte_reader.hpp"
#include "formats/messages/definitions.hpp"
#include "support/tiny_bags.hpp"

namespace dynamic_filter::io {
namespace mcap_writer_test {

constexpr int kHeader = 1, kFooter = 2, kSchema = 3, kChannel = 4, kMessage = 5, kChunk = 6,
              kMessageIndex = 7, kChunkIndex = 8, kStatistics = 0x0B, kSummaryOffset = 0x0E,
              kDataEnd = 0x0F;
using Times = std::pair<std::uint64_t, std::uint64_t>;
using Offsets = std::map<std::uint16_t, std::uint64_t>;

struct Record {
    int opcode = 0;
    std::uint64_t at = 0, end = 0;  ///< [bytes] in the file or the chunk
    std::string content;
};
std::vector<Record> records_in(const std::string& bytes, std::size_t from, std::size_t to) {
    std::vector<Record> records;
    ByteReader reader(as_byte_span(bytes).first(to), from);
    while (reader.left() > 0) {
        Record record;
        record.at = reader.at();
        record.opcode = reader.number<std::uint8_t>();
        record.content = std::string(reader.text(reader.number<std::uint64_t>()));
        record.end = reader.at();
        records.push_back(record);
    }
    return records;
}
ByteReader inside(const Record& record) { return ByteReader(as_byte_span(record.content)); }
ByteReader inside(Record&&) = delete;  // a reader borrows

std::uint32_t crc_of(const std::string& bytes) {
    return static_cast<std::uint32_t>(
        crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}
Times times_from(ByteReader& reader) {
    const auto first = reader.number<std::uint64_t>();
    return {first, reader.number<std::uint64_t>()};
}

struct ChunkContent {
    Times times;
    std::uint64_t packed_bytes = 0;
    std::string plain;
};
ChunkContent chunk_of(const Record& record) {
    ByteReader reader = inside(record);
    ChunkContent chunk;
    chunk.times = times_from(reader);
    const auto size = reader.number<std::uint64_t>();
    const auto crc = reader.number<std::uint32_t>();
    EXPECT_EQ(reader.text(), "zstd");
    chunk.packed_bytes = reader.number<std::uint64_t>();
    EXPECT_EQ(chunk.packed_bytes, reader.left());
    const Decompressed out = decompress("zstd", reader.read(reader.left()), size);
    EXPECT_TRUE(out.complete);
    chunk.plain = std::string(reinterpret_cast<const char*>(out.bytes.data()), out.bytes.size());
    EXPECT_EQ(crc_of(chunk.plain), crc);
    return chunk;
}

const Topic odom{"/odom", "nav_msgs/Odometry", MessageEncoding::cdr};
const Topic slam{"/slam", "nav_msgs/Odometry", MessageEncoding::cdr};
const Topic tf{"/tf_static", "tf2_msgs/TFMessage", MessageEncoding::cdr};

/// A file of two chunks; the first holds messages of three topics, the second of one.
class McapWriterTest : public testing::Test {
protected:
    void SetUp() override {
        const std::vector<std::byte> small(3), large(kChunkBytes);
        write({{odom, 50, small},
               {tf, 20, small},
               {slam, 30, small},
               {odom, 40, large},
               {odom, 70, small},
               {odom, 60, small}});
    }
    void write(const std::vector<WrittenMessage>& messages) {
        write_bag(folder_ / "a.mcap", messages);
        bytes_ = slurp(folder_ / "a.mcap");
        const std::size_t magic = mcap::magic.size();
        ASSERT_EQ(bytes_.substr(0, magic), mcap::magic);
        ASSERT_EQ(bytes_.substr(bytes_.size() - magic), mcap::magic);
        records_ = records_in(bytes_, magic, bytes_.size() - magic);
    }
    [[nodiscard]] std::vector<Record> all(int opcode) const {
        std::vector<Record> found;
        std::copy_if(records_.begin(), records_.end(), std::back_inserter(found),
                     [&](const Record& record) { return record.opcode == opcode; });
        return found;
    }
    [[nodiscard]] std::vector<int> opcodes() const {
        std::vector<int> all;
        for (const Record& record : records_) all.push_back(record.opcode);
        return all;
    }
    TemporaryFolder folder_;
    std::string bytes_;
    std::vector<Record> records_;
};

TEST_F(McapWriterTest, RecordsAreInTheirOrder) {
    EXPECT_EQ(opcodes(),
              (std::vector<int>{kHeader,        kChunk,         kMessageIndex,  kMessageIndex,
                                kMessageIndex,  kChunk,         kMessageIndex,  kDataEnd,
                                kSchema,        kSchema,        kChannel,       kChannel,
                                kChannel,       kStatistics,    kChunkIndex,    kChunkIndex,
                                kSummaryOffset, kSummaryOffset, kSummaryOffset, kSummaryOffset,
                                kFooter}));
    ByteReader header = inside(records_.front());
    EXPECT_EQ(header.text(), "ros2");
    EXPECT_EQ(header.text(), "dynamic_filter");
    EXPECT_EQ(all(kDataEnd)[0].content, std::string(4, '\0'));
}

TEST_F(McapWriterTest, AChunkEndsWhenItIsFull) {
    const auto chunks = all(kChunk);
    EXPECT_EQ(chunk_of(chunks[0]).times, (Times{20, 50}));
    EXPECT_EQ(chunk_of(chunks[1]).times, (Times{60, 70}));
    const std::size_t head = 31;  // of a message record
    write({{odom, 1, std::vector<std::byte>(5)}});
    const std::size_t announced = chunk_of(all(kChunk)[0]).plain.size() - head - 5;
    const auto chunks_of = [&](std::size_t size) {  // of two messages, the first of this size
        write({{odom, 1, std::vector<std::byte>(size)}, {odom, 2, {}}});
        return all(kChunk).size();
    };
    EXPECT_EQ(chunks_of(kChunkBytes - announced - head), 2U);
    EXPECT_EQ(chunks_of(kChunkBytes - announced - head - 1), 1U);
}

TEST_F(McapWriterTest, TopicsAreAnnouncedBeforeTheirFirstMessage) {
    const std::string plain = chunk_of(all(kChunk)[0]).plain;
    std::vector<int> opcodes;
    for (const Record& record : records_in(plain, 0, plain.size())) {
        opcodes.push_back(record.opcode);
    }
    EXPECT_EQ(opcodes, (std::vector<int>{kSchema, kChannel, kMessage, kSchema, kChannel, kMessage,
                                         kChannel, kMessage, kMessage}));
    std::vector<std::pair<std::uint16_t, std::string>> schemas;
    for (const Record& record : all(kSchema)) {
        ByteReader reader = inside(record);
        const auto id = reader.number<std::uint16_t>();
        schemas.emplace_back(id, reader.text());
        EXPECT_EQ(reader.text(), "ros2msg");
        const std::string type = id == 1 ? odom.type : tf.type;
        EXPECT_EQ(reader.text(), full_definition(type, MessageEncoding::cdr));
        EXPECT_EQ(reader.left(), 0U);
        EXPECT_NE(plain.find(record.content), std::string::npos);
    }
    EXPECT_EQ(schemas, (std::vector<std::pair<std::uint16_t, std::string>>{
                           {1, "nav_msgs/msg/Odometry"}, {2, "tf2_msgs/msg/TFMessage"}}));
}

TEST_F(McapWriterTest, ChannelsNameTopicSchemaAndQualityOfService) {
    std::vector<std::string> channels;
    for (const Record& record : all(kChannel)) {
        ByteReader reader = inside(record);
        const auto id = reader.number<std::uint16_t>(), schema = reader.number<std::uint16_t>();
        channels.push_back(fmt::format("{} {} {}", id, schema, reader.text()));
        EXPECT_EQ(reader.text(), "cdr");
        ByteReader metadata(reader.block());
        EXPECT_EQ(metadata.text(), "offered_qos_profiles");
        EXPECT_EQ(metadata.text(), offered_qos(id == 1 ? tf : odom));
        EXPECT_EQ(metadata.left() + reader.left(), 0U);
    }
    EXPECT_EQ(channels, (std::vector<std::string>{"0 1 /odom", "1 2 /tf_static", "2 1 /slam"}));
}

TEST_F(McapWriterTest, MessagesHaveTheirNumberAndTime) {
    std::vector<std::string> messages;
    for (const Record& chunk : all(kChunk)) {
        const std::string plain = chunk_of(chunk).plain;
        for (const Record& record : records_in(plain, 0, plain.size())) {
            if (record.opcode != kMessage) continue;
            ByteReader reader = inside(record);
            const auto channel = reader.number<std::uint16_t>();
            const auto sequence = reader.number<std::uint32_t>();
            const Times times = times_from(reader);
            EXPECT_EQ(times.first, times.second);
            messages.push_back(
                fmt::format("{} {} {} {}", channel, sequence, times.first, reader.left()));
        }
    }
    EXPECT_EQ(messages, (std::vector<std::string>{"0 0 50 3", "1 0 20 3", "2 0 30 3",
                                                  "0 1 40 1048576", "0 2 70 3", "0 3 60 3"}));
}

TEST_F(McapWriterTest, TheIndexOfAChunkPointsToItsMessages) {
    std::string plain;
    std::vector<std::string> entries;
    for (const Record& record : records_) {
        if (record.opcode == kChunk) plain = chunk_of(record).plain;
        if (record.opcode != kMessageIndex) continue;
        ByteReader reader = inside(record);
        const auto channel = reader.number<std::uint16_t>();
        ByteReader list(reader.block());
        while (list.left() > 0) {
            const auto [time, offset] = times_from(list);
            const Record message = records_in(plain, offset, plain.size()).front();
            EXPECT_EQ(message.opcode, kMessage);
            ByteReader content = inside(message);
            EXPECT_EQ(content.number<std::uint16_t>(), channel);
            content.read(4);
            EXPECT_EQ(content.number<std::uint64_t>(), time);
            entries.push_back(fmt::format("{} {}", channel, time));
        }
        EXPECT_EQ(reader.left(), 0U);
    }
    EXPECT_EQ(entries, (std::vector<std::string>{"0 50", "0 40", "1 20", "2 30", "0 70", "0 60"}));
}

TEST_F(McapWriterTest, TheSummaryPointsToTheChunks) {
    const auto chunks = all(kChunk), indices = all(kMessageIndex), listed = all(kChunkIndex);
    const std::vector<std::vector<Record>> of_chunk = {{indices.begin(), indices.begin() + 3},
                                                       {indices[3]}};
    for (std::size_t i = 0; i < 2; ++i) {
        ByteReader reader = inside(listed[i]);
        const ChunkContent chunk = chunk_of(chunks[i]);
        EXPECT_EQ(times_from(reader), chunk.times);
        EXPECT_EQ(reader.number<std::uint64_t>(), chunks[i].at);
        EXPECT_EQ(reader.number<std::uint64_t>(), chunks[i].end - chunks[i].at);
        Offsets offsets, expected;
        for (ByteReader list(reader.block()); list.left() > 0;) {
            const auto channel = list.number<std::uint16_t>();
            offsets[channel] = list.number<std::uint64_t>();
        }
        for (const Record& index : of_chunk[i]) {
            expected[inside(index).number<std::uint16_t>()] = index.at;
        }
        EXPECT_EQ(offsets, expected);
        EXPECT_EQ(reader.number<std::uint64_t>(), of_chunk[i].back().end - chunks[i].end);
        EXPECT_EQ(reader.text(), "zstd");
        EXPECT_EQ(reader.number<std::uint64_t>(), chunk.packed_bytes);
        EXPECT_EQ(reader.number<std::uint64_t>(), chunk.plain.size());
        EXPECT_EQ(reader.left(), 0U);
    }
}

TEST_F(McapWriterTest, StatisticsCount) {
    const auto statistics = all(kStatistics);
    ByteReader reader = inside(statistics.at(0));
    EXPECT_EQ(reader.number<std::uint64_t>(), 6U);  // messages
    EXPECT_EQ(reader.number<std::uint16_t>(), 2U);  // schemas
    EXPECT_EQ(reader.number<std::uint32_t>(), 3U);  // channels
    EXPECT_EQ(reader.number<std::uint64_t>(), 0U);  // attachments and metadata
    EXPECT_EQ(reader.number<std::uint32_t>(), 2U);  // chunks
    EXPECT_EQ(times_from(reader), (Times{20, 70}));
    Offsets counts;
    for (ByteReader list(reader.block()); list.left() > 0;) {
        const auto channel = list.number<std::uint16_t>();
        counts[channel] = list.number<std::uint64_t>();
    }
    EXPECT_EQ(counts, (Offsets{{0, 4}, {1, 1}, {2, 1}}));
}

TEST_F(McapWriterTest, TheFooterPointsToTheSummaryAndItsGroups) {
    const Record& footer = records_.back();
    ByteReader reader = inside(footer);
    const auto groups = all(kSummaryOffset);
    const std::uint64_t summary = all(kSchema)[0].at;
    EXPECT_EQ(reader.number<std::uint64_t>(), summary);
    EXPECT_EQ(reader.number<std::uint64_t>(), groups[0].at);
    const std::size_t checked = footer.end - 4 - summary;  // up to the checksum itself
    EXPECT_EQ(reader.number<std::uint32_t>(), crc_of(bytes_.substr(summary, checked)));
    EXPECT_EQ(reader.left(), 0U);
    const std::vector<int> kinds = {kSchema, kChannel, kStatistics, kChunkIndex};
    for (std::size_t i = 0; i < kinds.size(); ++i) {
        ByteReader group = inside(groups[i]);
        EXPECT_EQ(group.number<std::uint8_t>(), kinds[i]);
        EXPECT_EQ(group.number<std::uint64_t>(), all(kinds[i]).front().at);
        EXPECT_EQ(group.number<std::uint64_t>(),
                  all(kinds[i]).back().end - all(kinds[i]).front().at);
    }
}

TEST_F(McapWriterTest, WithoutMessagesThereAreOnlyStatistics) {
    write({});
    EXPECT_EQ(opcodes(),
              (std::vector<int>{kHeader, kDataEnd, kStatistics, kSummaryOffset, kFooter}));
    EXPECT_EQ(all(kStatistics)[0].content, std::string(46, '\0'));
}

}  // namespace mcap_writer_test
}  // namespace dynamic_filter::io
