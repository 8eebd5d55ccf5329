// SPDX-License-Identifier: MIT
/// Writes the fields of a message; the counterpart of MessageReader. CDR is written in little
/// endian.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "dynamic_filter/bag.hpp"
#include "formats/byte_writer.hpp"

namespace dynamic_filter::io {

class MessageWriter {
public:
    explicit MessageWriter(MessageEncoding encoding) : cdr_(encoding == MessageEncoding::cdr) {
        if (!cdr_) return;
        for (const int byte : {0, 1, 0, 0}) out_.number(static_cast<std::uint8_t>(byte));
    }

    [[nodiscard]] bool is_cdr() const { return cdr_; }
    template <class T>
    void number(T value) {
        if (cdr_) {
            constexpr std::size_t kHead = 4;  // alignment is counted from the end of this header
            while ((out_.bytes.size() - kHead) % sizeof(T) != 0) out_.bytes.push_back({});
        }
        out_.number(value);
    }
    void text(std::string_view text) {
        number(static_cast<std::uint32_t>(text.size() + (cdr_ ? 1 : 0)));
        out_.raw(text);
        if (cdr_) out_.bytes.push_back({});
    }
    /// Writes a uint8 array.
    void bytes(std::span<const std::byte> data) {
        number(static_cast<std::uint32_t>(data.size()));
        out_.raw(data);
    }
    std::vector<std::byte> moved_bytes() { return std::move(out_.bytes); }

private:
    ByteWriter out_;
    bool cdr_;
};

}  // namespace dynamic_filter::io
