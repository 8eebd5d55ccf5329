// SPDX-License-Identifier: MIT
#include "paper/visibility_check.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numbers>

#include "paper/normals.hpp"
#include "support/random.hpp"

namespace dynamic_filter {
namespace visibility_check_test {

const Point kRay = Point(1.0F, 0.05F, 0.05F).normalized();  // the middle of a pixel, nearly
const Point kHeadOn = kRay, kGrazing = Point(-kRay.y(), kRay.x(), 0.0F).normalized();

ImageGrid sphere(float step = 0.1F) { return make_grid(step, step, -1.5707F, 1.5707F); }

BackEndConfig config_with(double depth, bool correction = true) {
    BackEndConfig config;
    config.depth_channel = depth;
    config.incident_correction = correction;
    config.incident_threshold_deg = 75.0;
    return config;
}

struct Hit {
    float range;
    Point normal;
};

/// The boundary in the one pixel that holds all the hits of a ray from the query pose.
float boundary_of(const std::vector<Hit>& hits, const BackEndConfig& config,
                  const Pose& T_map_query = Pose::Identity()) {
    BufferedSubmap submap;
    for (const Hit& hit : hits) {
        submap.submap.points.push_back(
            (T_map_query * (hit.range * kRay).cast<double>()).cast<float>());
        submap.normals.push_back((T_map_query.linear() * hit.normal.cast<double>()).cast<float>());
    }
    const auto boundary = visibility_boundary(submap, T_map_query, sphere(), config);
    EXPECT_EQ(boundary.size(), sphere().size());
    const auto filled =
        std::count_if(boundary.begin(), boundary.end(), [](float b) { return b >= 0.0F; });
    EXPECT_EQ(filled, hits.empty() ? 0 : 1);
    return *std::max_element(boundary.begin(), boundary.end());
}

TEST(DepthChannel, IsTheIndexOfTheCellThatHoldsTheRange) {
    EXPECT_EQ(depth_channel(0.0F, 0.25F), 0.0F);
    EXPECT_EQ(depth_channel(0.2499F, 0.25F), 0.0F);
    EXPECT_EQ(depth_channel(0.25F, 0.25F), 1.0F);
    EXPECT_EQ(depth_channel(10.1F, 0.25F), 40.0F);
    EXPECT_EQ(depth_channel(10.1F, 0.0F), 10.1F);
}

TEST(VisibilityBoundary, IsTheFarthestOrdinaryPoint) {
    for (const auto& config : {config_with(0.0), config_with(0.0, false)}) {
        EXPECT_NEAR(boundary_of({{4, kHeadOn}, {9, kHeadOn}, {6, kHeadOn}}, config), 9.0F, 1e-4F);
    }
}

TEST(VisibilityBoundary, EndsAtTheNearestPseudoOccupiedPoint) {
    const auto config = config_with(0.0);
    EXPECT_NEAR(boundary_of({{4, kHeadOn}, {6, kGrazing}, {9, kHeadOn}}, config), 6.0F, 1e-4F);
    EXPECT_NEAR(boundary_of({{9, kHeadOn}, {8, kGrazing}, {6, kGrazing}, {4, kHeadOn}}, config),
                6.0F, 1e-4F);
    EXPECT_NEAR(boundary_of({{3, kGrazing}, {4, kHeadOn}}, config), 3.0F, 1e-4F);
    EXPECT_NEAR(boundary_of({{5, kHeadOn}, {7, kGrazing}}, config), 7.0F, 1e-4F);
    EXPECT_NEAR(boundary_of({{5, kGrazing}}, config), 5.0F, 1e-4F);
}

TEST(VisibilityBoundary, WithoutCorrectionIsTheFarthestPointOfAnyKind) {
    const auto config = config_with(0.0, false);
    EXPECT_NEAR(boundary_of({{4, kHeadOn}, {6, kGrazing}, {9, kHeadOn}}, config), 9.0F, 1e-4F);
    EXPECT_NEAR(boundary_of({{3, kGrazing}, {8, kGrazing}}, config), 8.0F, 1e-4F);
}

TEST(VisibilityBoundary, WithoutCorrectionNeedsNoNormals) {
    BufferedSubmap submap;
    submap.submap.points = {4.0F * kRay};
    const auto boundary =
        visibility_boundary(submap, Pose::Identity(), sphere(), config_with(0.0, false));
    EXPECT_NEAR(*std::max_element(boundary.begin(), boundary.end()), 4.0F, 1e-5F);
}

TEST(VisibilityBoundary, IsGivenInDepthChannels) {
    EXPECT_EQ(boundary_of({{4.1F, kHeadOn}, {9.1F, kHeadOn}}, config_with(0.2)), 45.0F);
    EXPECT_EQ(boundary_of({{4.1F, kGrazing}, {9.1F, kHeadOn}}, config_with(0.2)), 20.0F);
    EXPECT_EQ(boundary_of({{0.1F, kHeadOn}}, config_with(0.2)), 0.0F);
}

TEST(VisibilityBoundary, PointsWithoutANormalAreOrdinary) {
    EXPECT_NEAR(boundary_of({{4, Point::Zero()}, {9, kHeadOn}}, config_with(0.0)), 9.0F, 1e-4F);
}

TEST(VisibilityBoundary, IsSeenFromTheQueryPose) {
    test::Random random(1);
    for (int i = 0; i < 50; ++i) {
        const Pose pose = random.pose(20.0, 3.0);
        EXPECT_NEAR(
            boundary_of({{4, kHeadOn}, {6, kGrazing}, {9, kHeadOn}}, config_with(0.0), pose), 6.0F,
            1e-3F);
        EXPECT_NEAR(boundary_of({{4, kHeadOn}, {9, kHeadOn}}, config_with(0.0), pose), 9.0F, 1e-3F);
    }
}

TEST(VisibilityBoundary, OfAnEmptySubmapReachesNothing) {
    EXPECT_EQ(boundary_of({}, config_with(0.2)), -1.0F);
    EXPECT_EQ(boundary_of({}, config_with(0.0)), -1.0F);
}

TEST(VisibilityBoundary, AgreesWithAlgorithmOneOnRandomSubmaps) {
    test::Random random(2);
    const ImageGrid grid = sphere(0.4F);
    for (int repeat = 0; repeat < 20; ++repeat) {
        const auto config = config_with(repeat % 2 == 0 ? 0.2 : 0.0);
        const Pose pose = random.pose(3.0, 3.0);
        BufferedSubmap submap;
        submap.submap.points = random.points(2000, 10.0);
        submap.normals.resize(2000, Point::Zero());
        for (Point& n : submap.normals) {
            if (random.chance(0.9)) n = random.direction().cast<float>();
        }
        Projection seen;
        project(submap.submap.points, pose.inverse().cast<float>(), grid, seen);
        const Point viewpoint = pose.translation().cast<float>();
        const auto cosine = static_cast<float>(std::cos(75.0 * std::numbers::pi / 180.0));
        std::vector<float> expected(grid.size(), -1.0F);
        for (std::size_t pixel = 0; pixel < grid.size(); ++pixel) {
            float bound = std::numeric_limits<float>::infinity(), farthest = -1.0F;
            const auto visit = [&](auto&& look) {
                for (std::size_t i = 0; i < seen.pixel.size(); ++i) {
                    if (seen.pixel[i] == static_cast<std::int32_t>(pixel)) look(i);
                }
            };
            visit([&](std::size_t i) {
                if (is_grazing(submap.submap.points[i], submap.normals[i], viewpoint, cosine)) {
                    bound = std::min(bound, seen.range[i]);
                }
            });
            visit([&](std::size_t i) {
                if (seen.range[i] <= bound) farthest = std::max(farthest, seen.range[i]);
            });
            if (farthest >= 0.0F) {
                expected[pixel] = depth_channel(farthest, static_cast<float>(config.depth_channel));
            }
        }
        EXPECT_EQ(visibility_boundary(submap, pose, grid, config), expected);
        const BufferedSubmap empty;
        const std::vector<const BufferedSubmap*> nearby{&submap, &empty, &submap};
        const auto all = check_visibility(nearby, pose, grid, config);
        ASSERT_EQ(all.size(), 3U);
        EXPECT_EQ(all[0], expected);
        EXPECT_EQ(all[1], std::vector<float>(grid.size(), -1.0F));
        EXPECT_EQ(all[2], expected);
    }
}

}  // namespace visibility_check_test
}  // namespace dynamic_filter
