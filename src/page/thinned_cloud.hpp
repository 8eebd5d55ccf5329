// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "dynamic_filter/types.hpp"
#include "geometry/voxel_index.hpp"

namespace dynamic_filter::app {

/// A point that the viewer shows.
struct ShownPoint {
    Point position = Point::Zero();  ///< [m] from the page's origin
    float intensity = 0.0F;          ///< as recorded
    std::uint32_t scan = 0;          ///< row of path
    std::uint8_t verdict = 0;        ///< bits as viewer/README.md has them
    std::uint64_t place = 0;         ///< OnlineFilter::places_of
};
inline constexpr std::uint64_t kNoVoxelOfPage = UINT64_MAX;  ///< a place without points

/// Thins a cloud to a number of points that can be shown. Keeps at most one point of each final
/// verdict in a cube, and the edge of the cubes grows until the points fit. The first point of a
/// cube stays. Single caller.
class ThinnedCloud {
public:
    explicit ThinnedCloud(std::size_t most) : most_(most) {}

    void add(std::span<const ShownPoint> points);
    [[nodiscard]] const std::vector<ShownPoint>& points() const { return points_; }
    [[nodiscard]] float spacing() const { return spacing_; }  ///< [m] 0: nothing is left out

private:
    void keep_first_in_cubes(std::span<const ShownPoint> points);
    void thin();

    std::size_t most_;
    float spacing_ = 0.0F;
    std::vector<ShownPoint> points_;
    std::array<VoxelIndex, 4> taken_;  // cubes, by final verdict
};

}  // namespace dynamic_filter::app
