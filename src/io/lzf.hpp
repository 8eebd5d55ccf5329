// SPDX-License-Identifier: MIT
/// LZF as PCD's binary_compressed uses it.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace dynamic_filter::io {

/// The densest code is 3 bytes for a repeat of 264: no stream expands further than that.
constexpr std::size_t lzf_most_expansion = 88;

/// Expands `input` to exactly `size` bytes; nothing if it is damaged or of another size.
/// Nothing is allocated for a size that `input` is too short to fill.
std::optional<std::vector<std::byte>> lzf_expand(std::span<const std::byte> input,
                                                 std::size_t size);

/// What lzf_expand makes `input` of again; up to 1/32 longer than it. At most 2^32 - 1 bytes.
std::vector<std::byte> lzf_pack(std::span<const std::byte> input);

}  // namespace dynamic_filter::io
