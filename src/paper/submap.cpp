// SPDX-License-Identifier: MIT
#include "paper/submap.hpp"

namespace dynamic_filter {

void to_map(const Points& points, const Pose& T_map_sensor, Points& out) {
    const Eigen::Isometry3f T_map_scan = T_map_sensor.cast<float>();
    const Eigen::Matrix3f rotation = T_map_scan.linear();
    const Point translation = T_map_scan.translation();
    out.resize(points.size());
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = rotation * points[i] + translation;
}

void Thinner::add(const Points& points, const Labels& labels, Label kept) {
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (labels[i] != kept) continue;
        const auto cell = cell_of(points[i], inverse_cell_);
        if (cell && cells_.insert(pack(*cell)).second) points_.push_back(points[i]);
    }
}

std::optional<VoxelKey> voxel_of(const Point& point, float voxel_size) {
    const auto half = cell_of(point, 2.0F / voxel_size);
    if (!half) return std::nullopt;
    return pack(half->unaryExpr([](int v) { return v >> 1; }));
}

}  // namespace dynamic_filter
