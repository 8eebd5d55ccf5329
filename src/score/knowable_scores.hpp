// SPDX-License-Identifier: MIT
/// How much a result removed of what could be known: of the dynamic points and voxels through which
/// somebody saw, and of the things that somebody saw move.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "dynamic_filter/scores.hpp"
#include "geometry/knowable.hpp"

namespace dynamic_filter::eval {

/// Dynamic points and voxels of one kind, and those of them that the result removed.
struct Removed {
    std::size_t points = 0, removed_points = 0;
    std::size_t voxels = 0, removed_voxels = 0;

    /// Shares 0..1; empty if there are none.
    [[nodiscard]] std::optional<double> point_share() const;
    [[nodiscard]] std::optional<double> rr() const;
};

/// A part of what is dynamic, by what could be known of it.
struct KnowableGroup {
    const char* name;   ///< in JSON
    const char* title;  ///< in a table
    bool (*holds)(const KnowablePoint&);
};

/// All, by beams, by state, and what is knowable: at least 3 beams passed, or the thing was seen to
/// move.
std::vector<KnowableGroup> knowable_groups();

/// The fewest beams of each bin; it reaches to the next one.
constexpr std::array<std::uint16_t, 6> kBeamBins{0, 1, 3, 10, 30, 100};

struct KnowableScores {
    std::vector<Removed> groups;                 ///< parallel to knowable_groups()
    std::array<Removed, kBeamBins.size()> bins;  ///< by beams
};

/// Returns what could be known of scan i, parallel to its points, of which the number is given.
using KnowableSource = std::function<std::vector<KnowablePoint>(std::size_t, std::size_t)>;

/// Scores the verdicts on `scans` scans. Points are counted one by one, and voxels as for RR with
/// mixed voxels left out: a voxel is removed if all of its points are. It has the fewest beams of
/// its points, and the state of them that tells least.
KnowableScores score_knowable(std::size_t scans, const ScanSource& source,
                              const KnowableSource& knowable, double voxel_size);

}  // namespace dynamic_filter::eval
