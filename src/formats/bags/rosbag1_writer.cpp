// SPDX-License-Identifier: MIT
// Format: ROS bag 2.0. Chunks are lz4 frames of the kind that ROS can read.
#include <fmt/format.h>
#include <lz4frame.h>

#include <algorithm>
#include <limits>
#include <map>

#include "dynamic_filter/error.hpp"
#include "dynamic_filter/file.hpp"
#include "formats/bags/bag_writers.hpp"
#include "formats/bags/rosbag1_format.hpp"
#include "formats/byte_writer.hpp"
#include "formats/messages/definitions.hpp"
#include "formats/time_units.hpp"

namespace dynamic_filter::io {
namespace {

constexpr std::size_t kBagHeaderBytes = 4096;

/// Header of a record: name=value fields, each with its length before it.
struct Fields {
    ByteWriter out;
    Fields& text(std::string_view name, std::string_view value) {
        out.number(static_cast<std::uint32_t>(name.size() + 1 + value.size()));
        out.raw(name);
        out.raw("=");
        out.raw(value);
        return *this;
    }
    template <class T>
    Fields& number(std::string_view name, T value) {
        const auto bytes = std::as_bytes(std::span(&value, 1));
        return text(name, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    }
};
Fields fields(Rosbag1Opcode opcode) {
    Fields head;
    head.number("op", static_cast<std::uint8_t>(opcode));
    return head;
}

void put_record(ByteWriter& out, const Fields& head, std::span<const std::byte> data) {
    out.block(head.out.bytes);
    out.block(data);
}

/// Seconds and nanoseconds in 32 bits each.
std::uint64_t wire_time(std::int64_t time_ns) {
    return static_cast<std::uint64_t>(time_ns / kSecond) |
           static_cast<std::uint64_t>(time_ns % kSecond) << 32U;
}

struct Rosbag1IndexEntry {
    std::int64_t time = 0;
    std::uint32_t offset = 0;
};
struct OpenRosbag1Chunk {
    ByteWriter records;
    std::int64_t first = std::numeric_limits<std::int64_t>::max(), last = 0;
    std::map<std::uint32_t, std::vector<Rosbag1IndexEntry>> index;  // per connection
};

void put_connection(ByteWriter& out, std::uint32_t number, const Topic& topic) {
    Fields connection;
    connection.text("topic", topic.name)
        .text("type", topic.type)
        .text("md5sum", find_definition(topic.type)->md5)
        .text("message_definition", full_definition(topic.type, MessageEncoding::ros1));
    if (is_latched(topic)) connection.text("latching", "1");
    put_record(out,
               fields(Rosbag1Opcode::connection).number("conn", number).text("topic", topic.name),
               connection.out.bytes);
}

std::vector<std::byte> lz4_frame(std::span<const std::byte> plain,
                                 const std::filesystem::path& path) {
    LZ4F_preferences_t preferences{};
    preferences.frameInfo.blockMode = LZ4F_blockIndependent;  // ROS reads no other mode
    preferences.frameInfo.blockSizeID = LZ4F_max1MB;
    preferences.frameInfo.contentChecksumFlag = LZ4F_contentChecksumEnabled;
    std::vector<std::byte> packed(LZ4F_compressFrameBound(plain.size(), &preferences));
    const std::size_t size =
        LZ4F_compressFrame(packed.data(), packed.size(), plain.data(), plain.size(), &preferences);
    if (LZ4F_isError(size) != 0) {
        throw OutputError(path, fmt::format("cannot be compressed: {}", LZ4F_getErrorName(size)));
    }
    packed.resize(size);
    return packed;
}

class Rosbag1Writer final : public BagWriter {
public:
    explicit Rosbag1Writer(const std::filesystem::path& path)
        : path_(path), file_(path), topics_(path, MessageEncoding::ros1) {
        put(as_byte_span(kRosbag1Magic));
        put(bag_header(0).bytes);
    }

    [[nodiscard]] MessageEncoding encoding() const override { return MessageEncoding::ros1; }

    void write(const Topic& topic, std::int64_t time_ns, std::span<const std::byte> data) override {
        check(time_ns, data.size());
        const auto [number, is_new] = topics_.number_of(topic);
        const auto connection = static_cast<std::uint32_t>(number);
        if (is_new) put_connection(chunk_.records, connection, topic);
        chunk_.index[connection].push_back(
            {time_ns, static_cast<std::uint32_t>(chunk_.records.bytes.size())});
        chunk_.first = std::min(chunk_.first, time_ns);
        chunk_.last = std::max(chunk_.last, time_ns);
        put_record(chunk_.records,
                   fields(Rosbag1Opcode::message)
                       .number("conn", connection)
                       .number("time", wire_time(time_ns)),
                   data);
        if (chunk_.records.bytes.size() >= kChunkBytes) put_chunk();
    }

