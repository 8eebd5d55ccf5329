// SPDX-License-Identifier: MIT
/// Which voxels a beam passes.
#pragma once

#include <cstdint>
#include <limits>

#include "geometry/voxel.hpp"

namespace dynamic_filter {

/// Blocks of 4 x 4 x 4 voxels, as VoxelIndex has them: one bit for each voxel.
constexpr int kWalkBlock = 4;

inline Cell block_of(const Cell& cell) {
    return cell.unaryExpr([](int c) { return c & ~(kWalkBlock - 1); });
}

/// The number of a voxel in its block, from 0 to 63.
inline int place_in_block(const Cell& cell) {
    constexpr int kLast = kWalkBlock - 1;
    return 16 * (cell.x() & kLast) + 4 * (cell.y() & kLast) + (cell.z() & kLast);
}

/// The bit of a voxel in the mask of its block.
inline std::uint64_t bit_in_block(const Cell& cell) {
    return std::uint64_t{1} << place_in_block(cell);
}

/// Walks along a segment from voxel to voxel (Amanatides and Woo, Eurographics 1987), or from block
/// to block. Times are shares of the segment, each computed anew, so that errors do not add up.
class VoxelWalk {
public:
    /// `from` and `to` in voxels, finite, and within the reach of a key.
    VoxelWalk(const Eigen::Vector3d& from, const Eigen::Vector3d& to)
        : from_(from), way_(to - from), cell_(voxel_at(from)) {
        for (int axis = 0; axis < 3; ++axis) {
            inverse_[axis] = 1.0 / way_[axis];
            step_[axis] = way_[axis] > 0.0 ? 1 : -1;
        }
        time_exits();
    }

    [[nodiscard]] const Cell& cell() const { return cell_; }
    /// Goes on to the next voxel; false: the segment has ended. Without branches on the axis, which
    /// no processor can predict.
    bool next_voxel() {
        const bool y_before_x = exits_[1] < exits_[0];
        const bool z_first = exits_[2] < (y_before_x ? exits_[1] : exits_[0]);
        const bool is_first[] = {!y_before_x && !z_first, y_before_x && !z_first, z_first};
        const double time = z_first ? exits_[2] : y_before_x ? exits_[1] : exits_[0];
        if (!(time <= 1.0)) return false;
        for (int axis = 0; axis < 3; ++axis) {
            cell_[axis] += is_first[axis] ? step_[axis] : 0;
            sides_[axis] += is_first[axis] ? static_cast<double>(step_[axis]) : 0.0;
            const double exit = (sides_[axis] - from_[axis]) * inverse_[axis];
            exits_[axis] = is_first[axis] ? exit : exits_[axis];
        }
        return true;
    }
    /// Goes on to the first voxel of the next block.
    bool next_block() {
        const Cell corner = block_of(cell_);
        int first = 0;
        double time = std::numeric_limits<double>::infinity();
        for (int axis = 0; axis < 3; ++axis) {
            if (way_[axis] == 0.0) continue;
            const int side = way_[axis] > 0.0 ? corner[axis] + kWalkBlock : corner[axis];
            const double exit = (side - from_[axis]) * inverse_[axis];
            if (exit < time) first = axis, time = exit;
        }
        if (!(time <= 1.0)) return false;
        const Cell there = voxel_at(from_ + time * way_);
        cell_ = there.cwiseMax(corner).cwiseMin(corner + Cell::Constant(kWalkBlock - 1));
        cell_[first] = way_[first] > 0.0 ? corner[first] + kWalkBlock : corner[first] - 1;
        time_exits();
        return true;
    }

    static Cell voxel_at(const Eigen::Vector3d& scaled) {
        return scaled.array().floor().cast<int>().matrix();
    }

private:
    void time_exits() {
        for (int axis = 0; axis < 3; ++axis) {
            sides_[axis] = way_[axis] > 0.0 ? cell_[axis] + 1 : cell_[axis];
            exits_[axis] = way_[axis] == 0.0 ? std::numeric_limits<double>::infinity()
                                             : (sides_[axis] - from_[axis]) * inverse_[axis];
        }
    }

    Eigen::Vector3d from_, way_, inverse_;
    Eigen::Vector3d sides_,
        exits_;  // where, and when, the segment leaves the voxel along each axis
    Cell cell_, step_;
};

}  // namespace dynamic_filter
