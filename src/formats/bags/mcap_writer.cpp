// SPDX-License-Identifier: MIT
// Format: https://mcap.dev/spec, with the entries that the player of ROS 2 needs.
#include <fmt/format.h>
#include <zstd.h>

#include <algorithm>
#include <map>

#include "base/crc.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/file.hpp"
#include "formats/bags/bag_writers.hpp"
#include "formats/bags/mcap_format.hpp"
#include "formats/byte_writer.hpp"
#include "formats/messages/definitions.hpp"

namespace dynamic_filter::io {
namespace {

constexpr std::string_view kCompression = "zstd";

void put_record(ByteWriter& out, McapOpcode opcode, std::span<const std::byte> content) {
    out.number(static_cast<std::uint8_t>(opcode));
    out.number(static_cast<std::uint64_t>(content.size()));
    out.raw(content);
}

std::vector<std::byte> schema_record(std::uint16_t id, const std::string& type) {
    ByteWriter out;
    out.number(id);
    out.text(ros2_type(type));
    out.text("ros2msg");
    out.text(full_definition(type, MessageEncoding::cdr));
    return std::move(out.bytes);
}

std::vector<std::byte> channel_record(std::uint16_t id, std::uint16_t schema, const Topic& topic) {
    ByteWriter metadata;
    metadata.text("offered_qos_profiles");
    metadata.text(offered_qos(topic));
    ByteWriter out;
    out.number(id);
    out.number(schema);
    out.text(topic.name);
    out.text("cdr");
    out.block(metadata.bytes);
    return std::move(out.bytes);
}

struct Times {
    std::uint64_t first = UINT64_MAX, last = 0;
    void add(std::uint64_t time) {
        first = std::min(first, time);
        last = std::max(last, time);
    }
    void put(ByteWriter& out) const {
        out.number(last < first ? 0 : first);
        out.number(last);
    }
};

struct McapIndexEntry {
    std::uint64_t time = 0, offset = 0;
};
struct OpenMcapChunk {
    ByteWriter records;
    Times times;
    std::map<std::uint16_t, std::vector<McapIndexEntry>> index;  // per channel
};

/// File offset of the index of each channel of a chunk.
using IndexOffsets = std::map<std::uint16_t, std::uint64_t>;

/// Schemas are numbered like the first topic of their type, starting at 1, because 0 means "no
/// schema".
class McapWriter final : public BagWriter {
public:
    explicit McapWriter(const std::filesystem::path& path)
        : path_(path), file_(path), topics_(path, MessageEncoding::cdr) {
        ByteWriter header;
        header.text("ros2");
        header.text("dynamic_filter");
        put(as_byte_span(kMcapMagic));
        put_record(McapOpcode::header, header.bytes);
    }

    [[nodiscard]] MessageEncoding encoding() const override { return MessageEncoding::cdr; }

    void write(const Topic& topic, std::int64_t time_ns, std::span<const std::byte> data) override {
        check_time(path_, time_ns);
        const auto [number, is_new] = topics_.number_of(topic);
        const auto channel = static_cast<std::uint16_t>(number);
        if (is_new) announce(channel);
        const auto time = static_cast<std::uint64_t>(time_ns);
        ByteWriter& out = chunk_.records;
        chunk_.index[channel].push_back({time, out.bytes.size()});
        chunk_.times.add(time);
        constexpr std::size_t kBeforeData = 22;
        out.number(static_cast<std::uint8_t>(McapOpcode::message));
        out.number(static_cast<std::uint64_t>(kBeforeData + data.size()));
        out.number(channel);
        out.number(static_cast<std::uint32_t>(counts_[channel]++));
        out.number(time);  // time of recording
        out.number(time);  // time of publishing
        out.raw(data);
        if (out.bytes.size() >= kChunkBytes) put_chunk();
    }

    void commit() override {
        if (!chunk_.records.bytes.empty()) put_chunk();
        ByteWriter end;
        // No checksum of the whole file, because each chunk has its own.
        end.number(std::uint32_t{0});
        put_record(McapOpcode::data_end, end.bytes);
        put_summary();
        put(as_byte_span(kMcapMagic));
        file_.commit();
    }

private:
    [[nodiscard]] std::uint16_t schema_of(std::uint16_t channel) const {
        const auto& topics = topics_.all();
        const auto first = std::find_if(topics.begin(), topics.end(), [&](const Topic& topic) {
            return topic.type == topics[channel].type;
        });
        return static_cast<std::uint16_t>(first - topics.begin() + 1);
    }

    void announce(std::uint16_t channel) {
        if (channel == UINT16_MAX) throw OutputError(path_, "has too many topics for MCAP");
        const Topic& topic = topics_.all()[channel];
        const std::uint16_t schema = schema_of(channel);
        if (schema == channel + 1) add(McapOpcode::schema, schema_record(schema, topic.type));
        add(McapOpcode::channel, channel_record(channel, schema, topic));
    }
    void add(McapOpcode opcode, const std::vector<std::byte>& content) {
        io::put_record(chunk_.records, opcode, content);
        io::put_record(opcode == McapOpcode::schema ? schemas_ : channels_, opcode, content);
    }

