// SPDX-License-Identifier: MIT
#include "filter/evidence_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/random.hpp"

namespace dynamic_filter {
namespace evidence_grid_test {

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

TEST(EvidenceGrid, ACentroidIsTheMeanOfThePointsInTheFirstScanThatHasAny) {
    test::Random random(4);
    EvidenceGrid grid = empty_grid();
    const Point far(2000.0F, -1500.0F, 40.0F);  // floats are coarse there
    for (int scans = 0; scans < 3; ++scans) {
        Scan scan = cloud(random, 3000, 1.0 + scans);
        for (Point& p : scan.points) p += far;
        const std::uint32_t known = grid.size();
        const PointVoxels voxels = grid.add_points(scan);
        std::vector<Eigen::Vector4d> sums(grid.size(), Eigen::Vector4d::Zero());
        for (std::size_t i = 0; i < voxels.size(); ++i) {
            sums[voxels[i]] += scan.points[i].cast<double>().homogeneous();
        }
        ASSERT_GT(grid.size(), known + 100);
        for (std::uint32_t v = known; v < grid.size(); ++v) {
            const Eigen::Vector3d mean = sums[v].hnormalized();
            EXPECT_LT((grid[v].centroid.cast<double>() - mean).norm(), 2e-4) << v;
        }
    }
}

TEST(EvidenceGrid, WithinFindsTheCentroidsInTheSphere) {
    test::Random random(5);
    EvidenceGrid grid = empty_grid();
    grid.add_points(cloud(random, 5000, 4.0));
    for (const float radius : {0.3F, 2.0F, 10.0F}) {
        const Point center(1.0F, -2.0F, 0.5F);
        std::vector<std::uint32_t> found = grid.within(center, radius), expected;
        std::sort(found.begin(), found.end());
        for (std::uint32_t v = 0; v < grid.size(); ++v) {
            if ((grid[v].centroid - center).norm() <= radius) expected.push_back(v);
        }
        EXPECT_EQ(found, expected);
        EXPECT_FALSE(found.empty());
    }
}

/// Distance of the block of the voxel, by which keep_within() decides.
float distance_of(const EvidenceGrid& grid, std::uint32_t voxel, const Point& center) {
    return (grid.middle_of(grid.voxels().block_of_voxel(voxel)) - center).norm();
}

TEST(EvidenceGrid, KeepsTheNearestBlocksWhereThereAreTooManyVoxels) {
    test::Random random(6);
    EvidenceGrid grid = empty_grid();
    grid.add_points(cloud(random, 5000, 6.0));
    const EvidenceGrid before = grid;
    const Point center(1.0F, 0.0F, 0.0F);
    constexpr std::size_t kMost = 700;
    const auto kept = grid.keep_within(center, 100.0F, kMost);
    EXPECT_TRUE(std::is_sorted(kept.begin(), kept.end()));
    EXPECT_GE(kept.size(), kMost);
    float farthest = 0.0F;
    for (const std::uint32_t v : kept) {
        farthest = std::max(farthest, distance_of(before, v, center));
    }
    std::size_t nearer = 0, as_near = 0;
    for (std::uint32_t v = 0; v < before.size(); ++v) {
        nearer += distance_of(before, v, center) < farthest ? 1 : 0;
        as_near += distance_of(before, v, center) <= farthest ? 1 : 0;
    }
    EXPECT_EQ(kept.size(), as_near);
    EXPECT_LE(nearer, kMost);  // without the farthest blocks there are not too many
    // The radius holds even if there is room for more.
    EvidenceGrid small = before;
    const auto inside = small.keep_within(center, 1.5F, kMost);
    EXPECT_LT(inside.size(), kMost);
    EXPECT_GT(inside.size(), 10U);
    for (const std::uint32_t v : inside) EXPECT_LE(distance_of(before, v, center), 1.5F);
}

TEST(EvidenceGrid, WhatIsKeptHasItsNeighborsAndItsNewestScan) {
    test::Random random(7);
    EvidenceGrid grid = empty_grid();
    grid.add_points(cloud(random, 4000, 3.0));
    Scan right = cloud(random, 300, 1.0);
    for (Point& p : right.points) p.x() += 2.0F;
    grid.add_points(right);
    const EvidenceGrid before = grid;
    const auto corners = [](const EvidenceGrid& g, bool touched) {
        std::vector<VoxelKey> keys;
        for (const std::uint32_t b : g.blocks_touched(touched)) {
            keys.push_back(pack(g.voxels().corner(b)));
        }
        std::sort(keys.begin(), keys.end());
        return keys;
    };
    grid.keep_within(Point::Zero(), 100.0F, SIZE_MAX);  // everything, in the same order
    EXPECT_EQ(corners(grid, true), corners(before, true));
    EXPECT_EQ(corners(grid, false), corners(before, false));
    const auto kept = grid.keep_within(Point(1.0F, 0.0F, 0.0F), 1.5F, SIZE_MAX);
    ASSERT_GT(kept.size(), 100U);
    for (std::uint32_t v = 0; v < grid.size(); ++v) {
        EXPECT_EQ(grid[v].evidence.last_owner, before[kept[v]].evidence.last_owner);
        std::vector<VoxelKey> around, expected;
        grid.neighbors().each_within(grid.voxels(), 2, v, [&](std::uint32_t n, int) {
            around.push_back(grid.voxels().key(n));
        });
        before.neighbors().each_within(before.voxels(), 2, kept[v], [&](std::uint32_t n, int) {
            const VoxelKey key = before.voxels().key(n);
            if (grid.voxels().find(key)) expected.push_back(key);
        });
        EXPECT_EQ(around, expected);
    }
    // Blocks keep whether the newest scan has points in them.
    for (const VoxelKey corner : corners(grid, true)) {
        const auto all = corners(before, true);
        EXPECT_TRUE(std::binary_search(all.begin(), all.end(), corner));
    }
    EXPECT_FALSE(corners(grid, false).empty());
}

}  // namespace evidence_grid_test
}  // namespace dynamic_filter
