// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <span>

#include "dynamic_filter/types.hpp"

namespace dynamic_filter {

/// Normal of each point (Algorithm 1, computeNormal): the smallest principal axis of all points in
/// the 3 x 3 x 3 voxels around it, so one per voxel. The sign is arbitrary; zero where the points
/// span no plane. Points are a submap's, thinned, so no voxel holds more than eight.
Points estimate_normals(std::span<const Point> points, float voxel_size);

/// True if the beam from `viewpoint` meets the surface at more than the threshold from head-on:
/// a pseudo-occupied point (Sec. III-C2). A zero normal is ordinary.
inline bool is_grazing(const Point& point, const Point& normal, const Point& viewpoint,
                       float cos_threshold) {
    const Point beam = point - viewpoint;
    return normal.squaredNorm() > 0.0F && std::abs(beam.dot(normal)) < cos_threshold * beam.norm();
}

}  // namespace dynamic_filter
