// SPDX-License-Identifier: MIT
#include "sim/scene_checks.hpp"

namespace dynamic_filter::sim::scene_hall_test {

TEST(SceneHall, RobotsPathIsFree) {
    for (const std::uint64_t seed : {1U, 2U, 3U}) expect_path_free(entry("hall").make(0, seed));
}

TEST(SceneHall, PeopleAreOrderly) {
    const Scene scene = entry("hall").make(entry("hall").pedestrians, 1);
    expect_orderly(scene, walked(scene, scene.duration), scene.duration);
}

TEST(SceneHall, PeopleWalkOnBothLevelsAndStayThere) {
    const Scene scene = entry("hall").make(30, 1);
    const Crowd crowd = walked(scene, 20.0);
    std::size_t upstairs = 0;
    for (std::size_t i = 0; i < crowd.walkers; ++i) {
        const auto height = [&](double t) {
            return scene.ground(stride_at(crowd, i, t).position.cast<double>());
        };
        for (double t = 0.0; t < 20.0; t += 1.0) EXPECT_EQ(height(t), height(0.0)) << i;
        upstairs += height(0.0) > 0.0 ? 1 : 0;
    }
    EXPECT_EQ(upstairs, 10U);
}

}  // namespace dynamic_filter::sim::scene_hall_test
