// SPDX-License-Identifier: MIT
#include "filter/line_of_sight.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <optional>

#include "support/random.hpp"

namespace dynamic_filter {
namespace line_of_sight_test {

constexpr double kDeg = std::numbers::pi / 180.0;
const SightMargins margins = margins_of(ScansConfig{}.sight, Config{}.map.voxel_size);

using Scene = std::function<std::optional<double>(const Eigen::Vector3d& ray)>;  // range

Eigen::Vector3d ray_to(double azimuth, double elevation) {
    return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
            std::sin(elevation)};
}

/// What a sensor sees of the scene with beams every `column` x `ring` degrees.
BeamImage scan(const Scene& scene, double column = 0.5, double ring = 2.0) {
    Points points;
    for (double azimuth = -179.8; azimuth < 180.0; azimuth += column) {
        for (double elevation = -16.0; elevation <= 16.0; elevation += ring) {
            const Eigen::Vector3d ray = ray_to(azimuth * kDeg, elevation * kDeg);
            if (const auto range = scene(ray)) points.push_back((*range * ray).cast<float>());
        }
    }
    return BeamImage(points, {static_cast<float>(column * kDeg), static_cast<float>(ring * kDeg)});
}

Beam place_of(const Eigen::Vector3d& p) {
    return {static_cast<float>(std::atan2(p.y(), p.x())),
            static_cast<float>(std::atan2(p.z(), std::hypot(p.x(), p.y()))),
            static_cast<float>(p.norm())};
}

Sight sight_of(const BeamImage& image, const Eigen::Vector3d& p) {
    const Beam place = place_of(p);
    std::vector<Sight> sights;
    check_lines_of_sight(image, {{place.azimuth}, {place.elevation}, {place.range}}, margins,
                         sights);
    return sights.at(0);
}

/// A wall across the x axis.
Scene wall(double distance) {
    return [=](const Eigen::Vector3d& ray) -> std::optional<double> {
        if (ray.x() < 0.1) return std::nullopt;
        return distance / ray.x();
    };
}

/// Flat ground below the sensor, seen to 60 m.
Scene ground(double height) {
    return [=](const Eigen::Vector3d& ray) -> std::optional<double> {
        if (ray.z() > -0.01) return std::nullopt;
        const double range = height / -ray.z();
        return range < 60.0 ? std::optional(range) : std::nullopt;
    };
}

TEST(LineOfSight, BeforeAWallIsFreeOnItIsOccupiedBehindItIsUnknown) {
    const BeamImage image = scan(wall(10.0));
    for (double y = -5.0; y <= 5.0; y += 0.37) {
        for (double z = -1.5; z <= 1.5; z += 0.23) {
            EXPECT_TRUE(is_free(sight_of(image, {6.0, y, 0.6 * z}))) << y << ' ' << z;
            EXPECT_EQ(sight_of(image, {11.0, y, z}), Sight::unknown) << y << ' ' << z;
            EXPECT_FALSE(is_free(sight_of(image, {10.0, y, z}))) << y << ' ' << z;
        }
    }
    EXPECT_EQ(sight_of(image, 10.0 / std::cos(4.0 * kDeg) * ray_to(0.2 * kDeg, 4.0 * kDeg)),
              Sight::occupied);
}

TEST(LineOfSight, WhereNothingReturnedNothingIsKnown) {
    const BeamImage image = scan(wall(10.0));
    EXPECT_EQ(sight_of(image, {-5.0, 0.0, 0.0}), Sight::unknown);
    EXPECT_EQ(sight_of(image, {1.0, 0.0, 5.0}), Sight::unknown);
    EXPECT_EQ(sight_of(scan([](const auto&) { return std::nullopt; }), {5, 0, 0}), Sight::unknown);
}

TEST(LineOfSight, NoGroundIsEverFreeHoweverGrazing) {
    for (const double height : {0.8, 1.7}) {
        const BeamImage image = scan(ground(height));
        int occupied = 0;
        for (double x = 2.0; x < 25.0; x += 0.13) {
            const Sight sight = sight_of(image, {x, 0.3 * x, -height});
            EXPECT_FALSE(is_free(sight)) << x;
            occupied += is_occupied(sight) ? 1 : 0;
        }
        EXPECT_GT(occupied, 100);  // between the rings too
    }
}

TEST(LineOfSight, WhatStoodOnTheGroundIsFreeOnceItIsGone) {
    const BeamImage image = scan(ground(1.7));
    for (double x = 5.0; x < 15.0; x += 0.31) {
        EXPECT_TRUE(is_free(sight_of(image, {x, 1.0, -1.4 + 0.01 * x}))) << x;
    }
}

bool is_sure_free(Sight sight) { return is_free(sight) && !is_weak(sight); }
bool is_weak_free(Sight sight) { return is_free(sight) && is_weak(sight); }

TEST(LineOfSight, IsWeakJustBeforeASurfaceAndAtTheBorderOfTheImage) {
    const BeamImage image = scan(wall(10.0));
    EXPECT_TRUE(is_sure_free(sight_of(image, {7.0, 0.3, 0.2})));
    EXPECT_TRUE(is_weak_free(sight_of(image, {9.75, 0.3, 0.2})));
    const Eigen::Vector3d above = ray_to(0.0, 16.2 * kDeg);  // of all beams
    EXPECT_TRUE(is_sure_free(sight_of(image, 7.0 * above)));
    EXPECT_TRUE(is_weak_free(sight_of(image, 9.0 * above)));
}

TEST(LineOfSight, KnowsWhetherABeamWentThroughThePlaceItself) {
    const BeamImage image = scan(wall(30.0));
    for (double turn = -20.0; turn < 20.0; turn += 0.37) {
        for (const double range : {2.0, 5.0, 25.0}) {  // beams are 0.05 m apart, and 0.9 m
            const Sight sight = sight_of(image, range * ray_to(turn * kDeg, 0.4 * turn * kDeg));
            ASSERT_TRUE(is_free(sight)) << turn << ' ' << range;
            EXPECT_TRUE(range > 3.0 || is_passed(sight)) << turn;
        }
    }
    int passed = 0, asked = 0;
    for (double up = -5.0; up < 5.0; up += 0.1, ++asked) {
        passed += is_passed(sight_of(image, 25.0 * ray_to(0.0, up * kDeg))) ? 1 : 0;
    }
    EXPECT_GT(passed, 0);
    EXPECT_LT(passed, asked / 2);
}

TEST(LineOfSight, NoWallAlongTheBeamsIsFree) {
    // A corridor: walls at y = +-2 and the ends far off.
    const BeamImage image = scan([](const Eigen::Vector3d& ray) -> std::optional<double> {
        const double to_side = 2.0 / std::max(std::abs(ray.y()), 1e-9);
        const double to_end = 50.0 / std::max(std::abs(ray.x()), 1e-9);
        return std::min(to_side, to_end);
    });
    for (double x = 0.5; x < 40.0; x += 0.17) {
        EXPECT_FALSE(is_free(sight_of(image, {x, 2.0, 0.2}))) << x;
        EXPECT_TRUE(is_free(sight_of(image, {std::min(x, 30.0) + 1.0, 0.0, 0.2}))) << x;
    }
}

TEST(LineOfSight, APoleThinnerThanTheMarginIsNotFree) {
    // 6 cm across, 5 m away, before a wall.
    const BeamImage image = scan([](const Eigen::Vector3d& ray) -> std::optional<double> {
        if (ray.x() < 0.1) return std::nullopt;
        const double y_at_pole = 5.0 * ray.y() / ray.x();
        return (std::abs(y_at_pole) < 0.03 ? 5.0 : 12.0) / ray.x();
    });
    for (double z = -0.6; z <= 0.6; z += 0.05) {
        EXPECT_FALSE(is_free(sight_of(image, {5.0, 0.0, z}))) << z;
        EXPECT_TRUE(is_free(sight_of(image, {5.0, 0.8, z}))) << z;
    }
}

TEST(LineOfSight, WrapsAroundTheBack) {
    const BeamImage image = scan([](const Eigen::Vector3d& ray) -> std::optional<double> {
        if (ray.x() > -0.1) return std::nullopt;
        return -10.0 / ray.x();
    });
    for (double y = -0.3; y <= 0.3; y += 0.01) {
        EXPECT_TRUE(is_free(sight_of(image, {-6.0, y, 0.1}))) << y;
        EXPECT_FALSE(is_free(sight_of(image, {-10.0, y, 0.1}))) << y;
    }
}

TEST(LineOfSight, JudgesOnlyWithinItsRange) {
    const BeamImage image = scan(wall(100.0));
    EXPECT_TRUE(is_free(sight_of(image, {70.0, 0.0, 0.0})));
    EXPECT_EQ(sight_of(image, {85.0, 0.0, 0.0}), Sight::unknown);
    EXPECT_EQ(sight_of(image, {0.2, 0.0, 0.0}), Sight::unknown);
    EXPECT_EQ(sight_of(image, {std::nan(""), 0.0, 0.0}), Sight::unknown);
}

TEST(LineOfSight, AtTheBorderOfTheViewOnlyABeamThatMeetsThePlaceCounts) {
    const BeamImage image = scan(wall(20.0));  // the highest beam goes up by 16 degrees
    EXPECT_TRUE(is_free(sight_of(image, 10.0 * ray_to(0.0, 16.2 * kDeg))));
    EXPECT_EQ(sight_of(image, 10.0 * ray_to(0.0, 17.2 * kDeg)), Sight::unknown);
}

TEST(MaySee, IsFalseOnlyWhereNothingIsKnown) {
    test::Random random(8);
    const auto room = [](const Eigen::Vector3d& ray) -> std::optional<double> {
        const double wall = 6.0 / std::max(std::abs(ray.x()), std::abs(ray.y()));
        return ray.y() > 0.5 ? std::nullopt : std::optional(ray.x() > 0.3 ? 3.0 * wall : wall);
    };
    int unseen = 0;
    for (const BeamImage& image : {scan(room), scan(room, 0.2, 0.5), scan(wall(70.0))}) {
        for (int i = 0; i < 3000; ++i) {
            const Eigen::Vector3d center(random.uniform(-90, 90), random.uniform(-90, 90),
                                         random.uniform(-25, 25));
            const double radius = random.uniform(0.1, 2.0);
            const Eigen::Vector3d offset =
                Eigen::Vector3d(random.uniform(-1, 1), random.uniform(-1, 1),
                                random.uniform(-1, 1)) *
                (radius / std::sqrt(3.0));
            if (may_see(image, place_of(center), static_cast<float>(radius), margins)) continue;
            ++unseen;
            ASSERT_EQ(sight_of(image, center + offset), Sight::unknown) << center.transpose();
        }
    }
    EXPECT_GT(unseen, 2000);
    EXPECT_TRUE(may_see(scan(room), place_of({-6.0, 0.1, 0.1}), 0.7F, margins));
}

}  // namespace line_of_sight_test
}  // namespace dynamic_filter
