// SPDX-License-Identifier: MIT
#include "sim/seen_through.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "dynamic_filter/parallel.hpp"

namespace dynamic_filter::sim {

namespace {

constexpr double kPerMetre = 5.0;  // voxels
constexpr int kBlock = 4;          // voxels along the edge of a block of a VoxelIndex

Cell voxel_at(const Eigen::Vector3d& scaled) {
    return scaled.array().floor().cast<int>().matrix();  // a world is far smaller than the reach
}

Cell block_at(const Cell& cell) {
    return cell.unaryExpr([](int c) { return c & ~(kBlock - 1); });
}

/// Walks along a segment from voxel to voxel (Amanatides and Woo, Eurographics 1987), or from block
/// to block. Times are shares of the segment, each computed anew, so that errors do not add up.
class Walk {
public:
    /// In voxels.
    Walk(const Eigen::Vector3d& from, const Eigen::Vector3d& to)
        : from_(from), way_(to - from), cell_(voxel_at(from)) {}

    [[nodiscard]] const Cell& cell() const { return cell_; }
    /// Goes on to the next voxel; false: the segment has ended.
    bool next_voxel() {
        const auto [axis, time] = first_exit(cell_, 1);
        if (!(time <= 1.0)) return false;
        cell_[axis] += way_[axis] > 0.0 ? 1 : -1;
        return true;
    }
    /// Goes on to the first voxel of the next block.
    bool next_block() {
        const Cell corner = block_at(cell_);
        const auto [axis, time] = first_exit(corner, kBlock);
        if (!(time <= 1.0)) return false;
        const Cell there = voxel_at(from_ + time * way_);
        cell_ = there.cwiseMax(corner).cwiseMin(corner + Cell::Constant(kBlock - 1));
        cell_[axis] = way_[axis] > 0.0 ? corner[axis] + kBlock : corner[axis] - 1;
        return true;
    }

private:
    struct Exit {
        int axis;
        double time;
    };
    /// Of the cube with that first voxel and that edge.
    [[nodiscard]] Exit first_exit(const Cell& corner, int edge) const {
        Exit first{0, std::numeric_limits<double>::infinity()};
        for (int axis = 0; axis < 3; ++axis) {
            if (way_[axis] == 0.0) continue;
            const int side = way_[axis] > 0.0 ? corner[axis] + edge : corner[axis];
            const double time = (side - from_[axis]) / way_[axis];
            if (time < first.time) first = {axis, time};
        }
        return first;
    }

    Eigen::Vector3d from_, way_;
    Cell cell_;
};

}  // namespace

std::uint32_t SeenThrough::ask_for(const Eigen::Vector3d& point) {
    const std::uint32_t voxel = voxels_.insert(pack(voxel_at(kPerMetre * point)));
    beams_.resize(voxels_.size());
    occupied_.resize(voxels_.size());
    return voxel;
}

void SeenThrough::note_occupied(std::span<const Beam> beams) {
    for (const Beam& beam : beams) {
        const auto voxel = voxels_.find(pack(voxel_at(kPerMetre * beam.end)));
        if (voxel) occupied_[*voxel] = scan_;
    }
}

void SeenThrough::pass(const Beam& beam) {
    const Eigen::Vector3d from = kPerMetre * beam.origin, end = kPerMetre * beam.end;
    const double length = (end - from).norm();
    if (length <= 1.0) return;
    Walk walk(from, end - (end - from) / length);
    const auto count = [&](std::uint32_t voxel, int) {
        if (occupied_[voxel] == scan_) return;
        std::atomic_ref(beams_[voxel]).fetch_add(1, std::memory_order_relaxed);
    };
    for (bool goes_on = true; goes_on;) {
        const Cell corner = block_at(walk.cell());
        const auto block = voxels_.find_block(pack(corner));
        if (!block) {
            goes_on = walk.next_block();
            continue;
        }
        do {
            const Cell in_block = walk.cell() - corner;
            const int place = 16 * in_block.x() + 4 * in_block.y() + in_block.z();
            voxels_.each_in_block(*block, std::uint64_t{1} << place, count);
            goes_on = walk.next_voxel();
        } while (goes_on && block_at(walk.cell()) == corner);
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
