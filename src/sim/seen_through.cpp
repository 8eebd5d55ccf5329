// SPDX-License-Identifier: MIT
#include "sim/seen_through.hpp"

#include <atomic>

#include "dynamic_filter/parallel.hpp"
#include "geometry/voxel_walk.hpp"

namespace dynamic_filter::sim {

namespace {

constexpr double kPerMetre = 5.0;  // voxels

}  // namespace

std::uint32_t SeenThrough::ask_for(const Eigen::Vector3d& point) {
    const std::uint32_t voxel = voxels_.insert(pack(VoxelWalk::voxel_at(kPerMetre * point)));
    beams_.resize(voxels_.size());
    occupied_.resize(voxels_.size());
    return voxel;
}

void SeenThrough::note_occupied(std::span<const Beam> beams) {
    for (const Beam& beam : beams) {
        const auto voxel = voxels_.find(pack(VoxelWalk::voxel_at(kPerMetre * beam.end)));
        if (voxel) occupied_[*voxel] = scan_;
    }
}

void SeenThrough::pass(const Beam& beam) {
    const Eigen::Vector3d from = kPerMetre * beam.origin, end = kPerMetre * beam.end;
    const double length = (end - from).norm();
    if (length <= 1.0) return;
    VoxelWalk walk(from, end - (end - from) / length);
    const auto count = [&](std::uint32_t voxel, int) {
        if (occupied_[voxel] == scan_) return;
        std::atomic_ref(beams_[voxel]).fetch_add(1, std::memory_order_relaxed);
    };
    for (bool goes_on = true; goes_on;) {
        const Cell corner = block_of(walk.cell());
        const auto block = voxels_.find_block(pack(corner));
        if (!block) {
            goes_on = walk.next_block();
            continue;
        }
        do {
            voxels_.each_in_block(*block, bit_in_block(walk.cell()), count);
            goes_on = walk.next_voxel();
        } while (goes_on && block_of(walk.cell()) == corner);
    }
}

void SeenThrough::add_scan(std::span<const Beam> beams) {
    ++scan_;
    note_occupied(beams);
    parallel_for(beams.size(), 1024, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) pass(beams[i]);
    });
}

}  // namespace dynamic_filter::sim
