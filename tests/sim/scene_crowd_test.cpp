// SPDX-License-Identifier: MIT
#include "sim/scene_checks.hpp"

namespace dynamic_filter::sim::scene_crowd_test {

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

TEST(SceneCrowd, BodiesHideBodies) {
    for (const auto& [people, least] : {std::pair(150, 0.5), std::pair(250, 0.65)}) {
        const Scene scene = entry("crowd").make(people, 1);
        const Crowd crowd = walked(scene, 60.0);
        expect_orderly(scene, crowd, 60.0);
        std::size_t hidden = 0, all = 0;
        for (double t = 0.0; t < 60.0; t += 1.0) {
            const auto robot = at(scene.robot.path, travelled(scene.robot, t)).position;
            for (std::size_t i = 0; i < crowd.walkers; ++i) {
                const Eigen::Vector2d to = stride_at(crowd, i, t).position.cast<double>() - robot;
                if (to.norm() > 30.0) continue;
                ++all;
                for (std::size_t j = 0; j < crowd.walkers; ++j) {  // a torso covers the middle of i
                    const Eigen::Vector2d p =
                        stride_at(crowd, j, t).position.cast<double>() - robot;
                    const double along = p.dot(to) / to.norm();
                    if (j == i || along < 0.0 || along > to.norm() - 0.3) continue;
                    if ((p - along * to.normalized()).norm() > 0.2) continue;
                    ++hidden;
                    break;
                }
            }
        }
        const double share = static_cast<double>(hidden) / static_cast<double>(all);
        EXPECT_GT(share, least) << people;
    }
}

TEST(SceneCrowd, FewStandAndTalk) {
    const Scene scene = entry("crowd").make(150, 1);
    std::size_t companies = 0;
    for (const Walker& walker : scene.walkers) companies += walker.company >= 0;
    EXPECT_GT(companies, 3U);
    EXPECT_LT(companies, 50U);
}

}  // namespace dynamic_filter::sim::scene_crowd_test
