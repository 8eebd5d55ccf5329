// SPDX-License-Identifier: MIT
#include "scene_checks.hpp"

using namespace dynamic_filter::sim;

TEST(SceneCrowd, TwoRoundsAtWalkingPace) {
    const Scene scene = entry("crowd").make(10, 1);
    EXPECT_GT(scene.duration, 240.0);
    EXPECT_LT(scene.duration, 290.0);
    EXPECT_EQ(scene.walkers.size(), 10U);
    EXPECT_TRUE(scene.vehicles.empty());
}

TEST(SceneCrowd, RobotsPathIsFree) {
    for (const std::uint64_t seed : {1U, 2U, 3U}) expect_path_free(entry("crowd").make(0, seed));
}

TEST(SceneCrowd, PeopleAreOrderly) {
    for (const int people : {50, 150}) {
        const Scene scene = entry("crowd").make(people, 1);
        expect_orderly(scene, walked(scene, 120.0), 120.0);
    }
}

TEST(SceneCrowd, FewStandAndTalk) {
    const Scene scene = entry("crowd").make(150, 1);
    std::size_t companies = 0;
    for (const Walker& walker : scene.walkers) companies += walker.company >= 0;
    EXPECT_GT(companies, 3U);
    EXPECT_LT(companies, 50U);
}
