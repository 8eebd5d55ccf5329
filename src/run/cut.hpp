// SPDX-License-Identifier: MIT
/// The points of a scan in and around a tile.
#pragma once

#include <cstdint>
#include <vector>

#include "dynamic_filter/recording.hpp"
#include "dynamic_filter/scores.hpp"
#include "run/tiles.hpp"

namespace dynamic_filter::app {

/// All arrays are parallel, in the order of the scan.
struct Cut {
    std::vector<std::uint32_t> indices;  ///< in the scan
    Points points;                       ///< sensor frame
    std::vector<bool> inside;            ///< in the tile itself
    Labels truth;                        ///< empty without ground truth
};

/// The measured points in the tile and in the cells around it. `edge` [m]: of a cell.
Cut cut_of(const io::FullScan& scan, const Tile& tile, double edge);

/// The labels of the cut out of those of the whole scan.
Labels labels_of(const Cut& cut, const Labels& of_scan);

/// The points inside of the tile as the scores take them, relative to `origin` [m, world].
eval::LabelledScan labelled_inside(const Cut& cut, const Pose& T_world_sensor,
                                   const Eigen::Vector3d& origin);

}  // namespace dynamic_filter::app
