// SPDX-License-Identifier: MIT
#include "tracking/surface_map.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <optional>

namespace dynamic_filter {
namespace {

constexpr float kFewest = 5.0F;  // smallest number of points of a plane
// Largest number of points; older points have drifted less, so newer ones are not added.
constexpr float kMostPerPlane = 1000.0F;
constexpr float kNoise = 0.01F;  // [m] smallest roughness of a surface
// [m] largest roughness of a surface, with the uncertainty of its position.
constexpr float kRoughest = 0.5F;
// Share of the points, because errors of neighboring points are similar.
constexpr float kEffectiveShare = 0.1F;
// The plane is fitted again when the number of points has grown by this factor.
constexpr float kGrowth = 1.25F;

Point corner_of(VoxelKey key, float size) { return unpack(key).cast<float>() * size; }

}  // namespace

SurfaceMap::SurfaceMap(double finest, double narrowest)
    : narrowest_(static_cast<float>(narrowest)) {
    auto size = static_cast<float>(finest);
    for (Level& level : levels_) {
        level.size = size;
        size *= 2.0F;
    }
}

void SurfaceMap::insert(const Points& in_map) {
    const auto [keys, points] = keys_of(in_map, 1.0F / levels_.front().size);
    std::vector<std::uint32_t> voxels(keys.size());
    levels_.front().voxels.insert(keys, voxels);
    for (std::size_t l = 0; l < kLevels; ++l) {
        Level& level = levels_[l];
        link(l);
        add_points(level, in_map, points, voxels);
        if (level.parents.empty()) continue;
        for (std::uint32_t& voxel : voxels) voxel = level.parents[voxel];
    }
}

void SurfaceMap::link(std::size_t l) {
    Level& level = levels_[l];
    level.moments.resize(level.voxels.size());
    level.surfaces.resize(level.voxels.size());
    level.due.resize(level.voxels.size(), kFewest);
    if (l + 1 == kLevels) return;
    for (std::size_t voxel = level.parents.size(); voxel < level.voxels.size(); ++voxel) {
        const Cell cell = unpack(level.voxels.key(static_cast<std::uint32_t>(voxel)));
        const Cell around = cell.unaryExpr([](int v) { return v >> 1; });  // rounds down
        level.parents.push_back(levels_[l + 1].voxels.insert(pack(around)));
    }
}

void SurfaceMap::add_points(Level& level, const Points& in_map,
                            std::span<const std::uint32_t> points,
                            std::span<const std::uint32_t> voxels) const {
    std::vector<std::uint32_t> touched;
    for (std::size_t i = 0; i < voxels.size(); ++i) {
        constexpr std::size_t kAhead = 8;  // points whose voxels are prefetched
        if (i + kAhead < voxels.size()) __builtin_prefetch(&level.moments[voxels[i + kAhead]]);
        const std::uint32_t voxel = voxels[i];
        Moments& m = level.moments[voxel];
        if (m.count >= kMostPerPlane) continue;
        m.count += 1.0F;
        const Point corner = corner_of(level.voxels.key(voxel), level.size);
        const Point offset = in_map[points[i]] - corner - m.mean;
        m.mean += offset / m.count;
        const Point d = offset * (1.0F - 1.0F / m.count);
        const std::array<float, 6> more = {offset.x() * d.x(), offset.x() * d.y(),
                                           offset.x() * d.z(), offset.y() * d.y(),
                                           offset.y() * d.z(), offset.z() * d.z()};
        for (std::size_t k = 0; k < 6; ++k) m.scatter[k] += more[k];
        if (m.count == level.due[voxel]) touched.push_back(voxel);
    }
    for (const std::uint32_t voxel : touched) {
        level.surfaces[voxel] = surface_of(level, voxel);
        level.due[voxel] = std::max(level.moments[voxel].count + 1.0F,
                                    std::floor(level.moments[voxel].count * kGrowth));
    }
}

Surface SurfaceMap::surface_of(const Level& level, std::uint32_t voxel) const {
    const Moments& m = level.moments[voxel];
    const auto& s = m.scatter;
    Eigen::Matrix3d covariance;
    covariance << s[0], s[1], s[2], s[1], s[3], s[4], s[2], s[4], s[5];
    covariance /= m.count;
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
    solver.computeDirect(covariance);
    const Eigen::Vector3f spread = solver.eigenvalues().cast<float>().cwiseMax(0.0F);  // ascending
    Surface surface;
    const float least = narrowest_ * level.size;
    if (spread[1] < least * least) return surface;
    surface.point = m.mean + corner_of(level.voxels.key(voxel), level.size);
    const Eigen::Matrix3f axes = solver.eigenvectors().cast<float>();
    surface.normal = axes.col(0);
    surface.along = {axes.col(1) / std::sqrt(spread[1]), axes.col(2) / std::sqrt(spread[2])};
    surface.variance = spread[0] * m.count / (m.count - 3.0F) + kNoise * kNoise;
    surface.count = m.count;
    return surface;
}

float Surface::variance_at(const Point& place) const {
    const Point offset = place - point;
    const float a = along[0].dot(offset), b = along[1].dot(offset);
    return variance * (1.0F + (1.0F + a * a + b * b) / (kEffectiveShare * count));
}

const Surface* SurfaceMap::at(const Point& place) const {
    const Surface* best = nullptr;
    float least = kRoughest * kRoughest;
    std::optional<std::uint32_t> voxel;
    for (std::size_t l = 0; l < kLevels; ++l) {
        const Level& level = levels_[l];
        if (voxel) {
            voxel = levels_[l - 1].parents[*voxel];
        } else if (const auto cell = cell_of(place, 1.0F / level.size)) {
            voxel = level.voxels.find(pack(*cell));
        }
        if (!voxel || level.surfaces[*voxel].count == 0.0F) continue;
        const float variance = level.surfaces[*voxel].variance_at(place);
        if (variance >= least) continue;
        least = variance;
        best = &level.surfaces[*voxel];
    }
    return best;
}

template <class Keep>
void SurfaceMap::rebuild(const Cell& by, const Keep& keep) {
    Cell shift = by;  // in voxels of this level
    for (std::size_t l = kLevels; l-- > 0; shift *= 2) {
        Level kept;
        kept.size = levels_[l].size;
        const Point offset = shift.cast<float>() * kept.size;
        for (std::uint32_t voxel = 0; voxel < levels_[l].voxels.size(); ++voxel) {
            const VoxelKey key = levels_[l].voxels.key(voxel);
            const Cell cell = unpack(key) + shift;
            if (!fits(cell) || !keep(center(key, kept.size))) continue;
            kept.voxels.insert(pack(cell));
            kept.moments.push_back(levels_[l].moments[voxel]);
            kept.surfaces.push_back(levels_[l].surfaces[voxel]);
            kept.surfaces.back().point += offset;
            kept.due.push_back(levels_[l].due[voxel]);
        }
        levels_[l] = std::move(kept);
    }
    for (std::size_t l = 0; l < kLevels; ++l) link(l);
}

void SurfaceMap::keep_within(const Point& center, float radius) {
    rebuild(Cell::Zero(), [&](const Point& p) { return (p - center).norm() <= radius; });
}

void SurfaceMap::move_origin(const Point& shift) {
    rebuild((-shift / coarsest()).array().round().cast<int>().matrix(),
            [](const Point&) { return true; });
}

Points SurfaceMap::places() const {
    const Level& level = levels_.front();
    Points places;
    places.reserve(level.voxels.size());
    for (std::uint32_t voxel = 0; voxel < level.voxels.size(); ++voxel) {
        places.push_back(level.moments[voxel].mean +
                         corner_of(level.voxels.key(voxel), level.size));
    }
    return places;
}

}  // namespace dynamic_filter
