// SPDX-License-Identifier: MIT
/// OctoMap's files: a tree of 16 levels, pruned, in which a node is occupied, free, or not there.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "geometry/seen_space.hpp"

namespace dynamic_filter::app {

/// A coordinate fits if it is less than this, in voxels, on both sides of the origin.
constexpr double kOctreeReach = 32768.0;

enum class OctreeKind : std::uint8_t {
    binary,  ///< .bt: two bits for each child
    full     ///< .ot: log-odds of each node
};

/// The whole file. `voxel`: edge of a voxel [m]; the blocks, in any order, lie within 32,768 voxels
/// of the origin. Occupied nodes have OctoMap's greatest probability, .97, free ones its least,
/// .12. Source: Hornung et al., OctoMap, Autonomous Robots 2013, and what liboctomap reads.
std::string octree_file(const std::vector<SeenBlock>& blocks, double voxel, OctreeKind kind);

}  // namespace dynamic_filter::app
