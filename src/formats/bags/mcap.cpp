// SPDX-License-Identifier: MIT
// Format: https://mcap.dev/spec. The index at the end is not needed, so files that were never
// closed can be read. If there is an index, it helps where a chunk is damaged.
#include <fmt/format.h>

#include <map>
#include <set>

#include "base/crc.hpp"
#include "dynamic_filter/error.hpp"
#include "formats/bags/chunked_file.hpp"
#include "formats/bags/decompress.hpp"
#include "formats/bags/mcap_format.hpp"
#include "formats/byte_reader.hpp"
#include "formats/messages/packets.hpp"

namespace dynamic_filter::io {
namespace {

constexpr std::size_t kRecordHead = 9;  // opcode and length

struct McapRecord {
    McapOpcode opcode{};
    std::span<const std::byte> content;
};
McapRecord read_mcap_record(ByteReader& in) {
    const auto opcode = static_cast<McapOpcode>(in.number<std::uint8_t>());
    return {opcode, in.read(in.number<std::uint64_t>())};
}

struct ChunkRecord {
    std::uint64_t size = 0;
    std::uint32_t crc = 0;
    std::string_view compression;
    std::span<const std::byte> bytes;  // the bytes of the record that the file contains
};
ChunkRecord parse_chunk(std::span<const std::byte> content) {
    ByteReader in(content);
    in.read(16);  // skips the first and the last time
    ChunkRecord chunk;
    chunk.size = in.number<std::uint64_t>();
    chunk.crc = in.number<std::uint32_t>();
    chunk.compression = in.text();
    const auto stored = in.number<std::uint64_t>();
    chunk.bytes = in.read(std::min<std::uint64_t>(stored, in.left()));
    return chunk;
}

/// Collects the schemas and channels, and the messages on usable channels.
class McapReader {
public:
    McapReader(const UseMessage& use, std::vector<Defect>& defects)
        : use_(use), defects_(defects) {}

    void use(const McapRecord& record, std::uint64_t chunk, std::uint64_t offset) {
        try {
            ByteReader in(record.content);
            if (record.opcode == McapOpcode::schema) add_schema(in);
            if (record.opcode == McapOpcode::channel) add_channel(in);
            if (record.opcode == McapOpcode::message) use_message(in, chunk, offset);
        } catch (const Malformed& error) {
            defects_.push_back({fmt::format("a record at byte {}: {}", offset, error.what())});
        }
    }

    void finish() {
        if (unannounced_ == 0) return;
        defects_.push_back({fmt::format(
            "{} messages of channels without a channel record are left out", unannounced_)});
    }

private:
    void add_schema(ByteReader& in) {
        const auto id = in.number<std::uint16_t>();
        schemas_[id] = std::string(in.text());
    }
    void add_channel(ByteReader& in) {
        const auto id = in.number<std::uint16_t>();
        const auto schema = in.number<std::uint16_t>();
        const std::string name(in.text()), encoding(in.text());
        const auto found = schemas_.find(schema);
        const bool is_other = encoding != "cdr" && encoding != "ros1";
        if (is_other && others_.insert(id).second && found != schemas_.end()) {
            tell_cloud(name, found->second, encoding);
        }
        if (found == schemas_.end() || others_.contains(id)) return;
        topics_.try_emplace(
            id, Topic{name, plain_type(found->second),
                      encoding == "cdr" ? MessageEncoding::cdr : MessageEncoding::ros1});
    }
    /// Clouds in another encoding are no ROS messages, so they are not read, but they may be all
    /// there is.
    void tell_cloud(const std::string& topic, const std::string& type,
                    const std::string& encoding) {
        const std::string advice = advice_on_cloud(type);
        if (advice.empty()) return;
        defects_.push_back(
            {fmt::format("{} holds {} ({}), which is not read: {}", topic, type, encoding, advice),
             false});
    }
    void use_message(ByteReader& in, std::uint64_t chunk, std::uint64_t offset) {
        const auto id = in.number<std::uint16_t>();
        const auto channel = topics_.find(id);
        in.read(4);  // sequence
        const auto recorded = static_cast<std::int64_t>(in.number<std::uint64_t>());
        in.read(8);  // time of publishing
        if (channel == topics_.end()) {
            if (!others_.contains(id)) ++unannounced_;
            return;
        }
        use_({channel->second, recorded, chunk, offset, in.read(in.left())});
    }

    const UseMessage& use_;
    std::vector<Defect>& defects_;
    std::map<std::uint16_t, std::string> schemas_;
    std::map<std::uint16_t, Topic> topics_;
    std::set<std::uint16_t> others_;  // channels with other encodings, such as JSON and protobuf
    std::size_t unannounced_ = 0;
};

class Mcap final : public ChunkedFile {
public:
    explicit Mcap(const std::filesystem::path& path) : ChunkedFile(path) {
        const auto head = file().size() < kMcapMagic.size() ? std::vector<std::byte>{}
                                                            : file().read(0, kMcapMagic.size());
        if (as_text(head) != kMcapMagic) {
            throw InputError(path, "byte 0", "is no MCAP file: its first eight bytes differ");
        }
    }

