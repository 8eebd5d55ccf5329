// SPDX-License-Identifier: MIT
#include <algorithm>

#include "sim/scene_checks.hpp"

namespace dynamic_filter::sim::scene_slow_test {

using Eigen::Vector2d;

namespace {

Scene slow_of(std::uint64_t seed) { return entry("slow").make(entry("slow").pedestrians, seed); }

}  // namespace

TEST(SceneSlow, AllThatMovesIsSlow) {
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
        const Scene scene = slow_of(seed);
        ASSERT_EQ(scene.vehicles.size(), 6U);
        for (const Vehicle& vehicle : scene.vehicles) {
            const double speed = travelled(vehicle.ride, 11.0) - travelled(vehicle.ride, 10.0);
            EXPECT_GT(speed, 0.04) << seed;
            EXPECT_LT(speed, 0.35) << seed;
        }
        const Crowd crowd = walked(scene, 30.0);
        for (std::size_t i = 0; i < scene.walkers.size(); ++i) {
            const Vector2d way =
                (stride_at(crowd, i, 30.0).position - stride_at(crowd, i, 0.0).position)
                    .cast<double>();
            EXPECT_GT(way.norm(), 0.5 * 30.0 * scene.walkers[i].speed) << seed << " " << i;
            EXPECT_LT(way.norm(), 1.2 * 30.0 * scene.walkers[i].speed) << seed << " " << i;
        }
    }
}

TEST(SceneSlow, TrafficIsFree) {
    for (const std::uint64_t seed : {1U, 2U, 3U, 4U, 5U}) expect_traffic_free(slow_of(seed));
}

TEST(SceneSlow, RobotsPathIsFree) {
    for (const std::uint64_t seed : {1U, 2U, 3U}) expect_path_free(slow_of(seed));
}

TEST(SceneSlow, SensorIsOnNoBoundaryOfVoxels) { expect_off_boundaries(slow_of(1)); }

}  // namespace dynamic_filter::sim::scene_slow_test
