// SPDX-License-Identifier: MIT
#include "geometry/map_frame.hpp"

#include <string>

#include "dynamic_filter/error.hpp"
#include "geometry/pose.hpp"

namespace dynamic_filter {

void MapFrame::begin(const Pose& T_world_sensor) {
    if (!origin) origin = nearby_origin(T_world_sensor, voxel_size);
}

Pose MapFrame::to_map(const Pose& T_world_sensor) const {
    Pose shifted = T_world_sensor;
    shifted.translation() -= *origin;
    return shifted;
}

LocatedScan MapFrame::locate(const Scan& scan, const VoxelIndex& voxels) const {
    if (!scan.has_pose) {
        throw Error("scan " + std::to_string(scan.index) +
                    " has no pose: give it the one of its instant verdict (Verdict::tracked)");
    }
    LocatedScan located;
    located.voxels.assign(scan.points.size(), kNoVoxel);
    located.in_map.keys.assign(scan.points.size(), kNoKey);
    if (!origin) return located;
    to_voxels(scan.points, to_map(scan.T_world_sensor), static_cast<float>(voxel_size),
              located.in_map);
    voxels.find(located.in_map.keys, located.voxels);
    return located;
}

Eigen::Vector3d MapFrame::center_of(VoxelKey key) const {
    return *origin + center(key, static_cast<float>(voxel_size)).cast<double>();
}

}  // namespace dynamic_filter
