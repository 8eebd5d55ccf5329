// SPDX-License-Identifier: MIT
/// @file
/// The map that scans are registered to: in voxels of several sizes, the plane that fits the points
/// of each.
///
/// - Units: [m].
/// - Frames: map.
/// - Shapes: any number of points.
/// - Ownership: points are not kept, but the sums that their planes follow from.
/// - Threads: single caller; const members may run in several threads while no other runs.
/// - Errors: none.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "dynamic_filter/geometry/voxel_index.hpp"
#include "dynamic_filter/types.hpp"

namespace dynamic_filter {

/// What the points of a voxel lie on.
struct Surface {
    Point point = Point::Zero();   ///< the mean of its points
    Point normal = Point::Zero();  ///< unit; its sign is arbitrary
    std::array<Point, 2> along{};  ///< its axes, divided by the spread of the points along them
    float variance = 0.0F;         ///< [m^2] of the points' distances from the plane
    float count = 0.0F;            ///< points; 0: no surface

    /// [m^2] of what a point near `place` is off the plane: its own roughness, and what the place
    /// of the plane is uncertain by, which grows with the distance from the points that it follows
    /// from.
    [[nodiscard]] float variance_at(const Point& place) const;
};

/// Points go into voxels of each size; a place is described by that voxel around it whose plane is
/// known best there: a large one for walls and floors, a small one where surfaces bend. Walls and
/// floors stay planes when more scans are added, whereas what moves does not, so it has little
/// weight even where nobody knows that it moves.
class SurfaceMap {
public:
    static constexpr std::size_t kLevels = 4;  ///< each of twice the size of the one before

    explicit SurfaceMap(double finest);  ///< [m] edge of the smallest voxels

    void insert(const Points& in_map);

    /// The surface at a place; null where nothing is known, or nothing flat; valid until the map
    /// changes.
    [[nodiscard]] const Surface* at(const Point& place) const;

    /// Forgets what is farther than `radius` [m] from a place.
    void keep_within(const Point& center, float radius);
    /// The same map after its frame has moved by `shift`, a whole number of the largest voxels.
    void move_origin(const Point& shift);

    [[nodiscard]] bool empty() const { return levels_.front().voxels.size() == 0; }
    [[nodiscard]] float coarsest() const { return levels_.back().size; }
    /// The means of all finest voxels.
    [[nodiscard]] Points places() const;

private:
    struct Moments {  // of the points in a voxel, from its corner
        float count = 0.0F;
        Point mean = Point::Zero();
        std::array<float, 6> scatter{};  // xx xy xz yy yz zz, about the mean
    };
    struct Level {
        float size = 1.0F;
        VoxelIndex voxels;
        std::vector<Moments> moments;   // by voxel
        std::vector<Surface> surfaces;  // by voxel
        std::vector<float> due;         // by voxel: points from which the surface is made anew
    };
    static void insert(Level& level, const Points& in_map);
    static Surface surface_of(const Level& level, std::uint32_t voxel);
    template <class Keep>
    void rebuild(const Cell& by, const Keep& keep);

    std::array<Level, kLevels> levels_;
};

}  // namespace dynamic_filter