    std::vector<Defect> for_each(const UseMessage& use) const override {
        std::vector<Defect> defects;
        McapReader reader(use, defects);
        read_summary(reader);
        std::uint64_t at = kMcapMagic.size();
        while (true) {
            if (file().size() - at < kRecordHead) {
                const bool cut_off = at != file().size();
                defects.push_back(
                    {fmt::format("ends at byte {} without a footer", file().size()), cut_off});
                break;
            }
            const auto head = file().read(at, kRecordHead);
            const auto opcode = static_cast<McapOpcode>(head[0]);
            const auto length = little_endian<std::uint64_t>(head.data() + 1);
            const std::uint64_t there = file().size() - at - kRecordHead;
            if (opcode == McapOpcode::footer) break;
            const bool wanted = opcode >= McapOpcode::schema && opcode <= McapOpcode::chunk;
            if (length > there)
                defects.push_back({fmt::format("the record at byte {} is cut off", at)});
            if (length > there && opcode != McapOpcode::chunk) break;
            if (wanted) {
                const auto content = file().read(at + kRecordHead, std::min(length, there));
                if (opcode == McapOpcode::chunk) {
                    use_chunk(content, at, reader, defects);
                } else {
                    reader.use({opcode, content}, kNoChunk, at);
                }
            }
            if (length > there) break;
            at += kRecordHead + length;
        }
        reader.finish();
        return defects;
    }

private:
    std::vector<std::byte> message_in(std::span<const std::byte> bytes,
                                      std::uint64_t offset) const override {
        constexpr std::size_t kBeforeData = 22;
        ByteReader record(bytes, static_cast<std::size_t>(offset));
        ByteReader in(read_mcap_record(record).content);
        in.read(kBeforeData);
        const auto data = in.read(in.left());
        return {data.begin(), data.end()};
    }

    std::vector<std::byte> record_at(std::uint64_t at) const override {
        const auto length = little_endian<std::uint64_t>(file().read(at + 1, 8).data());
        const std::uint64_t there = file().size() - at - kRecordHead;
        return file().read(at, kRecordHead + std::min(length, there));
    }

    std::vector<std::byte> read_chunk(std::uint64_t at) const override {
        const auto bytes = record_at(at);
        const ChunkRecord chunk = parse_chunk(std::span(bytes).subspan(kRecordHead));
        return decompress(chunk.compression, chunk.bytes, chunk.size).bytes;
    }

    /// Reads schemas and channels from the summary, which repeats them; so those of damaged chunks
    /// are known, too.
    void read_summary(McapReader& reader) const {
        constexpr std::uint64_t kFooterBytes = kRecordHead + 20, kCrcBytes = 4;
        constexpr std::uint64_t kEnd = kFooterBytes + kMcapMagic.size();
        // Limit, because the summary is optional.
        constexpr std::uint64_t kMost = std::uint64_t{64} << 20U;
        if (file().size() < kMcapMagic.size() + kEnd) return;
        const std::uint64_t end = file().size() - kEnd;
        const auto footer = file().read(end, kFooterBytes);
        const auto start = little_endian<std::uint64_t>(footer.data() + kRecordHead);
        const auto crc = little_endian<std::uint32_t>(footer.data() + kFooterBytes - kCrcBytes);
        if (static_cast<McapOpcode>(footer[0]) != McapOpcode::footer) return;
        if (start == 0 || start >= end || end - start > kMost) return;
        const auto bytes = file().read(start, end + kFooterBytes - kCrcBytes - start);
        if (crc != 0 && crc_of(bytes) != crc) return;
        try {
            ByteReader in({bytes.data(), end - start});
            while (in.left() > 0) {
                const McapRecord record = read_mcap_record(in);
                const bool wanted =
                    record.opcode == McapOpcode::schema || record.opcode == McapOpcode::channel;
                if (wanted) reader.use(record, kNoChunk, start);
            }
        } catch (const Malformed&) {
        }
    }

    static void use_chunk(std::span<const std::byte> content, std::uint64_t at, McapReader& reader,
                          std::vector<Defect>& defects) {
        const auto note = [&](const std::string& what) {
            defects.push_back({fmt::format("the chunk at byte {} {}", at, what)});
        };
        try {
            const ChunkRecord chunk = parse_chunk(content);
            const Decompressed inner = decompress(chunk.compression, chunk.bytes, chunk.size);
            if (!inner.complete) {
                note(fmt::format("should hold {} bytes, but gave only {}", chunk.size,
                                 inner.bytes.size()));
            } else if (chunk.crc != 0 && crc_of(inner.bytes) != chunk.crc) {
                return note("is damaged (its checksum differs) and was left out");
            }
            ByteReader in(inner.bytes);
            while (in.left() > 0) {
                const std::size_t offset = in.at();
                const McapRecord record = read_mcap_record(in);
                if (record.opcode == McapOpcode::chunk) {
                    note("holds another chunk, which is left out: chunks do not nest");
                } else {
                    reader.use(record, at, offset);
                }
            }
        } catch (const Malformed& error) {
            note(error.what());
        }
    }
};

}  // namespace

std::unique_ptr<BagFile> open_mcap(const std::filesystem::path& file) {
    return std::make_unique<Mcap>(file);
}

}  // namespace dynamic_filter::io
