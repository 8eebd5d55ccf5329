// SPDX-License-Identifier: MIT
/// The submap buffer B (Sec. III-C).
#pragma once

#include <cstdint>
#include <vector>

#include "dynamic_filter/types.hpp"
#include "paper/submap.hpp"

namespace dynamic_filter {

/// A submap as the back-end stores it.
struct BufferedSubmap {
    Submap submap{};
    Points normals{};                     ///< parallel to submap.points; zero: no normal
    std::vector<std::uint32_t> voxels{};  ///< ids of the voxels in which it has points, ascending
};

/// Returns the indices in `buffer` of the submaps whose pose lies within `radius` [m] of
/// `position`: the nearest ones, at most `most`, nearest first. At equal distance, submaps with an
/// index close to `anchor` come first, so that the submap in question is found even if the sensor
/// stood still for a long time.
std::vector<std::size_t> search_radius(const std::vector<BufferedSubmap>& buffer,
                                       const Eigen::Vector3d& position, double radius,
                                       std::size_t most, std::size_t anchor);

}  // namespace dynamic_filter
