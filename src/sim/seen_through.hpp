// SPDX-License-Identifier: MIT
/// Counts how often somebody saw through voxels of the world.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/voxel_index.hpp"

namespace dynamic_filter::sim {

/// From the sensor to the return [m], in the world.
struct Beam {
    Eigen::Vector3d origin, end;
};

/// Counts the beams that pass through voxels of 0.2 m, of those voxels that are asked for. A beam
/// passes through a voxel if it crosses it more than the edge of a voxel before its return, and if
/// no return of the same scan lies in the voxel. Beams without a return count nothing, because a
/// sensor does not tell where they went. Single caller; the counts do not depend on the threads.
class SeenThrough {
public:
    /// Asks for the voxel of a point [m], and returns the number of the voxel. All points must be
    /// asked for before the first scan.
    std::uint32_t ask_for(const Eigen::Vector3d& point);
    /// Adds the beams of one scan.
    void add_scan(std::span<const Beam> beams);
    [[nodiscard]] std::uint32_t beams_through(std::uint32_t voxel) const { return beams_[voxel]; }

private:
    void note_occupied(std::span<const Beam> beams);
    void pass(const Beam& beam);

    VoxelIndex voxels_;
    std::vector<std::uint32_t> beams_;     // by voxel
    std::vector<std::uint32_t> occupied_;  // by voxel: the last scan with a return in it, from 1
    std::uint32_t scan_ = 0;
};

}  // namespace dynamic_filter::sim
