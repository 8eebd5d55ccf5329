// SPDX-License-Identifier: MIT
/// Instant verdicts, from the evidence so far.
#pragma once

#include <span>
#include <vector>

#include "dynamic_filter/config.hpp"
#include "dynamic_filter/scans_observe/evidence_grid.hpp"
#include "dynamic_filter/verdict.hpp"

namespace dynamic_filter {

/// What was said of each voxel last. A voxel is judged anew when its own score has changed; most
/// say what they said. Single caller.
class InstantVerdicts {
public:
    explicit InstantVerdicts(const Config& config)
        : config_(config.scans), threshold_(config.map.occupancy_threshold) {}

    /// The verdict on the scan that the grid took in last; `voxels`: of its points.
    Verdict judge(std::size_t index, const PointVoxels& voxels, const EvidenceGrid& grid);

    /// Voxels got new numbers: those of the old numbers `kept` are left, in that order.
    void keep(std::span<const std::uint32_t> kept);

private:
    struct Said {
        float score = 2.0F;  // when it was judged last; none is as large
        Label label = Label::unknown;
    };
    [[nodiscard]] bool is_due(const Said& said, const EvidenceGrid::State& state) const;

    ScansConfig config_;
    double threshold_;
    std::vector<Said> said_;  // by voxel
};

}  // namespace dynamic_filter
