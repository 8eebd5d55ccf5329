// SPDX-License-Identifier: MIT
/// What the reader and the writer of MCAP files share. Format: https://mcap.dev/spec
#pragma once

#include <cstdint>
#include <string_view>

namespace dynamic_filter::io {

constexpr std::string_view kMcapMagic{"\x89MCAP0\r\n", 8};

enum class McapOpcode : std::uint8_t {
    header = 0x01,
    footer,
    schema,
    channel,
    message,
    chunk,
    message_index,
    chunk_index,
    statistics = 0x0B,
    summary_offset = 0x0E,
    data_end
};

}  // namespace dynamic_filter::io
