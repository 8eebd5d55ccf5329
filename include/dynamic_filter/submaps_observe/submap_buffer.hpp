// SPDX-License-Identifier: MIT
/// The submap buffer B (Sec. III-C).
#pragma once

#include <cstdint>
#include <vector>

#include "dynamic_filter/submaps_observe/submap.hpp"
#include "dynamic_filter/types.hpp"

namespace dynamic_filter {

/// A submap as the back-end keeps it.
struct BufferedSubmap {
    Submap submap{};
    Points normals{};                     ///< parallel to submap.points; zero: none
    std::vector<std::uint32_t> voxels{};  ///< ids of the voxels it owns a point in, ascending
};

/// The submaps whose pose lies within `radius` [m] of `position`: at most `most`, the nearest,
/// nearest first; at equal distance those nearest in age to the submap `anchor`, so that a sensor
/// that stands still for long still finds the submap asked for. Indices into `buffer`.
std::vector<std::size_t> search_radius(const std::vector<BufferedSubmap>& buffer,
                                       const Eigen::Vector3d& position, double radius,
                                       std::size_t most, std::size_t anchor);

}  // namespace dynamic_filter