    void commit() override {
        if (!chunk_.records.bytes.empty()) put_chunk();
        const std::uint64_t index_at = at_;
        ByteWriter connections;
        for (std::uint32_t i = 0; i < topics_.all().size(); ++i) {
            put_connection(connections, i, topics_.all()[i]);
        }
        put(connections.bytes);
        put(chunk_infos_.bytes);
        const ByteWriter header = bag_header(index_at);
        file_.rewrite(kRosbag1Magic.size(),
                      {reinterpret_cast<const char*>(header.bytes.data()), header.bytes.size()});
        file_.commit();
    }

private:
    /// The format stores sizes and seconds in 32 bits.
    void check(std::int64_t time_ns, std::size_t size) const {
        check_time(path_, time_ns);
        constexpr std::int64_t kMostSeconds = std::numeric_limits<std::uint32_t>::max();
        constexpr std::size_t kMostBytes =
            std::numeric_limits<std::uint32_t>::max() - 2 * kChunkBytes;
        if (time_ns / kSecond > kMostSeconds) {
            throw OutputError(path_, fmt::format("a message of {} ns is too late for it", time_ns));
        }
        if (size > kMostBytes) {
            throw OutputError(path_, fmt::format("a message of {} bytes is too large", size));
        }
    }

    [[nodiscard]] ByteWriter bag_header(std::uint64_t index_at) const {
        const Fields head =
            fields(Rosbag1Opcode::bag_header)
                .number("index_pos", index_at)
                .number("conn_count", static_cast<std::uint32_t>(topics_.all().size()))
                .number("chunk_count", chunks_);
        constexpr std::size_t kLengths = 8;
        const std::string padding(kBagHeaderBytes - kLengths - head.out.bytes.size(), ' ');
        ByteWriter out;
        put_record(out, head, as_byte_span(padding));
        return out;
    }

    void put_chunk() {
        const std::vector<std::byte>& plain = chunk_.records.bytes;
        const std::vector<std::byte> packed = lz4_frame(plain, path_);
        const std::uint64_t begin = at_;
        ByteWriter out;
        out.block(fields(Rosbag1Opcode::chunk)
                      .text("compression", "lz4")
                      .number("size", static_cast<std::uint32_t>(plain.size()))
                      .out.bytes);
        out.number(static_cast<std::uint32_t>(packed.size()));
        put(out.bytes);
        put(packed);
        put_index();
        add_chunk_info(begin);
        chunk_ = {};
    }

    void put_index() {
        ByteWriter out;
        for (const auto& [connection, entries] : chunk_.index) {
            ByteWriter list;
            for (const Rosbag1IndexEntry& entry : entries) {
                list.number(wire_time(entry.time));
                list.number(entry.offset);
            }
            put_record(out,
                       fields(Rosbag1Opcode::index)
                           .number("ver", std::uint32_t{1})
                           .number("conn", connection)
                           .number("count", static_cast<std::uint32_t>(entries.size())),
                       list.bytes);
        }
        put(out.bytes);
    }

    void add_chunk_info(std::uint64_t chunk_at) {
        ByteWriter counts;
        for (const auto& [connection, entries] : chunk_.index) {
            counts.number(connection);
            counts.number(static_cast<std::uint32_t>(entries.size()));
        }
        put_record(chunk_infos_,
                   fields(Rosbag1Opcode::chunk_info)
                       .number("ver", std::uint32_t{1})
                       .number("chunk_pos", chunk_at)
                       .number("start_time", wire_time(chunk_.first))
                       .number("end_time", wire_time(chunk_.last))
                       .number("count", static_cast<std::uint32_t>(chunk_.index.size())),
                   counts.bytes);
        ++chunks_;
    }

    void put(std::span<const std::byte> bytes) {
        file_.write(bytes);
        at_ += bytes.size();
    }

    std::filesystem::path path_;
    AtomicFile file_;
    std::uint64_t at_ = 0;
    TopicTable topics_;
    OpenRosbag1Chunk chunk_;
    ByteWriter chunk_infos_;  // records for the end of the file
    std::uint32_t chunks_ = 0;
};

}  // namespace

std::unique_ptr<BagWriter> create_rosbag1(const std::filesystem::path& file) {
    return std::make_unique<Rosbag1Writer>(file);
}

}  // namespace dynamic_filter::io
