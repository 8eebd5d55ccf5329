// SPDX-License-Identifier: MIT
#include "geometry/seen_space.hpp"

#include <tsl/robin_set.h>

#include <algorithm>

namespace dynamic_filter {

void SeenSpace::occupy(const Eigen::Vector3d& point) {
    const Cell voxel = VoxelWalk::voxel_at(point / voxel_);
    masks(block_of(voxel)).occupied |= bit_in_block(voxel);
}

void SeenSpace::pass(const Points& points, const Pose& T_map_sensor, double farthest) {
    const Eigen::Affine3d T_voxels_sensor = Eigen::Scaling(1.0 / voxel_) * T_map_sensor;
    const Eigen::Vector3d from = T_voxels_sensor.translation();
    tsl::robin_set<VoxelKey, VoxelHash> ends;
    for (const Point& point : points) {
        if (!is_measured(point)) continue;
        const Eigen::Vector3d end = T_voxels_sensor * point.cast<double>();
        if (!ends.insert(pack(VoxelWalk::voxel_at(end))).second) continue;
        const double length = (end - from).norm();
        const double seen = std::min(length - 1.0, farthest / voxel_);
        if (seen > 0.0) pass(from, from + (end - from) * (seen / length));
    }
}

void SeenSpace::pass(const Eigen::Vector3d& from, const Eigen::Vector3d& end) {
    VoxelWalk walk(from, end);
    for (bool goes_on = true; goes_on;) {
        const Cell corner = block_of(walk.cell());
        std::uint64_t passed = 0;
        do {
            passed |= bit_in_block(walk.cell());
            goes_on = walk.next_voxel();
        } while (goes_on && block_of(walk.cell()) == corner);
        masks(corner).free |= passed;
    }
}

SeenSpace::Masks& SeenSpace::masks(const Cell& corner) {
    const Cell block = corner / kWalkBlock;  // a corner is a multiple
    const VoxelKey cube = pack(block_of(block));
    if (masks_.empty() || cube != last_cube_) {
        const auto [at, is_new] =
            cubes_.try_emplace(cube, static_cast<std::uint32_t>(masks_.size()));
        if (is_new) masks_.emplace_back();
        last_cube_ = cube;
        last_number_ = at->second;
    }
    return masks_[last_number_][static_cast<std::size_t>(place_in_block(block))];
}

std::vector<SeenBlock> SeenSpace::blocks() const {
    std::vector<SeenBlock> blocks;
    for (const auto& [cube, number] : cubes_) {
        for (std::size_t place = 0; place < masks_[number].size(); ++place) {
            const Masks& block = masks_[number][place];
            if ((block.occupied | block.free) == 0) continue;
            const Cell within(static_cast<int>(place / 16), static_cast<int>(place / 4 % 4),
                              static_cast<int>(place % 4));
            const Cell corner = kWalkBlock * (unpack(cube) + within);
            blocks.push_back({pack(corner), block.occupied, block.free & ~block.occupied});
        }
    }
    return blocks;
}

}  // namespace dynamic_filter
