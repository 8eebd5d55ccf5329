// SPDX-License-Identifier: MIT
/// Reads little-endian values from untrusted bytes, never beyond their end.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "base/input.hpp"

namespace dynamic_filter::io {

/// A fault in the bytes. It does not name the file; the caller, who knows the file, makes an
/// InputError of it.
struct Malformed : std::runtime_error {
    using std::runtime_error::runtime_error;
};

template <class T>
requires std::integral<T> || std::floating_point<T> T little_endian(const std::byte* bytes) {
    T value{};
    std::memcpy(&value, bytes, sizeof value);
    return value;  // all supported machines are little endian
}

class ByteReader {
public:
    explicit ByteReader(std::span<const std::byte> bytes, std::size_t at = 0)
        : bytes_(bytes), at_(at) {}

    [[nodiscard]] std::size_t at() const { return at_; }
    [[nodiscard]] std::size_t left() const { return bytes_.size() - at_; }

    std::span<const std::byte> read(std::uint64_t count) {
        if (count > left()) {
            throw Malformed("ends at byte " + std::to_string(bytes_.size()) + ", but " +
                            std::to_string(count) + " bytes should follow byte " +
                            std::to_string(at_));
        }
        const auto taken = bytes_.subspan(at_, static_cast<std::size_t>(count));
        at_ += taken.size();
        return taken;
    }
    template <class T>
    T number() {
        return little_endian<T>(read(sizeof(T)).data());
    }
    std::string_view text(std::uint64_t length) { return as_text(read(length)); }
    /// Bytes with their length (32 bits) before them.
    std::span<const std::byte> block() { return read(number<std::uint32_t>()); }
    std::string_view text() { return as_text(block()); }

private:
    std::span<const std::byte> bytes_;
    std::size_t at_;
};

}  // namespace dynamic_filter::io
