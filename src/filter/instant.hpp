// SPDX-License-Identifier: MIT
/// Instant verdicts: verdicts from the evidence up to the newest scan.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "dynamic_filter/filter.hpp"
#include "dynamic_filter/settings.hpp"
#include "filter/evidence_grid.hpp"

namespace dynamic_filter {

/// Stores the latest verdict of each voxel. A voxel is judged again only when its own score has
/// changed enough; most voxels keep their verdict. Single caller.
class InstantVerdicts {
public:
    explicit InstantVerdicts(const Config& config)
        : config_(config.scans), threshold_(config.map.occupancy_threshold) {}

    /// The verdict on the scan that was last added to the grid; `voxels` are those of its points.
    Verdict judge(std::size_t index, const PointVoxels& voxels, const EvidenceGrid& grid);

    /// Renumbers the voxels: only those with the old numbers `kept` remain, in that order.
    void keep(std::span<const std::uint32_t> kept);

private:
    struct Said {
        // Score at the latest verdict; 2 is above all scores, so it means "never judged".
        float score = 2.0F;
        Label label = Label::unknown;
        std::uint8_t probability = 0;  // of being occupied, in 1/255
    };
    [[nodiscard]] bool is_due(const Said& said, const EvidenceGrid::State& state) const;

    ScansConfig config_;
    double threshold_;
    std::vector<Said> said_;  // by voxel
};

}  // namespace dynamic_filter
