// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <span>

#include "dynamic_filter/types.hpp"

namespace dynamic_filter {

/// Normal of each point (Algorithm 1, computeNormal): the smallest principal axis of all points in
/// the 3 x 3 x 3 voxels around it; all points of a voxel share one normal. The sign is arbitrary.
/// The normal is zero if the points do not lie on a plane. The points must be those of a thinned
/// submap, with at most eight points per voxel.
Points estimate_normals(std::span<const Point> points, float voxel_size);

/// True for a pseudo-occupied point (Sec. III-C2): the incidence angle of the beam from `viewpoint`
/// is larger than the threshold, whose cosine is given. False if the normal is zero.
inline bool is_grazing(const Point& point, const Point& normal, const Point& viewpoint,
                       float cos_threshold) {
    const Point beam = point - viewpoint;
    return normal.squaredNorm() > 0.0F && std::abs(beam.dot(normal)) < cos_threshold * beam.norm();
}

}  // namespace dynamic_filter
