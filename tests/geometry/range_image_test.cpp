// SPDX-License-Identifier: MIT
#include "dynamic_filter/range_image.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "support/random.hpp"

namespace dynamic_filter {
namespace range_image_test {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr double kDeg = std::numbers::pi / 180.0;

Point polar(double azimuth, double elevation, double range) {
    return (range * Eigen::Vector3d(std::cos(elevation) * std::cos(azimuth),
                                    std::cos(elevation) * std::sin(azimuth), std::sin(elevation)))
        .cast<float>();
}

/// One sweep: `rings` beams between two elevations, `columns` firings, noisy ranges, some missing.
Scan sweep(test::Random& random, int rings, double lowest_deg, double highest_deg, int columns) {
    Scan scan;
    for (int c = 0; c < columns; ++c) {
        for (int r = 0; r < rings; ++r) {
            if (random.chance(0.1)) continue;
            const double elevation = lowest_deg + (highest_deg - lowest_deg) * r / (rings - 1);
            const double azimuth = 360.0 * c / columns + random.uniform(-0.005, 0.005);
            scan.points.push_back(
                polar(azimuth * kDeg, elevation * kDeg, random.uniform(2.0, 40.0)));
        }
    }
    return scan;
}

TEST(MakeGrid, WholeColumnsFillTheCircleAndStepsAreAtLeastTheOnesAsked) {
    test::Random random(1);
    for (int i = 0; i < 1000; ++i) {
        const float azimuth = random.uniform_f(0.002, 0.5),
                    elevation = random.uniform_f(0.002, 0.5);
        const ImageGrid grid = make_grid(azimuth, elevation, -0.4F, 0.3F);
        EXPECT_NEAR(grid.columns * static_cast<double>(grid.azimuth_step), 360.0 * kDeg, 1e-4);
        EXPECT_GE(grid.azimuth_step, azimuth * 0.99999F);
        EXPECT_LT(grid.azimuth_step, azimuth * (1.0F + azimuth));
        EXPECT_EQ(grid.elevation_step, elevation);
        EXPECT_EQ(grid.size(), static_cast<std::size_t>(grid.columns * grid.rows));
    }
}

TEST(MakeGrid, CoversTheElevationsWithHalfARowOfMarginBelow) {
    test::Random random(2);
    for (int i = 0; i < 1000; ++i) {
        const float low = random.uniform_f(-1.5, 1.5),
                    high = low + random.uniform_f(0.0, 1.5 - low);
        const float step = random.uniform_f(0.002, 0.3);
        const ImageGrid grid = make_grid(0.1F, step, low, high);
        const float top = grid.elevation_min + static_cast<float>(grid.rows) * step;
        EXPECT_NEAR(grid.elevation_min, low - 0.5F * step, 1e-6);
        EXPECT_GT(top, high - 1e-5F);
        EXPECT_LE(top, high + step + 1e-5F);  // and no row more than needed
    }
}

TEST(MakeGrid, SurvivesStepsWiderThanTheCircle) {
    const ImageGrid grid = make_grid(100.0F, 100.0F, -1.0F, 1.0F);
    EXPECT_EQ(grid.columns, 1);
    EXPECT_EQ(grid.rows, 1);
}

TEST(Project, EveryPointBetweenTheElevationsHasAPixel) {
    test::Random random(3);
    for (int repeat = 0; repeat < 20; ++repeat) {
        const Points points = random.points(500, 20.0);
        const auto [low, high] = elevation_range(points);
        Projection out;
        const ImageGrid grid =
            make_grid(random.uniform_f(0.01, 0.1), random.uniform_f(0.01, 0.1), low, high);
        project(points, Eigen::Isometry3f::Identity(), grid, out);
        for (const auto pixel : out.pixel) {
            ASSERT_GE(pixel, 0);
            ASSERT_LT(static_cast<std::size_t>(pixel), grid.size());
        }
    }
}

TEST(Project, MovesThePointsFirst) {
    test::Random random(4);
    const ImageGrid grid = make_grid(0.05F, 0.05F, -1.5F, 1.5F);
    const Pose pose = random.pose(5.0, 3.0);
    const Points points = random.points(300, 20.0);
    Projection moved;
    project(points, pose.cast<float>(), grid, moved);
    for (std::size_t i = 0; i < points.size(); ++i) {
        EXPECT_NEAR(moved.range[i], (pose * points[i].cast<double>()).norm(), 1e-4);
    }
}

TEST(NearestRangeImage, KeepsTheNearestRangeOfEveryPixel) {
    test::Random random(5);
    Points points = random.points(5000, 20.0);
    points.insert(points.end(), {{kNan, 0, 0}, {0, 0, 0}, {kInf, 0, 0}, {0, 0, 5}});
    const ImageGrid grid = make_grid(0.1F, 0.1F, -0.5F, 0.5F);
    const RangeImage image = nearest_range_image(points, grid);
    ASSERT_EQ(image.range.size(), grid.size());
    std::vector<float> expected(grid.size(), kInf);
    for (const Point& p : points) {  // one by one
        Projection out;
        project(std::span(&p, 1), Eigen::Isometry3f::Identity(), grid, out);
        if (out.pixel[0] < 0) continue;
        const auto pixel = static_cast<std::size_t>(out.pixel[0]);
        if (out.range[0] < expected[pixel]) expected[pixel] = out.range[0];
    }
    EXPECT_EQ(image.range, expected);
    EXPECT_TRUE(std::count(expected.begin(), expected.end(), kInf) > 0);
}

TEST(NearestRangeImage, OfNothingIsEmpty) {
    const RangeImage image = nearest_range_image({}, make_grid(0.5F, 0.5F, 0.0F, 0.0F));
    for (const float range : image.range) EXPECT_EQ(range, kInf);
}

TEST(ElevationRange, AgreesWithTrigonometry) {
    test::Random random(6);
    for (int repeat = 0; repeat < 100; ++repeat) {
        Points points = random.points(1 + random.below(20), 10.0);
        double low = 10.0, high = -10.0;
        for (const Point& p : points) {
            const double e = std::asin(p.cast<double>().normalized().z());
            low = std::min(low, e);
            high = std::max(high, e);
        }
        points.insert(points.begin(), {{kNan, 0, 9}, {0, 0, 0}, {0, 0, kInf}});
        const auto range = elevation_range(points);
        EXPECT_NEAR(range.min, low, 1e-5);
        EXPECT_NEAR(range.max, high, 1e-5);
    }
}

TEST(ElevationRange, ReachesThePoles) {
    const auto range = elevation_range(Points{{0, 0, 1}, {0, 0, -1}});
    EXPECT_NEAR(range.min, -90.0 * kDeg, 1e-6);
    EXPECT_NEAR(range.max, 90.0 * kDeg, 1e-6);
}

TEST(ElevationRange, OfNothingIsZero) {
    for (const Points& points : {Points{}, Points{{0, 0, 0}, {kNan, 1, 1}}}) {
        const auto range = elevation_range(points);
        EXPECT_EQ(range.min, 0.0F);
        EXPECT_EQ(range.max, 0.0F);
    }
}

TEST(BeamPattern, FindsTheSpacingOfSpinningSensors) {
    test::Random random(7);
    struct Sensor {
        int rings;
        double lowest, highest;
        int columns;
    };
    for (const Sensor s : {Sensor{16, -15, 15, 1800},
                           {16, -15, 15, 900},
                           {32, -30.67, 10.67, 1084},
                           {32, -16, 15, 1800},
                           {64, -24.8, 2, 2083},
                           {64, -22.5, 22.5, 1024}}) {
        const Scan scan = sweep(random, s.rings, s.lowest, s.highest, s.columns);
        const BeamPattern beams = estimate_beam_pattern(std::span(&scan, 1));
        const double rows = (s.highest - s.lowest) / (s.rings - 1) * kDeg,
                     columns = 360.0 / s.columns * kDeg;
        EXPECT_NEAR(beams.elevation_spacing, rows, 0.01 * rows) << s.rings << " " << s.columns;
        EXPECT_NEAR(beams.azimuth_spacing, columns, 0.01 * columns) << s.rings << " " << s.columns;
    }
}

TEST(HalveRows, HoldsTheNearerOfARowAndTheOneItBorders) {
    test::Random random(21);
    const float none = std::numeric_limits<float>::infinity();
    RangeImage image{make_grid(0.1F, 0.05F, -0.2F, 0.2F), {}};
    for (std::size_t i = 0; i < image.grid.size(); ++i) {
        image.range.push_back(random.below(4) == 0 ? none
                                                   : static_cast<float>(random.uniform(1, 9)));
    }
    const RangeImage halved = halve_rows(image);
    ASSERT_EQ(halved.grid.rows, 2 * image.grid.rows);
    ASSERT_EQ(halved.grid.columns, image.grid.columns);
    EXPECT_FLOAT_EQ(halved.grid.elevation_step, image.grid.elevation_step / 2);
    EXPECT_EQ(halved.grid.elevation_min, image.grid.elevation_min);
    const auto at = [](const RangeImage& i, int row, int column) {
        return i.range[static_cast<std::size_t>(row * i.grid.columns + column)];
    };
    for (int row = 0; row < halved.grid.rows; ++row) {
        const int own = row / 2, next = row % 2 == 0 ? own - 1 : own + 1;
        for (int column = 0; column < image.grid.columns; ++column) {
            float expected = at(image, own, column);
            if (expected < none && next >= 0 && next < image.grid.rows) {
                expected = std::min(expected, at(image, next, column));
            }
            EXPECT_EQ(at(halved, row, column), expected) << row << ' ' << column;
        }
    }
}

TEST(BeamPattern, DoesNotDependOnTheOrderOfThePoints) {
    test::Random random(8);
    Scan scan = sweep(random, 16, -15, 15, 360);
    const BeamPattern sorted = estimate_beam_pattern(std::span(&scan, 1));
    for (std::size_t i = scan.points.size(); i > 1; --i) {
        std::swap(scan.points[i - 1], scan.points[random.below(i)]);
    }
    scan.points.insert(scan.points.begin(), {{kNan, 0, 0}, {0, 0, 0}});
    const BeamPattern shuffled = estimate_beam_pattern(std::span(&scan, 1));
    EXPECT_EQ(sorted.azimuth_spacing, shuffled.azimuth_spacing);
    EXPECT_EQ(sorted.elevation_spacing, shuffled.elevation_spacing);
}

TEST(BeamPattern, ScansWithoutTwoPointsLeaveZeroAndDoNotDisturbOthers) {
    test::Random random(9);
    std::vector<Scan> scans(3);
    scans[1].points = {{1, 2, 3}};
    scans[2].points = {{kNan, 2, 3}, {0, 0, 0}};
    const BeamPattern nothing = estimate_beam_pattern(scans);
    EXPECT_EQ(nothing.azimuth_spacing, 0.0F);
    EXPECT_EQ(nothing.elevation_spacing, 0.0F);
    EXPECT_EQ(estimate_beam_pattern({}).azimuth_spacing, 0.0F);
    scans.push_back(sweep(random, 16, -15, 15, 360));
    EXPECT_NEAR(estimate_beam_pattern(scans).elevation_spacing, 2.0 * kDeg, 0.2 * kDeg);
}

}  // namespace range_image_test
}  // namespace dynamic_filter
