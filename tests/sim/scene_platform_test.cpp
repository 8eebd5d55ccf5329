// SPDX-License-Identifier: MIT
#include <cmath>

#include "sim/platform.hpp"
#include "sim/scene_checks.hpp"

namespace dynamic_filter::sim::scene_platform_test {

using Eigen::Vector2d;

namespace {

Scene platform_of(std::uint64_t seed) {
    return entry("platform").make(entry("platform").pedestrians, seed);
}

bool train_moves(const Scene& scene, double t) {
    const Ride& ride = scene.vehicles[1].ride;
    return travelled(ride, t + 0.05) - travelled(ride, t - 0.05) > 1e-6;
}

}  // namespace

TEST(ScenePlatform, TheTrainComesStandsAndLeaves) {
    for (const std::uint64_t seed : {1U, 2U, 3U, 4U, 5U}) {
        const Scene scene = platform_of(seed);
        ASSERT_EQ(scene.vehicles.size(), 3U);
        double standing = 0.0;
        for (double t = 0.0; t < scene.duration; t += 0.1)
            standing += train_moves(scene, t) ? 0.0 : 0.1;
        EXPECT_GE(standing, 30.0) << seed;
        EXPECT_LE(standing, 40.5) << seed;
        for (const double t : {0.0, scene.duration}) {
            const Ride& ride = scene.vehicles[1].ride;
            EXPECT_GT(at(ride.path, travelled(ride, t)).position.norm(), 200.0);
        }
        EXPECT_GT(scene.duration, 180.0);
        EXPECT_LT(scene.duration, 240.0);
    }
}

TEST(ScenePlatform, PeopleGetOffAndOnWhileTheDoorsAreOpen) {
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
        const Scene scene = platform_of(seed);
        const Crowd crowd = walked(scene, scene.duration);
        int on = 0, off = 0;
        for (std::size_t i = 0; i < crowd.walkers; ++i) {
            double before = static_cast<double>(stride_at(crowd, i, 0.0).position.y());
            for (double t = 0.1; t < scene.duration; t += 0.1) {
                const double y = static_cast<double>(stride_at(crowd, i, t).position.y());
                on += before < platform::aboard && y >= platform::aboard;
                off += before >= platform::aboard && y < platform::aboard;
                if (std::abs(y - platform::half_width - 0.06) < 0.2) {
                    EXPECT_GT(door_opening(scene.vehicles[0].ride, t), 0.9)
                        << seed << ": " << i << " at " << t << " s";
                }
                before = y;
            }
        }
        EXPECT_GE(on, 15) << seed;
        EXPECT_GE(off, 12) << seed;
    }
}

TEST(ScenePlatform, EverybodyMovesAndManyStandForMinutes) {
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
        const Scene scene = platform_of(seed);
        const Crowd crowd = walked(scene, scene.duration);
        expect_orderly(scene, crowd, scene.duration, 0.1);
        std::size_t minutes = 0;
        for (std::size_t i = 0; i < crowd.walkers; ++i) {
            double longest = 0.0, since = 0.0, far = 0.0;
            const Vector2d start = stride_at(crowd, i, 0.0).position.cast<double>();
            for (double t = 0.0; t < scene.duration; t += 0.25) {
                const Stride stride = stride_at(crowd, i, t);
                if (stride.speed > 0.2F) since = t;
                longest = std::max(longest, t - since);
                far = std::max(far, (stride.position.cast<double>() - start).norm());
            }
            EXPECT_GT(far, 1.5) << seed << " " << i;
            const bool visible =
                std::abs(start.x()) < platform::half_length && start.y() < platform::half_width;
            minutes += visible && longest > 60.0;
        }
        EXPECT_GT(minutes, 25U) << seed;
    }
}

TEST(ScenePlatform, PassengersAreCarriedWithTheTrain) {
    const Scene scene = platform_of(1);
    const Vector2d inside(1.0, platform::train_y), outside(1.0, 3.5);
    const Ride& middle = scene.vehicles[1].ride;
    EXPECT_LT(scene.carried(inside, 0.0).x(), -200.0);
    EXPECT_NEAR(scene.carried(inside, halts_at(middle) + 5.0).norm(), 0.0, 1e-9);
    EXPECT_GT(scene.carried(inside, scene.duration).x(), 200.0);
    for (double t = 0.0; t < scene.duration; t += 1.0) {
        EXPECT_EQ(scene.carried(outside, t), Vector2d(0.0, 0.0));
        const double x = at(middle.path, travelled(middle, t)).position.x();
        EXPECT_NEAR((inside + scene.carried(inside, t)).x() - x, 1.0, 1e-6);
    }
}

TEST(ScenePlatform, SomeHaveLuggageSomeAreInGroups) {
    const Scene scene = platform_of(1);
    std::size_t luggage = 0, companies = 0;
    for (const Walker& walker : scene.walkers) {
        luggage += walker.luggage;
        companies += walker.company >= 0;
    }
    EXPECT_GT(luggage, 15U);
    EXPECT_GT(companies, 8U);
}

TEST(ScenePlatform, RobotsPathIsFree) {
    for (const std::uint64_t seed : {1U, 2U, 3U}) expect_path_free(platform_of(seed));
}

TEST(ScenePlatform, SensorIsOnNoBoundaryOfVoxels) { expect_off_boundaries(platform_of(1)); }

}  // namespace dynamic_filter::sim::scene_platform_test
