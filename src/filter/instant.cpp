// SPDX-License-Identifier: MIT
#include "filter/instant.hpp"

#include <cmath>
#include <utility>

#include "filter/method.hpp"
#include "filter/vote.hpp"

namespace dynamic_filter {

namespace {
constexpr float kSteps = 255.0F;  // of a stored probability
}  // namespace

bool InstantVerdicts::is_due(const Said& said, const EvidenceGrid::State& state) const {
    const bool same =
        std::abs(state.score - said.score) <= static_cast<float>(config_.vote.ask_again);
    if (!same) return true;
    return said.label == Label::unknown && !is_unknown(state.evidence);
}

Verdict InstantVerdicts::judge(std::size_t index, const PointVoxels& voxels,
                               const EvidenceGrid& grid) {
    said_.resize(grid.size());
    std::vector<std::uint32_t> due;
    for (std::size_t i = 0; i < voxels.size(); ++i) {
        constexpr std::size_t kAhead = 16;  // number of points for which voxels are prefetched
        if (i + kAhead < voxels.size() && voxels[i + kAhead] != kNoVoxel) {
            __builtin_prefetch(&grid[voxels[i + kAhead]]);
            __builtin_prefetch(&said_[voxels[i + kAhead]]);
        }
        const std::uint32_t voxel = voxels[i];
        if (voxel == kNoVoxel || !is_due(said_[voxel], grid[voxel])) continue;
        // Temporary label, so that the voxel is listed only once.
        said_[voxel] = {grid[voxel].score, Label::static_, 0};
        due.push_back(voxel);
    }
    const auto occupancy = occupancy_of(grid, due, config_);
    for (std::size_t i = 0; i < due.size(); ++i) {
        said_[due[i]].label = label_of(occupancy[i], threshold_);
        said_[due[i]].probability =
            static_cast<std::uint8_t>(std::lround(kSteps * occupancy[i].value_or(0.0F)));
    }
    Verdict verdict{index, Labels(voxels.size(), Label::unknown),
                    std::vector<float>(voxels.size(), 0.0F)};
    for (std::size_t i = 0; i < voxels.size(); ++i) {
        if (voxels[i] == kNoVoxel) continue;
        const Said& said = said_[voxels[i]];
        verdict.labels[i] = said.label;
        verdict.probability[i] = static_cast<float>(said.probability) / kSteps;
    }
    return verdict;
}

void InstantVerdicts::keep(std::span<const std::uint32_t> kept) {
    std::vector<Said> said;
    said.reserve(kept.size());
    for (const std::uint32_t v : kept) said.push_back(said_[v]);
    said_ = std::move(said);
}

}  // namespace dynamic_filter
