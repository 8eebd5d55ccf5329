// SPDX-License-Identifier: MIT
/// What the drives of a run saw of a tile, as a file, so that `run --update` goes on with the next
/// drive and need not filter the earlier ones again.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "run/job.hpp"
#include "run/tile_file.hpp"
#include "run/tile_map.hpp"

namespace dynamic_filter::app {

inline constexpr const char* kEvidenceFolder = "evidence";  ///< of a result, also of its plan
inline std::string evidence_file(const Tile& tile) { return name_of(tile) + ".evidence"; }

/// The pose file of a drive, if it has one of its own. That of the run may change, or go.
inline std::string evidence_poses_file(std::size_t drive) {
    return "poses_" + std::to_string(drive + 1) + ".txt";
}

/// Scans after a jump of the poses are filtered on their own, and a drive that comes later changes
/// nothing about them.
struct TileEvidence {
    std::vector<std::byte> filter;  ///< DynamicFilter::evidence() of the scans before any jump
    std::optional<Sightings> seen;  ///< of the same; empty if there are no such scans
    TileSummary of_filter;          ///< counts of the same: its voxels come first in the map
    TileSummary of_all;             ///< of the whole tile
};

/// What the evidence of the first `drives` drives on a tile depends on.
std::string evidence_mark(const Job& job, const TileWork& work, std::size_t drives);

void write_evidence(const std::filesystem::path& file, TileEvidence evidence,
                    const std::string& mark);
/// Empty if there is no such file, or if it is damaged or of other drives or settings.
std::optional<TileEvidence> read_evidence(const std::filesystem::path& file,
                                          const std::string& mark);

}  // namespace dynamic_filter::app
