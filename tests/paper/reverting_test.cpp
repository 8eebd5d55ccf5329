// SPDX-License-Identifier: MIT
#include "paper/reverting.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <limits>
#include <numbers>

#include "support/random.hpp"

namespace dynamic_filter {
namespace reverting_test {

FrontEndConfig config_with(int neighbors, double dist_max = 0.05) {
    FrontEndConfig config;
    config.revert_radius = 0.5;
    config.revert_neighbors = neighbors;
    config.revert_dist_max = dist_max;
    return config;
}

bool fits_among(const Points& still, const Point& point, const FrontEndConfig& config) {
    const NeighborGrid grid(still, static_cast<float>(config.revert_radius));
    return fits_static_map(point, grid, config);
}

/// A plane z = 0 sampled every 0.1 m.
Points ground() {
    Points points;
    for (int x = -20; x <= 20; ++x) {
        for (int y = -20; y <= 20; ++y) {
            points.emplace_back(0.1F * static_cast<float>(x), 0.1F * static_cast<float>(y), 0.0F);
        }
    }
    return points;
}

/// The definition, spelt out with another solver; empty if too close to call.
std::optional<bool> by_hand(const Points& still, const Point& point, const FrontEndConfig& config) {
    std::vector<std::pair<float, std::size_t>> near;
    for (std::size_t i = 0; i < still.size(); ++i) {
        const float d = (still[i] - point).norm();
        if (d <= static_cast<float>(config.revert_radius)) near.emplace_back(d, i);
    }
    std::sort(near.begin(), near.end());
    near.resize(std::min(near.size(), static_cast<std::size_t>(config.revert_neighbors)));
    if (near.size() < 3) return false;
    Points chosen;
    for (const auto& [d, i] : near) chosen.push_back(still[i]);
    const auto solve = [](const Points& points) {
        Eigen::Vector3d mean = Eigen::Vector3d::Zero();
        for (const Point& p : points) mean += p.cast<double>() / static_cast<double>(points.size());
        Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
        for (const Point& p : points) {
            covariance += (p.cast<double>() - mean) * (p.cast<double>() - mean).transpose();
        }
        return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance);
    };
    const auto before = solve(chosen);
    chosen.push_back(point);
    const auto after = solve(chosen);
    for (const auto& solver : {before, after}) {
        const Eigen::Vector3d v = solver.eigenvalues();
        if (v[1] < 1e-3 * v[2] || v[1] < 1.2 * v[0]) return std::nullopt;
    }
    const Eigen::Vector3d a = before.eigenvectors().col(0), b = after.eigenvectors().col(0);
    const double change = std::min((a - b).norm(), (a + b).norm());
    if (std::abs(change - config.revert_dist_max) < 1e-4) return std::nullopt;
    return change < config.revert_dist_max;
}

TEST(Reverting, APointOnAPlaneFitsAndOneWellAboveDoesNot) {
    test::Random random(1);
    for (int i = 0; i < 300; ++i) {
        const Pose pose = random.pose(5.0, 3.0);
        Points plane = ground();
        for (Point& p : plane) p = (pose * p.cast<double>()).cast<float>();
        const double x = random.uniform(-1.0, 1.0), y = random.uniform(-1.0, 1.0);
        const auto at = [&](double z) {
            return Point((pose * Eigen::Vector3d(x, y, z)).cast<float>());
        };
        EXPECT_TRUE(fits_among(plane, at(0.0), config_with(5)));
        EXPECT_FALSE(fits_among(plane, at(0.3), config_with(5)));
        EXPECT_FALSE(fits_among(plane, at(0.6), config_with(5)));  // nothing within the radius
    }
}

TEST(Reverting, AgreesWithTheDefinition) {
    test::Random random(2);
    int fitting = 0, others = 0;
    for (const int k : {3, 5, 10, 50}) {
        for (const double dist_max : {0.02, 0.1, 0.5}) {
            for (int scene = 0; scene < 10; ++scene) {
                const Eigen::Vector3d normal = random.direction();
                Points still = random.points(600, 1.0);
                for (Point& p : still) {  // a rough surface
                    p -= (normal * (normal.dot(p.cast<double>()) - random.uniform(-0.05, 0.05)))
                             .cast<float>();
                }
                const FrontEndConfig config = config_with(k, dist_max);
                for (int i = 0; i < 30; ++i) {
                    Point point = random.point(1.0);
                    point -= 0.8F * (normal * normal.dot(point.cast<double>())).cast<float>();
                    const auto expected = by_hand(still, point, config);
                    if (!expected) continue;
                    ASSERT_EQ(fits_among(still, point, config), *expected);
                    ++(*expected ? fitting : others);
                }
            }
        }
    }
    EXPECT_GT(fitting, 300);
    EXPECT_GT(others, 300);
}

TEST(Reverting, FewerThanThreeNeighboursNeverFit) {
    const FrontEndConfig config = config_with(5, 2.0);
    const Point point(0.1F, 0.1F, 0.0F);
    EXPECT_FALSE(fits_among({}, point, config));
    EXPECT_FALSE(fits_among({{0, 0, 0}}, point, config));
    EXPECT_FALSE(fits_among({{0, 0, 0}, {0.2F, 0, 0}}, point, config));
    EXPECT_TRUE(fits_among({{0, 0, 0}, {0.2F, 0, 0}, {0, 0.2F, 0}}, point, config));
    EXPECT_FALSE(fits_among({{0, 0, 0}, {0.2F, 0, 0}, {0, 9, 0}}, point, config));  // one is far
}

TEST(Reverting, NeighboursOnALineOrASpotNeverFit) {
    const FrontEndConfig config = config_with(5, 2.0);
    const Points line{{0, 0, 0}, {0.1F, 0, 0}, {0.2F, 0, 0}, {0.3F, 0, 0}};
    EXPECT_FALSE(fits_among(line, {0.1F, 0.1F, 0}, config));
    EXPECT_FALSE(fits_among(Points(5, {0, 0, 0}), {0.1F, 0.1F, 0}, config));
}

TEST(Reverting, WithoutTheCapMorePointsAboveThePlaneWouldFit) {
    const Point above(0.02F, 0.03F, 0.25F);
    EXPECT_FALSE(fits_among(ground(), above, config_with(5)));
    EXPECT_TRUE(fits_among(ground(), above, config_with(100)));
}

TEST(Reverting, NoChangeIsSmallerThanZero) {
    EXPECT_FALSE(fits_among(ground(), {0.02F, 0.03F, 0.0F}, config_with(5, 0.0)));
}

TEST(Reverting, APointThatIsNotANumberDoesNotFit) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_FALSE(fits_among(ground(), {nan, 0, 0}, config_with(5)));
}

TEST(RevertByMap, TurnsExactlyTheDynamicPointsThatFit) {
    Window window;
    window.scans.resize(2);
    for (Scan& scan : window.scans) {
        scan.T_world_sensor.translation() = Eigen::Vector3d(1.0, 0.0, 1.5);
        scan.T_world_sensor.linear() =
            Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitZ()).toRotationMatrix();
        scan.points = {{0.2F, 0.3F, -1.5F}, {0.2F, 0.3F, -1.2F}, {0.2F, 0.3F, -1.5F}, {0, 0, 0}};
    }
    const Labels before{Label::dynamic, Label::dynamic, Label::static_, Label::unknown};
    std::vector<Labels> labels(2, before);
    labels[1][2] = Label::dynamic;
    const NeighborGrid grid(ground(), 0.5F);
    revert_by_map(window, grid, config_with(5), labels);
    const Labels after{Label::static_, Label::dynamic, Label::static_, Label::unknown};
    EXPECT_EQ(labels[0], after);
    EXPECT_EQ(labels[1], after);
}

}  // namespace reverting_test
}  // namespace dynamic_filter
