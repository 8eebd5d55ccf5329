// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <set>

#include "sim/scene.hpp"

namespace dynamic_filter::sim::scenes_test {

TEST(Scenes, NamesAreUniqueAndAllCanBeMade) {
    std::set<std::string> names;
    for (const SceneEntry& entry : scene_table()) {
        EXPECT_TRUE(names.insert(entry.name).second);
        const Scene scene = entry.make(7, 5);
        EXPECT_EQ(static_cast<bool>(scene.around), static_cast<bool>(entry.make_trip));
        if (scene.around) {  // it is made where the robot is
            EXPECT_GT(scene.duration * entry.rate_hz, 200.0) << entry.name;
            EXPECT_FALSE(scene.around(0.0, 50.0).parts.empty());
            continue;
        }
        EXPECT_EQ(scene.walkers.size(), 7U) << entry.name;
        EXPECT_GT(scene.duration * entry.rate_hz, 200.0) << entry.name;
        EXPECT_FALSE(scene.still.triangles.empty());
    }
    EXPECT_TRUE(names.contains("crowd"));
    EXPECT_TRUE(names.contains("street"));
    EXPECT_TRUE(names.contains("square"));
    EXPECT_TRUE(names.contains("hall"));
    EXPECT_TRUE(names.contains("jam"));
    EXPECT_TRUE(names.contains("queue"));
    EXPECT_TRUE(names.contains("platform"));
    EXPECT_TRUE(names.contains("slow"));
    EXPECT_TRUE(names.contains("mirrors"));
    EXPECT_TRUE(names.contains("city"));
}

TEST(Scenes, SeedsGiveOtherPeople) {
    for (const SceneEntry& entry : scene_table()) {
        if (entry.make_trip) continue;
        EXPECT_NE(entry.make(5, 1).walkers[0].start, entry.make(5, 2).walkers[0].start);
        EXPECT_EQ(entry.make(5, 1).walkers[0].start, entry.make(5, 1).walkers[0].start);
    }
}

}  // namespace dynamic_filter::sim::scenes_test
