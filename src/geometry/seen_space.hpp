// SPDX-License-Identifier: MIT
/// Which voxels points occupy, and which ones beams passed through.
#pragma once

#include <tsl/robin_map.h>

#include <array>
#include <cstdint>
#include <vector>

#include "geometry/voxel_walk.hpp"

namespace dynamic_filter {

/// Voxels within a block of 4 x 4 x 4, by bit_in_block(). A voxel that is neither is unknown.
struct SeenBlock {
    VoxelKey corner = 0;
    std::uint64_t occupied = 0, free = 0;  ///< no bit is set in both
};

class SeenSpace {
public:
    /// `voxel`: edge of a voxel [m]. Voxel (0, 0, 0) begins at the origin. All points must lie
    /// within the reach of a key.
    explicit SeenSpace(double voxel) : voxel_(voxel) {}

    /// `point` of the same frame as all others [m].
    void occupy(const Eigen::Vector3d& point);
    /// Beams of one scan, from the sensor to each of its points that is a measurement, are followed
    /// up to `farthest` [m], and end the edge of a voxel before the point, whose range is not
    /// exact. One beam to each voxel suffices.
    void pass(const Points& points, const Pose& T_map_sensor, double farthest);
    /// Those that are not unknown, in no order. What is occupied is not free.
    [[nodiscard]] std::vector<SeenBlock> blocks() const;

private:
    struct Masks {
        std::uint64_t occupied = 0, free = 0;
    };
    /// Blocks are kept by cubes of 4 x 4 x 4 of them, because beams go through many in a row.
    using Cube = std::array<Masks, 64>;

    Masks& masks(const Cell& corner);
    void pass(const Eigen::Vector3d& from, const Eigen::Vector3d& end);  // [voxels]

    double voxel_;
    tsl::robin_map<VoxelKey, std::uint32_t, VoxelHash> cubes_;  // number, by the first block
    std::vector<Cube> masks_;
    VoxelKey last_cube_ = 0;
    std::uint32_t last_number_ = 0;
};

}  // namespace dynamic_filter
