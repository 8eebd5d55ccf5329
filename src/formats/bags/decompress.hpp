// SPDX-License-Identifier: MIT
/// Decompression of bags, safe for untrusted bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace dynamic_filter::io {

/// The content that could be decompressed: all of it, or the part before the damage.
struct Decompressed {
    std::vector<std::byte> bytes;
    bool complete = false;
};

/// Decompresses bytes. `name` is the compression as named in files: "" or "none", "zstd", "lz4" (a
/// frame or a bare block), "bz2". `size` is the declared size of the content. Memory grows with the
/// real output, and never beyond `size`, nor beyond 64 MiB and 1,000 times the input. Throws
/// Malformed for an unknown name.
Decompressed decompress(std::string_view name, std::span<const std::byte> bytes,
                        std::uint64_t size);

}  // namespace dynamic_filter::io
