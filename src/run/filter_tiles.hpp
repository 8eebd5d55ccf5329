// SPDX-License-Identifier: MIT
/// Filters many tiles, several at a time, within a limit of memory.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "run/filter_tile.hpp"
#include "run/workers.hpp"

namespace dynamic_filter::app {

/// [bytes] Estimated for a tile while it is filtered.
std::size_t memory_of(const TileWork& work, const Plan& plan, const Config& config);

/// [bytes] Estimated for a process that filters a tile of so much memory.
std::size_t process_memory(std::size_t tile);

/// Reads "1.5G", "800M" or a number of bytes; empty: half of the machine's memory. Throws
/// ConfigError.
std::size_t memory_limit_of(const std::string& text);

struct Effort {
    int threads = 0;         ///< 0: all cores
    std::size_t memory = 0;  ///< [bytes] limit
    bool quiet = false;
};

/// How many tiles are filtered at the same time. Throws ConfigError if the memory is too small for
/// one; the message says what to do.
std::size_t tiles_at_a_time(const Job& job, const std::vector<std::size_t>& tiles,
                            const Effort& effort);

/// Filters those of the tiles (indices in the plan) that are not in `folder` yet; all processes of
/// `workers` share them out, and each filters `at_a_time` of them at the same time. False if it was
/// interrupted.
bool filter_tiles(const Job& job, const std::vector<std::size_t>& tiles, std::size_t at_a_time,
                  const std::filesystem::path& folder, Workers& workers, const Effort& effort);

}  // namespace dynamic_filter::app
