// SPDX-License-Identifier: MIT
#include "geometry/voxel_walk.hpp"

#include <gtest/gtest.h>

#include <set>

#include "support/random.hpp"

namespace dynamic_filter {
namespace voxel_walk_test {

struct Segment {
    Eigen::Vector3d from, to;
};

std::vector<Segment> segments() {
    test::Random random(3);
    std::vector<Segment> all = {{{0.5, 0.5, 0.5}, {9.5, 0.5, 0.5}},
                                {{0.5, 0.5, 0.5}, {0.5, -7.5, 0.5}},
                                {{-0.5, 2.5, 0.5}, {-0.5, 2.5, 0.5}}};
    for (int i = 0; i < 300; ++i) {
        const Eigen::Vector3d from = random.point(20.0).cast<double>();
        all.push_back({from, random.point(20.0).cast<double>()});
    }
    return all;
}

std::vector<Cell> walked(const Segment& segment) {
    VoxelWalk walk(segment.from, segment.to);
    std::vector<Cell> cells;
    do {
        cells.push_back(walk.cell());
    } while (walk.next_voxel());
    return cells;
}

TEST(VoxelWalk, GoesFromFaceToFaceFromOneEndToTheOther) {
    for (const Segment& segment : segments()) {
        const std::vector<Cell> cells = walked(segment);
        EXPECT_EQ(cells.front(), VoxelWalk::voxel_at(segment.from));
        EXPECT_EQ(cells.back(), VoxelWalk::voxel_at(segment.to));
        for (std::size_t i = 1; i < cells.size(); ++i) {
            EXPECT_EQ((cells[i] - cells[i - 1]).cwiseAbs().sum(), 1);
        }
    }
}

TEST(VoxelWalk, MeetsEachVoxelThatTheSegmentPasses) {
    constexpr int kSamples = 4000;
    for (const Segment& segment : segments()) {
        std::set<VoxelKey> met;
        for (const Cell& cell : walked(segment)) met.insert(pack(cell));
        for (int i = 0; i <= kSamples; ++i) {
            const double share = static_cast<double>(i) / kSamples;
            const Eigen::Vector3d at = segment.from + share * (segment.to - segment.from);
            const Eigen::Array3d to_side = at.array() - at.array().round();
            if (to_side.abs().minCoeff() < 1e-6) continue;  // on a face, either will do
            EXPECT_TRUE(met.contains(pack(VoxelWalk::voxel_at(at))));
        }
    }
}

TEST(VoxelWalk, FromBlockToBlockMeetsTheBlocksOfTheVoxels) {
    for (const Segment& segment : segments()) {
        std::vector<Cell> of_voxels;
        for (const Cell& cell : walked(segment)) {
            if (of_voxels.empty() || block_of(cell) != of_voxels.back()) {
                of_voxels.push_back(block_of(cell));
            }
        }
        VoxelWalk walk(segment.from, segment.to);
        std::vector<Cell> blocks;
        do {
            blocks.push_back(block_of(walk.cell()));
        } while (walk.next_block());
        EXPECT_EQ(blocks, of_voxels);
    }
}

TEST(VoxelWalk, NumbersEachVoxelOfABlockOnce) {
    std::uint64_t all = 0;
    for (int x = -4; x < 0; ++x) {
        for (int y = 4; y < 8; ++y) {
            for (int z = -8; z < -4; ++z) {
                EXPECT_EQ(block_of({x, y, z}), Cell(-4, 4, -8));
                EXPECT_EQ(all & bit_in_block({x, y, z}), 0U);
                all |= bit_in_block({x, y, z});
            }
        }
    }
    EXPECT_EQ(all, ~std::uint64_t{0});
}

}  // namespace voxel_walk_test
}  // namespace dynamic_filter
