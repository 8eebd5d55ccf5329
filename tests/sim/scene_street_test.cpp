// SPDX-License-Identifier: MIT
#include "sim/scene_checks.hpp"

namespace dynamic_filter::sim::scene_street_test {

TEST(SceneStreet, RobotsPathIsFree) {
    for (const std::uint64_t seed : {1U, 2U, 3U}) expect_path_free(entry("street").make(0, seed));
}

TEST(SceneStreet, VehiclesKeepClear) {
    for (const std::uint64_t seed : {1U, 2U, 3U})
        expect_traffic_free(entry("street").make(0, seed));
}

TEST(SceneStreet, PeopleAreOrderly) {
    const Scene scene = entry("street").make(entry("street").pedestrians, 1);
    expect_orderly(scene, walked(scene, scene.duration), scene.duration);
}

TEST(SceneStreet, SomethingStopsAndLeaves) {
    const Scene scene = entry("street").make(0, 1);
    std::size_t stops = 0;
    for (const Vehicle& vehicle : scene.vehicles) {
        double standing = 0.0;
        for (double t = 0.0; t < scene.duration; t += 0.1) {
            const double moved = travelled(vehicle.ride, t + 0.1) - travelled(vehicle.ride, t);
            standing += moved < 1e-6 ? 0.1 : 0.0;
        }
        const double last =
            travelled(vehicle.ride, scene.duration) - travelled(vehicle.ride, scene.duration - 1.0);
        stops += standing > 8.0 && last > 0.5;
    }
    EXPECT_EQ(stops, 1U);
}

}  // namespace dynamic_filter::sim::scene_street_test
