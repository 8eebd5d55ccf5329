// SPDX-License-Identifier: MIT
#include "geometry/project_kernel.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "dynamic_filter/range_image.hpp"
#include "support/levels.hpp"
#include "support/random.hpp"

namespace dynamic_filter {
namespace project_kernel_test {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr double kPi = std::numbers::pi;

struct Level {
    std::string name;
    void (*project)(const kernel::ProjectArgs&);
    void (*to_spherical)(const kernel::SphericalArgs&);
};

/// Every level that this machine can run.
std::vector<Level> levels() {
    const auto project = DYNAMIC_FILTER_LEVELS_OF(project);
    const auto to_spherical = DYNAMIC_FILTER_LEVELS_OF(to_spherical);
    std::vector<Level> all;
    for (std::size_t i = 0; i < project.size(); ++i) {
        all.push_back({project[i].name, project[i].run, to_spherical[i].run});
    }
    return all;
}

Projection run(const Level& level, const Points& points, const Pose& T_image_points,
               const ImageGrid& grid) {
    Projection out;
    out.pixel.assign(points.size() + 1, -7);  // the last one is a guard
    out.range.assign(points.size() + 1, -7.0F);
    const Eigen::Matrix<float, 3, 4, Eigen::RowMajor> matrix =
        T_image_points.matrix().topRows<3>().cast<float>();
    level.project({.xyz = points.empty() ? nullptr : points.front().data(),
                   .count = points.size(),
                   .matrix = matrix.data(),
                   .elevation_min = grid.elevation_min,
                   .inverse_azimuth_step = 1.0F / grid.azimuth_step,
                   .inverse_elevation_step = 1.0F / grid.elevation_step,
                   .columns = grid.columns,
                   .rows = grid.rows,
                   .pixel = out.pixel.data(),
                   .range = out.range.data()});
    EXPECT_EQ(out.pixel.back(), -7);
    EXPECT_EQ(out.range.back(), -7.0F);
    out.pixel.pop_back();
    out.range.pop_back();
    return out;
}

ImageGrid whole_sphere(double step_deg) {
    const auto step = static_cast<float>(step_deg * kPi / 180.0);
    return make_grid(step, step, static_cast<float>(-kPi / 2), static_cast<float>(kPi / 2));
}

/// Random points and every awkward one.
Points awkward_points(test::Random& random, std::size_t count) {
    Points points = random.points(count, 40.0);
    const float values[] = {0.0F,  -0.0F, 1.0F,  -1.0F, 1e-30F, -1e-30F, 1e-42F,
                            1e18F, 1e25F, 3e38F, kInf,  -kInf,  kNan};
    for (const float x : values) {
        for (const float y : values) {
            for (const float z : values) points.emplace_back(x, y, z);
        }
    }
    return points;
}

TEST(ProjectKernel, EveryLevelGivesTheSameBits) {
    test::Random random(1);
    const auto all = levels();
    for (const std::size_t count : {0, 1, 3, 7, 15, 16, 17, 31, 1000, 20000}) {
        const Pose pose = random.pose(5.0, 3.0);
        Points points = count < 1000 ? random.points(count, 40.0) : awkward_points(random, count);
        const ImageGrid grid = whole_sphere(random.uniform(0.3, 4.0));
        const Projection expected = run(all.front(), points, pose, grid);
        for (const Level& level : all) {
            const Projection actual = run(level, points, pose, grid);
            for (std::size_t i = 0; i < points.size(); ++i) {
                ASSERT_EQ(actual.pixel[i], expected.pixel[i]) << level.name << " " << i;
                if (std::isnan(expected.range[i])) continue;  // a NaN's payload says nothing
                ASSERT_EQ(std::bit_cast<std::uint32_t>(actual.range[i]),
                          std::bit_cast<std::uint32_t>(expected.range[i]))
                    << level.name << " " << i;
            }
        }
    }
}

TEST(SphericalKernel, EveryLevelGivesTheSameBits) {
    test::Random random(5);
    const Points points = awkward_points(random, 5000);
    const Eigen::Matrix<float, 3, 4, Eigen::RowMajor> matrix =
        random.pose(5.0, 3.0).matrix().topRows<3>().cast<float>();
    const auto run_level = [&](const Level& level) {
        std::vector<float> out(3 * points.size());
        level.to_spherical({.xyz = points.front().data(),
                            .count = points.size(),
                            .matrix = matrix.data(),
                            .azimuth = out.data(),
                            .elevation = out.data() + points.size(),
                            .range = out.data() + 2 * points.size()});
        return out;
    };
    const auto all = levels();
    const auto expected = run_level(all.front());
    for (const Level& level : all) {
        const auto actual = run_level(level);
        for (std::size_t i = 0; i < expected.size(); ++i) {
            if (std::isnan(expected[i])) continue;
            ASSERT_EQ(std::bit_cast<std::uint32_t>(actual[i]),
                      std::bit_cast<std::uint32_t>(expected[i]))
                << level.name << " " << i;
        }
    }
}

TEST(ProjectKernel, AgreesWithTrigonometryInDoublePrecision) {
    test::Random random(2);
    int compared = 0;
    for (const double step : {0.2, 1.0, 5.0}) {
        const ImageGrid grid = whole_sphere(step);
        const Pose pose = random.pose(3.0, 3.0);
        const Points points = random.points(20000, 30.0);
        for (const Level& level : levels()) {
            const Projection out = run(level, points, pose, grid);
            for (std::size_t i = 0; i < points.size(); ++i) {
                const Eigen::Vector3d p = pose * points[i].cast<double>();
                if (p.norm() < 0.5) continue;
                ASSERT_NEAR(out.range[i], p.norm(), 1e-5 * p.norm() + 1e-5);
                const double u = (std::atan2(p.y(), p.x()) + kPi) / grid.azimuth_step;
                const double v =
                    (std::asin(p.z() / p.norm()) - grid.elevation_min) / grid.elevation_step;
                // The polynomial errs by 2e-5 rad; near the zenith azimuths are not sharp.
                const double error = 1e-4 / grid.elevation_step;
                if (std::abs(u - std::round(u)) < error || std::abs(v - std::round(v)) < error)
                    continue;
                if (p.head<2>().norm() < 0.5) continue;
                ASSERT_EQ(out.pixel[i], static_cast<int>(v) * grid.columns + static_cast<int>(u));
                ++compared;
            }
        }
    }
    EXPECT_GT(compared, 50000);
}

TEST(ProjectKernel, AzimuthWrapsAtPlusAndMinusPi) {
    const ImageGrid grid = whole_sphere(2.0);
    const int row = grid.rows / 2;
    const Points points{{-1, 0.0F, 0.01F},
                        {-1, -0.0F, 0.01F},
                        {-1, -1e-30F, 0.01F},
                        {-1, -1e-3F, 0.01F},
                        {-1, 1e-3F, 0.01F}};
    for (const Level& level : levels()) {
        const Projection out = run(level, points, Pose::Identity(), grid);
        for (int i = 0; i < 4; ++i) {
            EXPECT_EQ(out.pixel[static_cast<std::size_t>(i)], row * grid.columns)
                << level.name << i;
        }
        EXPECT_EQ(out.pixel[4], row * grid.columns + grid.columns - 1);
    }
}

TEST(ProjectKernel, ThePolesAreInTheOutermostRows) {
    const ImageGrid grid = whole_sphere(2.0);
    for (const Level& level : levels()) {
        const Projection out = run(level, {{0, 0, 3}, {0, 0, -3}}, Pose::Identity(), grid);
        EXPECT_EQ(out.pixel[0] / grid.columns, grid.rows - 1);
        EXPECT_EQ(out.pixel[1] / grid.columns, 0);
        EXPECT_EQ(out.range[0], 3.0F);
    }
}

TEST(ProjectKernel, WhatIsNoMeasurementHasNoPixel) {
    const ImageGrid grid = whole_sphere(2.0);
    for (const Level& level : levels()) {
        const Points points{{0, 0, 0},    {kNan, 1, 1},  {1, kNan, 1}, {1, 1, kNan},
                            {kInf, 1, 1}, {1, -kInf, 1}, {1, 1, kInf}, {1e30F, 1, 1}};
        const Projection out = run(level, points, Pose::Identity(), grid);
        for (const auto pixel : out.pixel) EXPECT_EQ(pixel, -1) << level.name;
    }
}

TEST(ProjectKernel, PointsAboveAndBelowTheGridHaveNoPixel) {
    const ImageGrid grid = make_grid(0.1F, 0.1F, -0.2F, 0.3F);
    const float top = grid.elevation_min + static_cast<float>(grid.rows) * grid.elevation_step;
    const auto at = [](float elevation) {
        return Point(std::cos(elevation), 0, std::sin(elevation));
    };
    for (const Level& level : levels()) {
        const Points points{at(top + 1e-3F), at(top - 1e-3F), at(grid.elevation_min + 1e-3F),
                            at(grid.elevation_min - 1e-3F)};
        const Projection out = run(level, points, Pose::Identity(), grid);
        EXPECT_EQ(out.pixel[0], -1);
        EXPECT_EQ(out.pixel[1] / grid.columns, grid.rows - 1);
        EXPECT_EQ(out.pixel[2] / grid.columns, 0);
        EXPECT_GE(out.pixel[2], 0);
        EXPECT_EQ(out.pixel[3], -1);
    }
}

TEST(SphericalKernel, EveryLevelAgreesWithTheLibraryFunctionsBitForBitAmongThem) {
    test::Random random(5);
    const Points points = random.points(1003, 40.0);
    const Pose T_image_points = random.pose(5.0, 3.0);
    const Eigen::Matrix<float, 3, 4, Eigen::RowMajor> matrix =
        T_image_points.matrix().topRows<3>().cast<float>();
    std::vector<std::vector<float>> all;
    for (const Level& level : levels()) {
        std::vector<float> out(3 * points.size() + 1, -7.0F);  // the last one is a guard
        float* const azimuth = out.data();
        float* const elevation = azimuth + points.size();
        float* const range = elevation + points.size();
        level.to_spherical({.xyz = points.front().data(),
                            .count = points.size(),
                            .matrix = matrix.data(),
                            .azimuth = azimuth,
                            .elevation = elevation,
                            .range = range});
        EXPECT_EQ(out.back(), -7.0F);
        for (std::size_t i = 0; i < points.size(); ++i) {
            const Eigen::Vector3d p = T_image_points * points[i].cast<double>();
            const double across = p.head<2>().norm();
            if (across < 0.1) continue;
            EXPECT_NEAR(azimuth[i], std::atan2(p.y(), p.x()), 1e-4 / across + 3e-5) << level.name;
            EXPECT_NEAR(elevation[i], std::atan2(p.z(), across), 1e-4 / across + 3e-5);
            EXPECT_NEAR(range[i], p.norm(), 1e-4);
        }
        all.push_back(out);
        EXPECT_EQ(all.back(), all.front()) << level.name;
    }
}

}  // namespace project_kernel_test
}  // namespace dynamic_filter
