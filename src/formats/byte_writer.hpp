// SPDX-License-Identifier: MIT
/// Writes little-endian values; the counterpart of ByteReader.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace dynamic_filter::io {

inline std::span<const std::byte> as_byte_span(std::string_view text) {
    return std::as_bytes(std::span(text));
}

struct ByteWriter {
    std::vector<std::byte> bytes;

    void raw(std::span<const std::byte> data);
    void raw(std::string_view text) { raw(as_byte_span(text)); }
    template <class T>
    requires std::integral<T> || std::floating_point<T>
    void number(T value) {
        raw(std::as_bytes(std::span(&value, 1)));  // all supported machines are little endian
    }
    /// Bytes with their length (32 bits) before them.
    void block(std::span<const std::byte> data) {
        number(static_cast<std::uint32_t>(data.size()));
        raw(data);
    }
    void text(std::string_view text) { block(as_byte_span(text)); }
};

}  // namespace dynamic_filter::io
