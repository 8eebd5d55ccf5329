// SPDX-License-Identifier: MIT
#include "dynamic_filter/scores.hpp"

#include "geometry/voxel_index.hpp"

namespace dynamic_filter::eval {

namespace {

enum class Kind { still, dynamic, neither };

/// Kind of a voxel of the raw map under one way to count mixed voxels.
using Reading = Kind (*)(const VoxelCount&);

Kind excluded(const VoxelCount& v) {
    if (v.still > 0 && v.dynamic > 0) return Kind::neither;
    return v.dynamic > 0 ? Kind::dynamic : Kind::still;
}

Kind static_wins(const VoxelCount& v) { return v.still > 0 ? Kind::still : Kind::dynamic; }

Kind majority(const VoxelCount& v) { return v.still >= v.dynamic ? Kind::still : Kind::dynamic; }

void add_voxel(VoxelTotals& totals, Kind kind, bool kept) {
    if (kind == Kind::neither) return;
    (kind == Kind::still ? totals.static_total : totals.dynamic_total) += 1;
    if (kept) (kind == Kind::still ? totals.static_kept : totals.dynamic_kept) += 1;
}

/// The counts of the raw map and of one result; the counts of a voxel are stored next to each
/// other.
struct Counts {
    const std::vector<VoxelCount>& all;
    std::size_t stride, result;
    [[nodiscard]] std::size_t voxels() const { return all.size() / stride; }
    [[nodiscard]] const VoxelCount& raw(std::size_t v) const { return all[v * stride]; }
    [[nodiscard]] VoxelCount kept(std::size_t v) const {
        VoxelCount kept = raw(v);
        const VoxelCount& removed = all[v * stride + 1 + result];
        kept.still -= removed.still;
        kept.dynamic -= removed.dynamic;
        kept.unlabelled = removed.unlabelled;  // add_map_point() counts them as removed
        return kept;
    }
};

VoxelTotals read(const Counts& counts, Reading reading) {
    VoxelTotals totals;
    for (std::size_t v = 0; v < counts.voxels(); ++v) {
        add_voxel(totals, reading(counts.raw(v)), counts.kept(v).has_points());
    }
    return totals;
}

void count(VoxelCount& voxel, Label truth) {
    (truth == Label::dynamic ? voxel.dynamic : voxel.still) += 1;
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

void VoxelTotals::add(const VoxelTotals& other) {
    static_total += other.static_total;
    static_kept += other.static_kept;
    dynamic_total += other.dynamic_total;
    dynamic_kept += other.dynamic_kept;
}

VoxelScore VoxelTotals::score() const {
    const auto number = [](std::size_t n) { return static_cast<double>(n); };
    return voxel_score(number(static_total), number(static_kept), number(dynamic_total),
                       number(dynamic_kept));
}

VoxelTally::VoxelTally(double voxel_size, std::size_t results, double shift)
    : voxel_size_(voxel_size),
      shift_(Point::Constant(static_cast<float>(shift))),
      index_(std::make_unique<VoxelIndex>()),
      stride_(1 + results) {}
VoxelTally::VoxelTally(VoxelTally&&) noexcept = default;
VoxelTally::~VoxelTally() = default;

void VoxelTally::add(std::span<const TruePoint> points) {
    std::vector<VoxelKey> keys;
    std::vector<const TruePoint*> of_keys;
    for (const TruePoint& p : points) {
        const auto cell = cell_of(p.point - shift_, static_cast<float>(1.0 / voxel_size_));
        if (!cell) continue;
        keys.push_back(pack(*cell));
        of_keys.push_back(&p);
    }
    std::vector<std::uint32_t> voxels(keys.size());
    index_->insert(keys, voxels);
    counts_.resize(stride_ * index_->size());
    for (std::size_t i = 0; i < voxels.size(); ++i) {
        constexpr std::size_t kAhead = 8;  // points whose voxels are prefetched
        if (i + kAhead < voxels.size()) __builtin_prefetch(&counts_[stride_ * voxels[i + kAhead]]);
        const TruePoint& p = *of_keys[i];
        VoxelCount* const of_voxel = &counts_[stride_ * voxels[i]];
        count(of_voxel[0], p.truth);
        for (std::size_t r = 0; r + 1 < stride_; ++r) {
            if ((p.removed >> r & 1U) != 0) count(of_voxel[1 + r], p.truth);
        }
    }
}

void VoxelTally::add_map_point(const Point& point) {
    const auto cell = cell_of(point - shift_, static_cast<float>(1.0 / voxel_size_));
    const auto id = cell ? index_->find(pack(*cell)) : std::nullopt;
    if (id) counts_[*id * stride_ + 1].unlabelled += 1;
}

std::map<std::string, VoxelTotals> VoxelTally::totals(std::size_t result) const {
    const Counts counts{counts_, stride_, result};
    return {{"excluded", read(counts, excluded)},
            {"static_wins", read(counts, static_wins)},
            {"majority", read(counts, majority)}};
}

std::map<std::string, VoxelScore> VoxelTally::scores(std::size_t result) const {
    std::map<std::string, VoxelScore> scores;
    for (const auto& [reading, numbers] : totals(result)) scores[reading] = numbers.score();
    return scores;
}

std::size_t VoxelTally::voxels() const { return index_->size(); }

std::size_t VoxelTally::dynamic_voxels() const {
    const Counts counts{counts_, stride_, 0};
    std::size_t dynamic = 0;
    for (std::size_t v = 0; v < counts.voxels(); ++v) dynamic += counts.raw(v).dynamic > 0 ? 1 : 0;
    return dynamic;
}

}  // namespace dynamic_filter::eval
