// SPDX-License-Identifier: MIT
/// Bags put together by hand, for what the writers do not write.
#pragma once

#include <bzlib.h>
#include <lz4.h>
#include <lz4frame.h>
#include <zlib.h>
#include <zstd.h>

#include <optional>

#include "support/bag_support.hpp"

namespace dynamic_filter::io {

/// `kind`: "", "none", "zstd", "lz4" (a frame), "lz4 block", "bz2".
inline std::string packed(const std::string& kind, const std::string& plain) {
    std::string out(2 * plain.size() + 1000, '\0');
    std::size_t size = 0;
    if (kind == "zstd") {
        size = ZSTD_compress(out.data(), out.size(), plain.data(), plain.size(), 1);
    } else if (kind == "lz4") {
        size = LZ4F_compressFrame(out.data(), out.size(), plain.data(), plain.size(), nullptr);
    } else if (kind == "lz4 block") {
        size = static_cast<std::size_t>(LZ4_compress_default(plain.data(), out.data(),
                                                             static_cast<int>(plain.size()),
                                                             static_cast<int>(out.size())));
    } else if (kind == "bz2") {
        auto length = static_cast<unsigned>(out.size());
        std::string copy = plain;
        BZ2_bzBuffToBuffCompress(out.data(), &length, copy.data(),
                                 static_cast<unsigned>(copy.size()), 9, 0, 0);
        size = length;
    } else {
        return plain;
    }
    return out.substr(0, size);
}
inline std::string name_of(const std::string& kind) { return kind == "lz4 block" ? "lz4" : kind; }

inline std::string text_of(const ByteWriter& out) {
    return {reinterpret_cast<const char*>(out.bytes.data()), out.bytes.size()};
}
inline std::string behind_length(const std::string& text) {
    return bytes_of(static_cast<std::uint32_t>(text.size())) + text;
}

namespace mcap {

inline const std::string magic{"\x89MCAP0\r\n", 8};

inline std::string record(int opcode, const std::string& content) {
    return static_cast<char>(opcode) + bytes_of(std::uint64_t{content.size()}) + content;
}
inline std::string schema(int id, const std::string& name) {
    return record(3, bytes_of(static_cast<std::uint16_t>(id)) + behind_length(name) +
                         behind_length("ros2msg") + behind_length(""));
}
inline std::string channel(int id, int schema, const std::string& topic,
                           const std::string& encoding = "cdr") {
    return record(4, bytes_of(static_cast<std::uint16_t>(id)) +
                         bytes_of(static_cast<std::uint16_t>(schema)) + behind_length(topic) +
                         behind_length(encoding) + behind_length(""));
}
inline std::string message(int channel, std::uint64_t time, const std::string& data) {
    return record(5, bytes_of(static_cast<std::uint16_t>(channel)) + bytes_of(std::uint32_t{0}) +
                         bytes_of(time) + bytes_of(time) + data);
}
inline std::string chunk(const std::string& kind, const std::string& records,
                         std::optional<std::uint64_t> size = {}, bool with_crc = true) {
    const std::string inner = packed(kind, records);
    const auto crc = static_cast<std::uint32_t>(
        crc32_z(0, reinterpret_cast<const Bytef*>(records.data()), records.size()));
    return record(6, bytes_of(std::uint64_t{0}) + bytes_of(std::uint64_t{0}) +
                         bytes_of(size.value_or(records.size())) +
                         bytes_of(with_crc ? crc : std::uint32_t{0}) +
                         behind_length(name_of(kind)) + bytes_of(std::uint64_t{inner.size()}) +
                         inner);
}
inline std::string file(const std::string& records) {
    const std::string head = record(1, behind_length("ros2") + behind_length(""));
    return magic + head + records + record(0x0F, std::string(4, '\0')) +
           record(2, std::string(20, '\0')) + magic;
}

}  // namespace mcap

namespace rosbag1 {

inline const std::string magic = "#ROSBAG V2.0\n";

inline std::string field(const std::string& name, const std::string& value) {
    return behind_length(name + "=" + value);
}
inline std::string record(int opcode, const std::string& fields, const std::string& data) {
    return behind_length(field("op", std::string(1, static_cast<char>(opcode))) + fields) +
           behind_length(data);
}
inline std::string conn(std::uint32_t number) { return field("conn", bytes_of(number)); }
inline std::string connection(std::uint32_t number, const std::string& topic,
                              const std::string& type) {
    return record(7, conn(number) + field("topic", topic),
                  field("topic", topic) + field("type", type) + field("md5sum", "*"));
}
inline std::string message(std::uint32_t connection, std::uint32_t seconds,
                           const std::string& data) {
    const std::string time = bytes_of(seconds) + bytes_of(std::uint32_t{0});
    return record(2, conn(connection) + field("time", time), data);
}
inline std::string chunk(const std::string& kind, const std::string& records,
                         std::optional<std::uint32_t> size = {}) {
    const auto plain = size.value_or(static_cast<std::uint32_t>(records.size()));
    return record(5, field("compression", name_of(kind)) + field("size", bytes_of(plain)),
                  packed(kind, records));
}
/// Closed, with an empty index.
inline std::string file(const std::string& records) {
    const auto head = [&](std::uint64_t index_at) {
        return magic + record(3,
                              field("index_pos", bytes_of(index_at)) +
                                  field("conn_count", bytes_of(std::uint32_t{0})) +
                                  field("chunk_count", bytes_of(std::uint32_t{0})),
                              "  ");
    };
    return head(head(0).size() + records.size()) + records;
}

}  // namespace rosbag1

}  // namespace dynamic_filter::io
