// SPDX-License-Identifier: MIT
#include "dynamic_filter/eval/voxel_scores.hpp"

#include <cmath>

#include "dynamic_filter/geometry/neighbor_grid.hpp"
#include "dynamic_filter/geometry/voxel_index.hpp"

namespace dynamic_filter::eval {

namespace {

enum class Kind { still, dynamic, neither };

/// What a voxel of the raw map counts as under a reading of mixed voxels.
using Reading = Kind (*)(const VoxelCount&);

Kind excluded(const VoxelCount& v) {
    if (v.still > 0 && v.dynamic > 0) return Kind::neither;
    return v.dynamic > 0 ? Kind::dynamic : Kind::still;
}

Kind static_wins(const VoxelCount& v) { return v.still > 0 ? Kind::still : Kind::dynamic; }

Kind majority(const VoxelCount& v) { return v.still >= v.dynamic ? Kind::still : Kind::dynamic; }

struct Totals {
    double static_total = 0, static_kept = 0, dynamic_total = 0, dynamic_kept = 0;
    void add(Kind kind, bool kept) {
        if (kind == Kind::neither) return;
        (kind == Kind::still ? static_total : dynamic_total) += 1;
        if (kept) (kind == Kind::still ? static_kept : dynamic_kept) += 1;
    }
    [[nodiscard]] VoxelScore score() const {
        return voxel_score(static_total, static_kept, dynamic_total, dynamic_kept);
    }
};

VoxelScore read(const std::vector<VoxelCount>& counts, Reading reading) {
    Totals totals;
    for (const VoxelCount& v : counts) {
        if (v.still + v.dynamic > 0) totals.add(reading(v), v.preserved());
    }
    return totals.score();
}

Point mean(const Eigen::Vector3d& sum, std::uint32_t count) {
    return (sum / static_cast<double>(count)).cast<float>();
}

}  // namespace

VoxelScore voxel_score(double static_total, double static_kept, double dynamic_total,
                       double dynamic_kept) {
    VoxelScore score;
    if (static_total > 0) score.pr = static_kept / static_total;
    if (dynamic_total > 0) score.rr = 1.0 - dynamic_kept / dynamic_total;
    if (score.pr && score.rr) {
        const double sum = *score.pr + *score.rr;
        score.f1 = sum > 0 ? 2.0 * *score.pr * *score.rr / sum : 0.0;
    }
    return score;
}

VoxelTally::VoxelTally(double voxel_size)
    : voxel_size_(voxel_size), index_(std::make_unique<VoxelIndex>()) {}
VoxelTally::VoxelTally(VoxelTally&&) noexcept = default;
VoxelTally::~VoxelTally() = default;

VoxelCount* VoxelTally::find(const Point& point, bool insert) {
    const auto cell = cell_of(point, static_cast<float>(1.0 / voxel_size_));
    if (!cell) return nullptr;
    if (!insert) {
        const auto id = index_->find(pack(*cell));
        return id ? &counts_[*id] : nullptr;
    }
    const std::uint32_t id = index_->insert(pack(*cell));
    if (id == counts_.size()) counts_.emplace_back();
    return &counts_[id];
}

void VoxelTally::add(const Point& point, Label truth, bool kept) {
    VoxelCount* const v = find(point, true);
    if (v == nullptr) return;
    v->sum += point.cast<double>();
    (truth == Label::dynamic ? v->dynamic : v->still) += 1;
    if (!kept) return;
    v->kept_sum += point.cast<double>();
    (truth == Label::dynamic ? v->kept_dynamic : v->kept_still) += 1;
}

void VoxelTally::add_map_point(const Point& point) {
    unlabelled_ = true;
    if (VoxelCount* const v = find(point, false)) v->kept_unlabelled += 1;
}

std::map<std::string, VoxelScore> VoxelTally::scores() const {
    std::map<std::string, VoxelScore> result{{"excluded", read(counts_, excluded)},
                                             {"static_wins", read(counts_, static_wins)},
                                             {"majority", read(counts_, majority)}};
    if (!unlabelled_) result["erasor"] = erasor_score();
    return result;
}

VoxelScore VoxelTally::erasor_score() const {
    const auto radius = static_cast<float>(voxel_size_ * std::sqrt(3.0) / 2.0);
    Points kept;
    std::vector<Kind> kinds;
    for (const VoxelCount& v : counts_) {
        if (!v.preserved()) continue;
        kept.push_back(mean(v.kept_sum, v.kept_still + v.kept_dynamic));
        kinds.push_back(v.kept_still >= v.kept_dynamic ? Kind::still : Kind::dynamic);
    }
    const NeighborGrid grid(kept, radius);
    std::vector<Neighbor> nearest;
    Totals totals;
    for (const VoxelCount& v : counts_) {
        grid.nearest(mean(v.sum, v.still + v.dynamic), 1, nearest);
        const Kind kind = majority(v);
        totals.add(kind, !nearest.empty() && kinds[nearest.front().index] == kind);
    }
    return totals.score();
}

double VoxelTally::dynamic_share() const {
    double dynamic = 0;
    for (const VoxelCount& v : counts_) dynamic += v.dynamic > 0 ? 1 : 0;
    return counts_.empty() ? 0.0 : dynamic / static_cast<double>(counts_.size());
}

}  // namespace dynamic_filter::eval
