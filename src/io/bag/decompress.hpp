// SPDX-License-Identifier: MIT
/// The compressions of bags, for untrusted bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace dynamic_filter::io {

/// What of the content could be had: all of it, or what came before the damage.
struct Decompressed {
    std::vector<std::byte> bytes;
    bool complete = false;
};

/// `name` as files have it: "" or "none", "zstd", "lz4" (a frame, or a bare block), "bz2". `size`
/// is what the file says the content has. Memory grows with what really comes out, never beyond
/// `size`, nor beyond 64 MiB and 1,000 times the input. Throws Malformed for an unknown name.
Decompressed decompress(std::string_view name, std::span<const std::byte> bytes,
                        std::uint64_t size);

}  // namespace dynamic_filter::io
