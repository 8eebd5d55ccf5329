// SPDX-License-Identifier: MIT
#include "geometry/map_points.hpp"

#include "base/best_kernel.hpp"
#include "geometry/voxel_kernel.hpp"

namespace dynamic_filter {

namespace {

void to_voxels(std::span<const Point> points, const Pose& T_map_points, float voxel_size,
               bool origin_is_a_point, MapPoints& out) {
    static const auto kernel = DYNAMIC_FILTER_BEST_KERNEL(to_voxels);
    static_assert(sizeof(Point) == 3 * sizeof(float));
    out.points.resize(points.size());
    out.keys.resize(points.size());
    if (points.empty()) return;
    const Eigen::Matrix<float, 3, 4, Eigen::RowMajor> matrix =
        T_map_points.matrix().topRows<3>().cast<float>();
    kernel({.xyz = points.front().data(),
            .count = points.size(),
            .matrix = matrix.data(),
            .half_cells_per_metre = 2.0F / voxel_size,
            .origin_is_a_point = origin_is_a_point,
            .map_xyz = out.points.front().data(),
            .keys = out.keys.data()});
}

}  // namespace

void to_voxels(std::span<const Point> points, const Pose& T_map_sensor, float voxel_size,
               MapPoints& out) {
    to_voxels(points, T_map_sensor, voxel_size, false, out);
}

void to_voxels(std::span<const Point> map_points, float voxel_size, MapPoints& out) {
    to_voxels(map_points, Pose::Identity(), voxel_size, true, out);
}

}  // namespace dynamic_filter
