// SPDX-License-Identifier: MIT
#include "tracking/coarse_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "dynamic_filter/motion.hpp"
#include "support/planes.hpp"

namespace dynamic_filter {
namespace coarse_search_test {

/// Poles, and walls of a few metres, on a floor.
Points poles_and_walls(test::Random& random) {
    Points points =
        test::points_on({{{-40, -40, -1.7F}, {80, 0, 0}, {0, 80, 0}}}, 1.0, 0.02, random);
    for (int i = 0; i < 40; ++i) {
        const Point foot(random.uniform_f(-40, 40), random.uniform_f(-40, 40), -1.7F);
        for (int k = 0; k < 20; ++k) {
            points.push_back(foot + Point(0, 0, 0.2F * static_cast<float>(k)));
        }
    }
    for (int i = 0; i < 12; ++i) {
        const Point foot(random.uniform_f(-40, 40), random.uniform_f(-40, 40), -1.7F);
        const Point along(random.uniform_f(-9, 9), random.uniform_f(-9, 9), 0);
        const Points wall = test::points_on({{foot, along, {0, 0, 3}}}, 20.0, 0.02, random);
        points.insert(points.end(), wall.begin(), wall.end());
    }
    return points;
}

Pose seen_from_above(double x, double y, double turn) {
    return Pose(Eigen::Translation3d(x, y, 0.0) *
                Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()));
}

bool is_near(const Pose& a, const Pose& b) {
    const Twist off = log(a.inverse() * b);
    return off.head<3>().norm() < 1.0 && off.tail<3>().norm() < 0.03;
}

TEST(CoarseSearch, FindsADisplacement) {
    test::Random random(1);
    for (int i = 0; i < 6; ++i) {
        const Points map = poles_and_walls(random);
        const Pose truth = seen_from_above(random.uniform(-9, 9), random.uniform(-9, 9),
                                           random.uniform(-0.3, 0.3));
        const Points scan = moved(map, truth.inverse());
        const auto found = search_displacements(map, scan, {10.0, 0.35}, 6);
        ASSERT_FALSE(found.empty());
        EXPECT_TRUE(std::any_of(found.begin(), found.begin() + std::min<long>(2, std::ssize(found)),
                                [&](const Pose& pose) { return is_near(pose, truth); }));
    }
}

TEST(CoarseSearch, FindsItThoughMuchIsHiddenAndMuchIsNew) {
    test::Random random(2);
    const Points map = poles_and_walls(random);
    const Pose truth = seen_from_above(4.2, -3.1, 0.12);
    Points scan;
    for (const Point& p : moved(map, truth.inverse())) {
        if (p.x() > -5.0F && random.chance(0.7)) scan.push_back(p);
    }
    for (int i = 0; i < 15; ++i) {
        const Point foot = random.point(20.0);
        for (int k = 0; k < 10; ++k) {
            scan.emplace_back(foot.x(), foot.y(), -1.7F + 0.2F * static_cast<float>(k));
        }
    }
    const auto found = search_displacements(map, scan, {10.0, 0.35}, 6);
    EXPECT_TRUE(std::any_of(found.begin(), found.end(),
                            [&](const Pose& pose) { return is_near(pose, truth); }));
}

TEST(CoarseSearch, CandidatesLieInTheWindowAndApart) {
    test::Random random(3);
    const Points map = poles_and_walls(random);
    const auto found = search_displacements(map, map, {3.0, 0.1}, 6);
    ASSERT_EQ(found.size(), 6U);
    EXPECT_TRUE(found[0].isApprox(Pose::Identity(), 1e-12));
    for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_LE(found[i].translation().cwiseAbs().maxCoeff(), 3.0 + 1e-6);
        EXPECT_LE(log(found[i]).tail<3>().norm(), 0.1 + 0.0175);
        for (std::size_t k = 0; k < i; ++k) {
            const Twist off = log(found[k].inverse() * found[i]);
            EXPECT_GT(std::max(off.head<3>().norm(), off.tail<3>().norm() * 20.0), 1.0);
        }
    }
    EXPECT_EQ(search_displacements(map, map, {3.0, 0.1}, 1).size(), 1U);
    EXPECT_TRUE(search_displacements(map, map, {3.0, 0.1}, 0).empty());
}

TEST(CoarseSearch, SameInputSameBits) {
    test::Random random(4);
    const Points map = poles_and_walls(random);
    const Points scan = moved(map, seen_from_above(1.0, 2.0, 0.05).inverse());
    const auto one = search_displacements(map, scan, {5.0, 0.2}, 6);
    const auto two = search_displacements(map, scan, {5.0, 0.2}, 6);
    ASSERT_EQ(one.size(), two.size());
    for (std::size_t i = 0; i < one.size(); ++i) EXPECT_EQ(one[i].matrix(), two[i].matrix());
}

TEST(CoarseSearch, WhereNothingStandsUprightNothingIsFound) {
    test::Random random(5);
    const Points floor =
        test::points_on({{{-40, -40, -1.7F}, {80, 0, 0}, {0, 80, 0}}}, 5.0, 0.05, random);
    const Points scene = poles_and_walls(random);
    EXPECT_TRUE(search_displacements(floor, floor, {5.0, 0.2}, 6).empty());
    EXPECT_TRUE(search_displacements(scene, floor, {5.0, 0.2}, 6).empty());
    EXPECT_TRUE(search_displacements(floor, scene, {5.0, 0.2}, 6).empty());
    EXPECT_TRUE(search_displacements({}, {}, {5.0, 0.2}, 6).empty());
}

TEST(CoarseSearch, WhatIsTooFarOrNoNumberIsPassedOver) {
    test::Random random(6);
    Points map = poles_and_walls(random);
    const auto clean = search_displacements(map, map, {2.0, 0.1}, 2);
    Points dirty = map;
    for (const float bad : {1e9F, -3e38F, std::numeric_limits<float>::quiet_NaN()}) {
        dirty.emplace_back(bad, 0, 0);
        dirty.emplace_back(0, bad, 5);
        dirty.emplace_back(200.0F, 300.0F, 5);
    }
    const auto found = search_displacements(dirty, dirty, {2.0, 0.1}, 2);
    ASSERT_EQ(found.size(), clean.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_EQ(found[i].matrix(), clean[i].matrix());
    }
}

}  // namespace coarse_search_test
}  // namespace dynamic_filter
