// SPDX-License-Identifier: MIT
/// @file
/// The map to which scans are registered: for voxels of several sizes, the plane that fits the
/// points of each voxel.
///
/// - Units: [m].
/// - Frames: map.
/// - Shapes: any number of points.
/// - Ownership: points are not kept; the map keeps the sums from which the planes are computed.
/// - Threads: single caller; const members may run in several threads while no other member runs.
/// - Errors: none.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "dynamic_filter/types.hpp"
#include "geometry/voxel_index.hpp"

namespace dynamic_filter {

/// The plane that fits the points of a voxel.
struct Surface {
    Point point = Point::Zero();   ///< the mean of its points
    Point normal = Point::Zero();  ///< unit vector; its sign is arbitrary
    /// Axes in the plane, divided by the spread of the points along them.
    std::array<Point, 2> along{};
    float variance = 0.0F;  ///< [m^2] of the distances of the points from the plane
    float count = 0.0F;     ///< number of points; 0: no surface

    /// Variance [m^2] of the distance from the plane for a point near `place`. It is the sum of the
    /// roughness of the surface and of the uncertainty of the plane at that place, which grows with
    /// the distance from the points of the voxel.
    [[nodiscard]] float variance_at(const Point& place) const;
};

/// Sorts points into voxels of each size. A place is described by the one of its voxels whose plane
/// is known best there: a large one for walls and floors, a small one for bent surfaces. Planes of
/// walls and floors stay flat when more scans are added; moving objects do not give flat planes. So
/// moving objects have little weight even if they are not labelled.
class SurfaceMap {
public:
    /// Number of sizes; each one is twice the previous one.
    static constexpr std::size_t kLevels = 4;

    /// `finest` [m]: edge of the smallest voxels. `narrowest`: smallest spread of the points in
    /// both directions of a plane, as a share of the edge of its voxel. The planes of narrower
    /// strips are tilted by the noise of the ranges.
    explicit SurfaceMap(double finest, double narrowest = 0.12);

    void insert(const Points& in_map);

    /// The surface at a place; null if there are no points or no flat surface. Valid until the map
    /// changes.
    [[nodiscard]] const Surface* at(const Point& place) const;

    /// Removes everything farther than `radius` [m] from a place.
    void keep_within(const Point& center, float radius);
    /// Moves the origin of the map frame by `shift`, which must be a whole multiple of the largest
    /// voxel size.
    void move_origin(const Point& shift);

    [[nodiscard]] bool empty() const { return levels_.front().voxels.size() == 0; }
    [[nodiscard]] float coarsest() const { return levels_.back().size; }
    /// The centroids of all voxels of the smallest size.
    [[nodiscard]] Points places() const;

private:
    struct Moments {  // of the points in a voxel, relative to its corner
        float count = 0.0F;
        Point mean = Point::Zero();
        std::array<float, 6> scatter{};  // about the mean: xx xy xz yy yz zz
    };
    struct Level {
        float size = 1.0F;
        VoxelIndex voxels;
        std::vector<Moments> moments;   // per voxel
        std::vector<Surface> surfaces;  // per voxel
        // Per voxel: number of points at which the surface is computed again.
        std::vector<float> due;
        // Per voxel: the one of the next level around it. Empty at the last level.
        std::vector<std::uint32_t> parents;
    };
    /// Makes room for the data of new voxels, and finds their parents.
    void link(std::size_t level);
    void add_points(Level& level, const Points& in_map, std::span<const std::uint32_t> points,
                    std::span<const std::uint32_t> voxels) const;
    [[nodiscard]] Surface surface_of(const Level& level, std::uint32_t voxel) const;
    template <class Keep>
    void rebuild(const Cell& by, const Keep& keep);

    float narrowest_;
    std::array<Level, kLevels> levels_;
};

}  // namespace dynamic_filter
