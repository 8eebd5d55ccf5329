// SPDX-License-Identifier: MIT
/// Reads the fields of a message in order. ROS 1 stores them without alignment, CDR (ROS 2) with
/// alignment.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>

#include "dynamic_filter/bag.hpp"
#include "formats/byte_reader.hpp"

namespace dynamic_filter::io {

/// Throws Malformed if the message ends too early.
class MessageReader {
public:
    MessageReader(std::span<const std::byte> data, MessageEncoding encoding)
        : in_(data), cdr_(encoding == MessageEncoding::cdr) {
        if (!cdr_) return;
        in_.read(1);
        const auto kind = in_.number<std::uint8_t>();  // 0, 1: plain; 6, 7: plain, version 2
        in_.read(2);
        if (kind != 0 && kind != 1 && kind != 6 && kind != 7) {
            throw Malformed("is CDR of a kind that is not read (" + std::to_string(kind) + ")");
        }
        big_endian_ = kind % 2 == 0;
        most_aligned_ = kind >= 6 ? 4 : 8;
    }

    template <class T>
    T number() {
        align(sizeof(T));
        const auto bytes = in_.read(sizeof(T));
        if (!big_endian_) return little_endian<T>(bytes.data());
        std::array<std::byte, sizeof(T)> turned;
        std::reverse_copy(bytes.begin(), bytes.end(), turned.begin());
        return little_endian<T>(turned.data());
    }
    std::string text() {
        std::string_view raw = as_text(in_.read(number<std::uint32_t>()));
        if (cdr_ && raw.ends_with('\0')) raw.remove_suffix(1);
        return std::string(raw);
    }
    /// The bytes of a uint8 array.
    std::span<const std::byte> bytes() { return in_.read(number<std::uint32_t>()); }
    /// Number of the elements that follow. Throws if the message is too short for them, at
    /// `least_bytes` per element.
    std::uint32_t count(std::size_t least_bytes) {
        const auto count = number<std::uint32_t>();
        if (count > in_.left() / least_bytes) {
            throw Malformed("announces " + std::to_string(count) + " elements, but only " +
                            std::to_string(in_.left()) + " bytes are left");
        }
        return count;
    }

private:
    void align(std::size_t size) {
        if (!cdr_) return;
        constexpr std::size_t kHead = 4;  // alignment is counted from the end of this header
        const std::size_t step = std::min(size, most_aligned_), at = in_.at() - kHead;
        in_.read((step - at % step) % step);
    }

    ByteReader in_;
    bool cdr_, big_endian_ = false;
    std::size_t most_aligned_ = 8;
};

}  // namespace dynamic_filter::io
