// SPDX-License-Identifier: MIT
/// Voxels as points of a binary glTF 2.0 file, as 3D Tiles 1.1 take them.
#pragma once

#include <string>

#include "formats/voxel_map/heights.hpp"
#include "formats/voxel_map/tile_points.hpp"

namespace dynamic_filter::app {

/// The bytes of a .glb. Positions are floats from `origin` [m], and the node has the rest: y is up
/// in glTF, and viewers of 3D Tiles turn it back. Each point has a colour by height, and the
/// property attributes _PROBABILITY, _SCANS and _SESSIONS_k (EXT_structural_metadata): bit i of
/// byte b of _SESSIONS_k is drive 32 k + 8 b + i. `points` must not be empty.
std::string glb_of(const TilePoints& points, const Eigen::Vector3d& origin,
                   const HeightRange& heights);

}  // namespace dynamic_filter::app
