// SPDX-License-Identifier: MIT
/// LZF compression, as in binary_compressed of PCD.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace dynamic_filter::io {

/// The densest code is 3 bytes for a repeat of 264 bytes, so no stream expands more than this.
constexpr std::size_t lzf_most_expansion = 88;

/// Expands `input` to exactly `size` bytes; returns nothing if the input is damaged or has another
/// size. No memory is allocated for a size that `input` is too short to produce.
std::optional<std::vector<std::byte>> lzf_expand(std::span<const std::byte> input,
                                                 std::size_t size);

/// Compresses `input`, so that lzf_expand() restores it. The result is at most 1/32 longer than the
/// input. The input may have at most 2^32 - 1 bytes.
std::vector<std::byte> lzf_pack(std::span<const std::byte> input);

}  // namespace dynamic_filter::io