    void put_chunk() {
        const std::vector<std::byte>& plain = chunk_.records.bytes;
        const std::vector<std::byte> packed = compress(plain);
        const std::uint64_t begin = at_;
        ByteWriter head;
        chunk_.times.put(head);
        head.number(static_cast<std::uint64_t>(plain.size()));
        head.number(crc_of(plain));
        head.text(kCompression);
        head.number(static_cast<std::uint64_t>(packed.size()));
        put_record_head(McapOpcode::chunk, head.bytes.size() + packed.size());
        put(head.bytes);
        put(packed);
        const std::uint64_t end = at_;
        const IndexOffsets offsets = put_message_indices();
        put_chunk_index(begin, end, offsets, packed.size());
        times_.add(chunk_.times.first);
        times_.add(chunk_.times.last);
        chunk_ = {};
    }

    IndexOffsets put_message_indices() {
        IndexOffsets offsets;
        for (const auto& [channel, entries] : chunk_.index) {
            offsets[channel] = at_;
            ByteWriter list, record;
            for (const McapIndexEntry& entry : entries) {
                list.number(entry.time);
                list.number(entry.offset);
            }
            record.number(channel);
            record.block(list.bytes);
            put_record(McapOpcode::message_index, record.bytes);
        }
        return offsets;
    }

    /// Stores the index of a chunk for the summary; the record is written at the end.
    void put_chunk_index(std::uint64_t begin, std::uint64_t end, const IndexOffsets& offsets,
                         std::size_t packed_bytes) {
        ByteWriter list, record;
        for (const auto& [channel, offset] : offsets) {
            list.number(channel);
            list.number(offset);
        }
        chunk_.times.put(record);
        record.number(begin);
        record.number(end - begin);
        record.block(list.bytes);
        record.number(at_ - end);
        record.text(kCompression);
        record.number(static_cast<std::uint64_t>(packed_bytes));
        record.number(static_cast<std::uint64_t>(chunk_.records.bytes.size()));
        io::put_record(chunk_indices_, McapOpcode::chunk_index, record.bytes);
        ++chunks_;
    }

    [[nodiscard]] ByteWriter statistics() const {
        ByteWriter counts, record, out;
        std::uint64_t messages = 0;
        for (const auto& [channel, count] : counts_) {
            counts.number(channel);
            counts.number(count);
            messages += count;
        }
        record.number(messages);
        record.number(schema_count());
        record.number(static_cast<std::uint32_t>(topics_.all().size()));
        record.number(std::uint32_t{0});  // number of attachments
        record.number(std::uint32_t{0});  // number of metadata records
        record.number(chunks_);
        times_.put(record);
        record.block(counts.bytes);
        io::put_record(out, McapOpcode::statistics, record.bytes);
        return out;
    }
    [[nodiscard]] std::uint16_t schema_count() const {
        std::uint16_t count = 0;
        for (std::uint16_t channel = 0; channel < topics_.all().size(); ++channel) {
            if (schema_of(channel) == channel + 1) ++count;
        }
        return count;
    }

    void put_summary() {
        const std::uint64_t start = at_;
        ByteWriter offsets, summary;
        const auto add_group = [&](McapOpcode opcode, const ByteWriter& records) {
            if (records.bytes.empty()) return;
            ByteWriter offset;
            offset.number(static_cast<std::uint8_t>(opcode));
            offset.number(start + summary.bytes.size());
            offset.number(static_cast<std::uint64_t>(records.bytes.size()));
            io::put_record(offsets, McapOpcode::summary_offset, offset.bytes);
            summary.raw(records.bytes);
        };
        add_group(McapOpcode::schema, schemas_);
        add_group(McapOpcode::channel, channels_);
        add_group(McapOpcode::statistics, statistics());
        add_group(McapOpcode::chunk_index, chunk_indices_);
        const std::uint64_t offsets_start = start + summary.bytes.size();
        summary.raw(offsets.bytes);
        constexpr std::uint64_t kFooterBytes = 20;
        summary.number(static_cast<std::uint8_t>(McapOpcode::footer));
        summary.number(kFooterBytes);
        summary.number(start);
        summary.number(offsets_start);
        summary.number(crc_of(summary.bytes));
        put(summary.bytes);
    }

    [[nodiscard]] std::vector<std::byte> compress(std::span<const std::byte> plain) const {
        std::vector<std::byte> packed(ZSTD_compressBound(plain.size()));
        const std::size_t size = ZSTD_compress(packed.data(), packed.size(), plain.data(),
                                               plain.size(), ZSTD_CLEVEL_DEFAULT);
        if (ZSTD_isError(size) != 0) {
            throw OutputError(path_,
                              fmt::format("cannot be compressed: {}", ZSTD_getErrorName(size)));
        }
        packed.resize(size);
        return packed;
    }

    void put(std::span<const std::byte> bytes) {
        file_.write(bytes);
        at_ += bytes.size();
    }
    void put_record_head(McapOpcode opcode, std::uint64_t length) {
        ByteWriter head;
        head.number(static_cast<std::uint8_t>(opcode));
        head.number(length);
        put(head.bytes);
    }
    void put_record(McapOpcode opcode, std::span<const std::byte> content) {
        put_record_head(opcode, content.size());
        put(content);
    }

    std::filesystem::path path_;
    AtomicFile file_;
    std::uint64_t at_ = 0;
    TopicTable topics_;
    OpenMcapChunk chunk_;
    std::map<std::uint16_t, std::uint64_t> counts_;  // numbers of messages per channel
    ByteWriter schemas_, channels_, chunk_indices_;  // records for the summary
    std::uint32_t chunks_ = 0;
    Times times_;
};

}  // namespace

std::unique_ptr<BagWriter> create_mcap(const std::filesystem::path& file) {
    return std::make_unique<McapWriter>(file);
}

}  // namespace dynamic_filter::io
