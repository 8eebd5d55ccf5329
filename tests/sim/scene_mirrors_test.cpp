// SPDX-License-Identifier: MIT
#include "sim/scene_checks.hpp"

namespace dynamic_filter::sim::scene_mirrors_test {

TEST(SceneMirrors, RobotsPathIsFree) {
    for (const std::uint64_t seed : {1U, 2U, 3U}) expect_path_free(entry("mirrors").make(0, seed));
}

TEST(SceneMirrors, PeopleAreOrderly) {
    const Scene scene = entry("mirrors").make(entry("mirrors").pedestrians, 1);
    // A third of the people stands most of the time.
    expect_orderly(scene, walked(scene, scene.duration), scene.duration, 0.4);
}

TEST(SceneMirrors, BeamsAreOffTheBoundariesOfVoxels) {
    expect_off_boundaries(entry("mirrors").make(0, 1));
}

TEST(SceneMirrors, ReflectionsLieBehindTheMirrors) {
    SimulationOptions options;
    options.scene = "mirrors";
    options.seed = 3;
    options.rate_hz = 1.0;
    Simulation simulation(options);
    std::size_t reflections = 0, beside = 0;
    for (std::size_t i = 0; i < simulation.size(); i += 8) {
        const SimulatedScan scan = simulation.scan(i);
        for (std::size_t k = 0; k < scan.points.size(); ++k) {
            if (scan.kinds[k] != Kind::reflection) continue;
            const Eigen::Vector3d p = scan.T_world_sensor * scan.points[k].cast<double>();
            ++reflections;
            // Behind the front, the lifts or the panes of the shops, or beyond the wall in the
            // middle.
            beside += p.y() > -6.9 && p.y() < 2.3 && p.x() < 19.9;
        }
    }
    EXPECT_GT(reflections, 1000U);
    EXPECT_EQ(beside, 0U);
}

}  // namespace dynamic_filter::sim::scene_mirrors_test
