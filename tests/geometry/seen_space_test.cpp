// SPDX-License-Identifier: MIT
#include "geometry/seen_space.hpp"

#include <gtest/gtest.h>

#include <set>

#include "support/random.hpp"

namespace dynamic_filter {
namespace seen_space_test {

constexpr double kVoxel = 0.25;  // [m]

struct Sets {
    std::set<VoxelKey> occupied, free;
};

Sets sets_of(const SeenSpace& space) {
    Sets sets;
    for (const SeenBlock& block : space.blocks()) {
        EXPECT_EQ(block.occupied & block.free, 0U);
        EXPECT_NE(block.occupied | block.free, 0U);
        const Cell corner = unpack(block.corner);
        for (int i = 0; i < 64; ++i) {
            const Cell voxel = corner + Cell(i / 16, i / 4 % 4, i % 4);
            if ((block.occupied & bit_in_block(voxel)) != 0) sets.occupied.insert(pack(voxel));
            if ((block.free & bit_in_block(voxel)) != 0) sets.free.insert(pack(voxel));
        }
    }
    return sets;
}

Cell voxel_at(const Eigen::Vector3d& place) { return VoxelWalk::voxel_at(place / kVoxel); }

TEST(SeenSpace, IsFreeWhereABeamPassed) {
    test::Random random(8);
    const Points points = random.points(200, 12.0);
    const Pose T = random.pose(30.0, 1.0);
    constexpr double kFarthest = 10.0;
    SeenSpace space(kVoxel);
    space.pass(points, T, kFarthest);
    std::set<VoxelKey> ends, expected;
    for (const Point& point : points) {
        const Eigen::Vector3d from = T.translation(), to = T * point.cast<double>();
        if (!ends.insert(pack(voxel_at(to))).second) continue;
        const double length = (to - from).norm();
        const double seen = std::min(length - kVoxel, kFarthest);
        VoxelWalk walk(from / kVoxel, (from + (to - from) * (seen / length)) / kVoxel);
        do {
            expected.insert(pack(walk.cell()));
        } while (walk.next_voxel());
    }
    const Sets sets = sets_of(space);
    EXPECT_TRUE(sets.occupied.empty());
    // A beam may touch a corner by less than what rounding leaves.
    std::size_t others = 0;
    for (const VoxelKey key : expected) others += sets.free.contains(key) ? 0U : 1U;
    for (const VoxelKey key : sets.free) others += expected.contains(key) ? 0U : 1U;
    EXPECT_LE(others, 2U);
    EXPECT_GT(sets.free.size(), 4000U);
}

TEST(SeenSpace, WhatIsOccupiedIsNotFree) {
    SeenSpace space(kVoxel);
    space.occupy({2.1, 0.1, 0.1});
    space.pass({{4.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 0.0F}}, Pose(Eigen::Translation3d(0.1, 0.1, 0.1)),
               100.0);
    const Sets sets = sets_of(space);
    EXPECT_EQ(sets.occupied, std::set<VoxelKey>{pack(Cell(8, 0, 0))});
    for (int x = 0; x < 16; ++x) {  // the return is in voxel 16
        EXPECT_EQ(sets.free.contains(pack(Cell(x, 0, 0))), x != 8) << x;
    }
    EXPECT_FALSE(sets.free.contains(pack(Cell(16, 0, 0))));
}

}  // namespace seen_space_test
}  // namespace dynamic_filter
