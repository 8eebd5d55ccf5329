// SPDX-License-Identifier: MIT
#include "paper/submap.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <set>
#include <tuple>

#include "support/random.hpp"

namespace dynamic_filter {
namespace submap_test {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

Labels random_labels(test::Random& random, std::size_t count) {
    Labels labels(count);
    for (Label& l : labels) l = random.chance(0.5) ? Label::static_ : Label::dynamic;
    return labels;
}

TEST(ToMap, MovesEveryPointByThePose) {
    test::Random random(1);
    Scan scan;
    scan.points = random.points(200, 30.0);
    scan.T_world_sensor = random.pose(50.0, 3.0);
    Points out(5000);  // left-overs must go
    to_map(scan, out);
    ASSERT_EQ(out.size(), scan.points.size());
    for (std::size_t i = 0; i < out.size(); ++i) {
        EXPECT_LT(
            (out[i].cast<double>() - scan.T_world_sensor * scan.points[i].cast<double>()).norm(),
            3e-5);
    }
}

TEST(Thinner, KeepsTheFirstKeptPointOfEveryHalfVoxel) {
    test::Random random(2);
    const float voxel_size = 0.5F;
    Thinner thinner(voxel_size);
    std::map<std::tuple<int, int, int>, Point> first;
    Points expected;
    for (int scan = 0; scan < 3; ++scan) {
        const Points points = random.points(2000, 2.0);
        const Labels labels = random_labels(random, points.size());
        thinner.add(points, labels, Label::static_);
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (labels[i] != Label::static_) continue;
            const Point c = (points[i].array() / 0.25F).floor();
            const auto cell = std::make_tuple(static_cast<int>(c.x()), static_cast<int>(c.y()),
                                              static_cast<int>(c.z()));
            if (first.emplace(cell, points[i]).second) expected.push_back(points[i]);
        }
    }
    EXPECT_EQ(thinner.points(), expected);
    EXPECT_EQ(thinner.moved_points(), expected);
}

TEST(Thinner, NeverChangesWhichVoxelsAreOwned) {
    test::Random random(3);
    for (const float voxel_size : {0.1F, 0.2F, 0.3F}) {
        const Points points = random.points(5000, 2.0);
        Thinner thinner(voxel_size);
        thinner.add(points, Labels(points.size(), Label::static_), Label::static_);
        std::set<VoxelKey> before, after;
        for (const Point& p : points) before.insert(*voxel_of(p, voxel_size));
        for (const Point& p : thinner.points()) after.insert(*voxel_of(p, voxel_size));
        EXPECT_EQ(before, after);
        EXPECT_LE(thinner.points().size(), 8 * after.size());
    }
}

TEST(Thinner, LeavesOutPointsThatNoKeyReaches) {
    Thinner thinner(0.2F);
    thinner.add({{kNan, 0, 0}, {1e9F, 0, 0}, {1, 2, 3}}, Labels(3, Label::static_), Label::static_);
    EXPECT_EQ(thinner.points(), (Points{{1, 2, 3}}));
    thinner.add({}, {}, Label::static_);
    EXPECT_EQ(thinner.points().size(), 1U);
}

TEST(VoxelOf, IsTheVoxelThatHoldsThePoint) {
    test::Random random(4);
    for (const float size : {0.25F, 0.5F, 2.0F}) {  // powers of two: no rounding
        for (int i = 0; i < 2000; ++i) {
            const Point p = random.point(20.0);
            const Point c = center(*voxel_of(p, size), size);
            EXPECT_LE((p - c).cwiseAbs().maxCoeff(), 0.5F * size);
            EXPECT_EQ(voxel_of(p, size), pack(*cell_of(p, 1.0F / size)));
        }
    }
}

TEST(VoxelOf, BordersBelongToTheVoxelAboveAlsoBelowZero) {
    for (int k = -6; k <= 6; ++k) {
        const Point on = Point::Constant(0.5F * static_cast<float>(k));
        EXPECT_EQ(unpack(*voxel_of(on, 0.5F)), Cell::Constant(k));
        EXPECT_EQ(unpack(*voxel_of(on.array() - 1e-6F, 0.5F)), Cell::Constant(k - 1));
    }
}

TEST(VoxelOf, IsEmptyWhereAKeyCannotReach) {
    EXPECT_FALSE(voxel_of({kNan, 0, 0}, 0.2F));
    EXPECT_FALSE(voxel_of({0, std::numeric_limits<float>::infinity(), 0}, 0.2F));
    EXPECT_FALSE(voxel_of({0, 0, -1e9F}, 0.2F));
    EXPECT_TRUE(voxel_of({1e5F, -1e5F, 0}, 0.2F));
}

}  // namespace submap_test
}  // namespace dynamic_filter
