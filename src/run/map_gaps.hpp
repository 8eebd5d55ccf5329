// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <utility>
#include <vector>

#include "dynamic_filter/types.hpp"

namespace dynamic_filter::app {

/// Points of a scan that have a label but are no measurement, so that no map holds them: pairs of
/// first index and count. With it each record of the maps can be traced to its scan.
using Gaps = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

Gaps gaps_of(const Points& points);

inline constexpr const char* kGapsFile = "map_gaps.bin";

/// Writes for each scan in order: uint32 number of pairs, then the pairs as uint32, little endian.
/// Writes no file if no scan has gaps. Throws OutputError.
void write_gaps(const std::filesystem::path& folder, const std::vector<Gaps>& scans);
/// Empty where there is no file. Throws InputError if it is damaged.
std::vector<Gaps> read_gaps(const std::filesystem::path& folder);

}  // namespace dynamic_filter::app
