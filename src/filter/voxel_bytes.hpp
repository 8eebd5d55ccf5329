// SPDX-License-Identifier: MIT
/// Bytes of memory that a voxel needs with the default preset, measured. They differ by what is
/// counted, and each is larger than the one before it.
#pragma once

#include <cstddef>

namespace dynamic_filter {

/// In the map of a DynamicFilter: its place in the index and its evidence.
inline constexpr std::size_t kVoxelBytes = 92;
/// In addition after finish(): its decision.
inline constexpr std::size_t kDecidedVoxelBytes = 8;
/// In the map of an OnlineFilter, with the reserve of its containers while it grows. So
/// OnlineOptions::max_bytes is counted.
inline constexpr std::size_t kOnlineVoxelBytes = 172;
/// At the end of a tile of a run: with its decision, its scores, and what writing them needs.
inline constexpr std::size_t kTileVoxelBytes = 520;

static_assert(kVoxelBytes + kDecidedVoxelBytes < kOnlineVoxelBytes &&
              kOnlineVoxelBytes < kTileVoxelBytes);

}  // namespace dynamic_filter
