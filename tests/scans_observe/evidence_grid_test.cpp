// SPDX-License-Identifier: MIT
#include "dynamic_filter/scans_observe/evidence_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/random.hpp"

namespace dynamic_filter {
namespace {

constexpr float kSize = 0.2F;

Scan cloud(test::Random& random, std::size_t count, double half_width) {
    Scan scan;
    for (std::size_t i = 0; i < count; ++i) scan.points.push_back(random.point(half_width));
    return scan;
}

EvidenceGrid empty_grid() { return {kSize, ScansConfig{}.evidence}; }

TEST(EvidenceGrid, EveryPointIsInTheVoxelOfItsPlace) {
    test::Random random(1);
    EvidenceGrid grid = empty_grid();
    for (int scans = 1; scans <= 3; ++scans) {
        Scan scan = cloud(random, 2000, 3.0);
        scan.points.push_back(Point::Zero());  // not measured
        const PointVoxels voxels = grid.add_points(scan);
        ASSERT_EQ(voxels.size(), scan.points.size());
        EXPECT_EQ(voxels.back(), kNoVoxel);
        for (std::size_t i = 0; i + 1 < voxels.size(); ++i) {
            EXPECT_EQ(grid.voxels().key(voxels[i]), pack(*cell_of(scan.points[i], 1.0F / kSize)));
        }
        EXPECT_EQ(grid.scans(), static_cast<std::uint32_t>(scans));
    }
}

TEST(EvidenceGrid, NewVoxelsOfABlockFollowEachOther) {
    test::Random random(2);
    EvidenceGrid grid = empty_grid();
    grid.add_points(cloud(random, 500, 2.0));
    const std::uint32_t known = grid.size();
    grid.add_points(cloud(random, 500, 4.0));
    std::vector<std::uint32_t> blocks;
    for (std::uint32_t v = known; v < grid.size(); ++v) {
        blocks.push_back(grid.voxels().block_of_voxel(v));
    }
    const auto runs = std::unique(blocks.begin(), blocks.end());
    std::vector<std::uint32_t> sorted(blocks.begin(), runs);
    std::sort(sorted.begin(), sorted.end());
    EXPECT_EQ(std::adjacent_find(sorted.begin(), sorted.end()), sorted.end());
    EXPECT_EQ(grid.blocks_from(known), sorted);
}

TEST(EvidenceGrid, KnowsWhichBlocksTheNewestScanTouched) {
    EvidenceGrid grid = empty_grid();
    Scan left, right;
    left.points = {{-5.0F, 0.1F, 0.1F}};
    right.points = {{5.0F, 0.1F, 0.1F}};
    const std::uint32_t l = grid.add_points(left)[0], r = grid.add_points(right)[0];
    EXPECT_EQ(grid.blocks_touched(true), std::vector{grid.voxels().block_of_voxel(r)});
    EXPECT_EQ(grid.blocks_touched(false), std::vector{grid.voxels().block_of_voxel(l)});
}

TEST(EvidenceGrid, ASightChangesTheScoreAndCountsAsHitWhereTheNewestScanHasAPoint) {
    EvidenceGrid grid = empty_grid();
    Scan scan;
    scan.points = {{1.0F, 0.1F, 0.1F}, {1.01F, 0.1F, 0.1F}};
    const std::uint32_t voxel = grid.add_points(scan)[0];
    EXPECT_EQ(grid[voxel].evidence.n_own, 1);  // once a scan
    EXPECT_EQ(grid[voxel].score, 0.0F);        // nobody looked
    grid.record(voxel, Sight::free, 1, true);
    grid.update_score(voxel);
    const float free = grid[voxel].score;
    EXPECT_GT(free, 0.0F);
    for (int i = 0; i < 10; ++i) {
        grid.add_points(scan);
        grid.record(voxel, Sight::occupied, 1, true);
        grid.update_score(voxel);
    }
    EXPECT_LT(grid[voxel].score, free);
    EXPECT_EQ(grid[voxel].evidence.last_owner, 10U);
    grid.record(voxel, Sight::occupied, 1, false);  // an older keyframe
    grid.update_score(voxel);
    scan.points = {{9.0F, 0.1F, 0.1F}};
    grid.add_points(scan);
    grid.record(voxel, Sight::occupied, 1, true);  // the newest has no point there
    grid.update_score(voxel);
    EXPECT_EQ(grid[voxel].evidence.hits, 10);
    EXPECT_EQ(grid[voxel].evidence.n_occ, 12);
}

TEST(EvidenceGrid, KeepsWhatIsNear) {
    test::Random random(3);
    EvidenceGrid grid = empty_grid();
    grid.add_points(cloud(random, 3000, 6.0));
    const EvidenceGrid before = grid;
    const auto kept = grid.keep_within(Point(1.0F, 0.0F, 0.0F), 3.0F, SIZE_MAX);
    ASSERT_EQ(kept.size(), grid.size());
    EXPECT_LT(kept.size(), before.size());
    for (std::uint32_t v = 0; v < grid.size(); ++v) {
        EXPECT_EQ(grid.voxels().key(v), before.voxels().key(kept[v]));
        EXPECT_EQ(grid[v].centroid, before[kept[v]].centroid);
    }
    for (const std::uint32_t v : before.within(Point(1.0F, 0.0F, 0.0F), 2.0F)) {
        EXPECT_TRUE(grid.voxels().find(before.voxels().key(v)));
    }
}

}  // namespace
}  // namespace dynamic_filter
