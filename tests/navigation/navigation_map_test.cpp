// SPDX-License-Identifier: MIT
#include "navigation/navigation_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "dynamic_filter/error.hpp"

namespace dynamic_filter::app {
namespace navigation_map_test {

constexpr float kCell = 0.1F;
constexpr float kSensor = 1.0F;  // [m] above the floor

/// Points every 2 cm on a surface z(x, y), where z is a number.
void add_surface(Columns& columns, float x0, float y0, float x1, float y1,
                 const std::function<float(float, float)>& z) {
    for (float x = x0; x < x1; x += 0.04F) {
        for (float y = y0; y < y1; y += 0.04F) columns.add({x, y, z(x, y)});
    }
}
void add_wall(Columns& columns, float x, float y0, float y1, float low, float high) {
    for (float y = y0; y < y1; y += 0.04F) {
        for (float z = low; z < high; z += 0.04F) columns.add({x, y, z});
    }
}
Points path_along_x(float x0, float x1, const std::function<float(float)>& floor) {
    Points path;
    for (float x = x0; x <= x1; x += 0.1F) path.emplace_back(x, 0.0F, floor(x) + kSensor);
    return path;
}
float flat(float, float) { return 0.0F; }

/// Beams from places of the path to the ground all around.
std::vector<Look> looks_from(const Points& path) {
    std::vector<Look> looks;
    for (std::size_t i = 0; i < path.size(); i += 10) {
        Look look{path[i], {}};
        for (float angle = 0.0F; angle < 6.28F; angle += 0.01F) {
            for (float distance = 0.5F; distance < 9.0F; distance += 0.5F) {
                look.ends.push_back(path[i] + Point(distance * std::cos(angle),
                                                    distance * std::sin(angle), -kSensor));
            }
        }
        looks.push_back(look);
    }
    return looks;
}

struct Seen {
    NavigationMap map;
    Passage operator()(float x, float y) const {
        const auto cx = static_cast<int>(std::floor(x / kCell));
        const auto cy = static_cast<int>(std::floor(y / kCell));
        return map.area.holds(cx, cy) ? map.cells[map.area.index(cx, cy)] : Passage::unknown;
    }
};
Seen seen(const Columns& columns, const Points& path, const std::vector<Look>& looks,
          int storey = 0) {
    return {navigation_map(columns, path, looks, Robot{}, storey)};
}
Seen seen(const Columns& columns, const Points& path, int storey = 0) {
    return seen(columns, path, looks_from(path), storey);
}

TEST(NavigationMap, FloorIsFreeWallsAreOccupiedAndBehindThemIsUnknown) {
    Columns columns(kCell);
    add_surface(columns, -5, -5, 5, 5, flat);
    add_wall(columns, 3.05F, -5, 5, 0.0F, 2.5F);
    const Seen at = seen(columns, path_along_x(-2, 2, [](float) { return 0.0F; }));
    EXPECT_NEAR(at.map.floor.sensor_height, kSensor, 0.05F);
    EXPECT_EQ(at(0.05F, 2.05F), Passage::free);
    EXPECT_EQ(at(3.05F, 1.05F), Passage::occupied);
    EXPECT_EQ(at(4.05F, 1.05F), Passage::unknown) << "the robot cannot get there";
    EXPECT_EQ(at(20.0F, 0.0F), Passage::unknown);
}

TEST(NavigationMap, ARampIsFreeAndAKerbIsNot) {
    const auto height = [](float x, float y) {
        if (y > 2.0F) return 0.15F;          // a pavement
        return x > 0.0F ? 0.12F * x : 0.0F;  // a ramp
    };
    Columns columns(kCell);
    add_surface(columns, -5, -2, 6, 4, height);
    const Points path = path_along_x(-3, 4, [&](float x) { return height(x, 0.0F); });
    const Seen at = seen(columns, path);
    EXPECT_EQ(at(4.05F, 1.05F), Passage::free);
    EXPECT_EQ(at(-3.05F, 2.05F), Passage::occupied);
    EXPECT_EQ(at(-3.05F, 1.75F), Passage::free);
}

TEST(NavigationMap, BothSidesOfAKerbAreFreeWhereARampLeadsUp) {
    const auto height = [](float x, float y) {
        const float rise = std::clamp(0.1F * x, 0.0F, 0.3F);  // from x = 0 to 3
        return y > 2.0F ? 0.3F : y > 1.0F ? rise : 0.0F;
    };
    Columns columns(kCell);
    add_surface(columns, -3, -2, 6, 4, height);
    const Seen at = seen(columns, path_along_x(-2, 0, [](float) { return 0.0F; }));
    EXPECT_EQ(at(-1.05F, 3.05F), Passage::free) << "reached by the ramp";
    EXPECT_EQ(at(-1.05F, 0.05F), Passage::free);
    EXPECT_EQ(at(-1.05F, 2.05F), Passage::occupied) << "the edge between them";
}

TEST(NavigationMap, WhatHangsHigherThanTheRobotIsNoObstacle) {
    Columns columns(kCell);
    add_surface(columns, -5, -5, 5, 5, flat);
    add_surface(columns, 1, 1, 2, 2, [](float, float) { return 2.0F; });
    add_surface(columns, 3, 1, 4, 2, [](float, float) { return 0.75F; });  // a table
    const Seen at = seen(columns, path_along_x(-2, 0, [](float) { return 0.0F; }));
    EXPECT_EQ(at(1.55F, 1.55F), Passage::free);
    EXPECT_EQ(at(3.55F, 1.55F), Passage::occupied);
}

TEST(NavigationMap, ALedgeIsOccupied) {
    Columns columns(kCell);
    add_surface(columns, -5, -5, 5, 2, flat);
    add_surface(columns, -5, 2, 5, 5, [](float, float) { return -1.0F; });  // the track
    const Seen at = seen(columns, path_along_x(-2, 2, [](float) { return 0.0F; }));
    EXPECT_EQ(at(0.05F, 1.55F), Passage::free);
    EXPECT_EQ(at(0.05F, 2.15F), Passage::occupied);
}

/// The floor is not seen between y = 1 and 1.5, but beams to (0.05, `far`) pass above it.
Passage in_gap(float far, float height_at_end) {
    Columns columns(kCell);
    add_surface(columns, -5, -2, 5, 1, flat);
    add_surface(columns, -5, 1.5F, 5, 3, flat);
    const Points path = path_along_x(-2, 2, [](float) { return 0.0F; });
    Look look{{0, 0, kSensor}, {}};
    for (const float end : {far, 4.0F})
        look.ends.insert(look.ends.end(), 2, {0.05F, end, height_at_end});
    return seen(columns, path, {look})(0.05F, 1.25F);
}

TEST(NavigationMap, BeamsFillGapsBetweenRings) {
    EXPECT_EQ(in_gap(1.6F, 0.0F), Passage::free) << "0.2 m above the floor";
    EXPECT_EQ(in_gap(1.1F, 0.0F), Passage::unknown) << "they end before";
    EXPECT_EQ(in_gap(1.6F, 0.9F), Passage::unknown) << "they pass too high to prove anything";
}

TEST(NavigationMap, FloorBelowACarIsUnknown) {
    Columns columns(kCell);
    add_surface(columns, -5, -5, 5, 5, flat);
    const Points path = path_along_x(-2, 2, [](float) { return 0.0F; });
    Look look{{0, 0, kSensor}, {}};
    for (float x = -1.0F; x < 1.0F; x += 0.02F)
        look.ends.insert(look.ends.end(), 2, {x, 4.9F, 0.01F});
    const Seen at = seen(columns, path, {look});
    EXPECT_EQ(at(0.05F, 2.05F), Passage::free);
    EXPECT_EQ(at(0.05F, 4.35F), Passage::unknown) << "beams pass 0.1 m above the floor";
    EXPECT_EQ(at(-1.95F, 0.05F), Passage::free) << "the robot drove there";
}

TEST(NavigationMap, AThinWallIsNotBridged) {
    Columns columns(kCell);
    add_surface(columns, -3, -3, 3, 3, flat);
    add_wall(columns, 1.05F, -3, 3, 0.0F, 2.0F);
    const Seen at = seen(columns, path_along_x(-2, 0, [](float) { return 0.0F; }));
    EXPECT_EQ(at(1.65F, 0.05F), Passage::unknown);
}

TEST(NavigationMap, StoreysAreChosen) {
    Columns columns(kCell);
    add_surface(columns, -5, -5, 5, 5, flat);
    add_surface(columns, -5, -5, 5, 5, [](float, float) { return 4.0F; });
    add_wall(columns, 2.05F, -5, 5, 4.1F, 5.0F);
    Points path = path_along_x(-2, 2, [](float) { return 0.0F; });
    const Points upper = path_along_x(-2, 2, [](float) { return 4.0F; });
    path.insert(path.end(), upper.begin(), upper.end());
    const NavigationMap both = navigation_map(columns, path, {}, Robot{}, 0);
    EXPECT_GT(both.floor.overlapping, 5000U);
    ASSERT_EQ(both.floor.storeys.size(), 2U);
    EXPECT_EQ(seen(columns, path, 1)(2.05F, 0.05F), Passage::free);
    EXPECT_EQ(seen(columns, path, 2)(2.05F, 0.05F), Passage::occupied);
    EXPECT_THROW(seen(columns, path, 3), ConfigError);
}

TEST(NavigationMap, WhereTheRobotDroveIsFree) {
    Columns columns(kCell);
    add_surface(columns, 2, -5, 9, 5, flat);  // the sensor sees no floor near where it begins
    const Seen at = seen(columns, path_along_x(-2, 3, [](float) { return 0.0F; }));
    EXPECT_EQ(at(2.0F, 0.0F), Passage::free);
}

TEST(NavigationMap, NothingIsFreeWithoutAFloorBelowTheSensor) {
    Columns columns(kCell);
    add_surface(columns, -5, -5, 5, 5, [](float, float) { return -6.0F; });
    const Seen at = seen(columns, path_along_x(-2, 2, [](float) { return 0.0F; }));
    EXPECT_EQ(std::count(at.map.cells.begin(), at.map.cells.end(), Passage::free), 0);
}

TEST(NavigationMap, TheHeightOfTheSensorIsThatAboveAFlatFloor) {
    for (const float height : {-0.049F, 0.0F, 0.02F, 0.049F}) {
        Columns columns(kCell);
        add_surface(columns, -5, -5, 5, 5, [&](float, float) { return height; });
        const Seen at = seen(columns, path_along_x(-2, 2, [](float) { return 0.0F; }));
        EXPECT_NEAR(at.map.floor.sensor_height, kSensor - height, 0.002F);
    }
}

TEST(NavigationMap, ASinglePointIsNotFilledUp) {
    Columns columns(kCell);
    add_surface(columns, -5, -2, 5, 1, flat);
    add_surface(columns, -5, 1.5F, 5, 3, flat);
    columns.add({0.05F, 1.25F, 0.5F});  // a thin post
    Look look{{0, 0, kSensor}, {}};
    for (const float end : {1.6F, 4.0F}) look.ends.insert(look.ends.end(), 2, {0.05F, end, 0.0F});
    const Points path = path_along_x(-2, 2, [](float) { return 0.0F; });
    EXPECT_NE(seen(columns, path, {look})(0.05F, 1.25F), Passage::free);
}

TEST(NavigationMap, TooManyCellsAreRefused) {
    Columns columns(0.01F);
    columns.add({0, 0, 0});
    columns.add({5000, 5000, 0});
    EXPECT_THROW(navigation_map(columns, {{0, 0, 1}}, {}, Robot{}, 0), ConfigError);
}

TEST(NavigationMap, NothingIsFreeWithoutPoints) {
    EXPECT_TRUE(navigation_map(Columns(kCell), {{0, 0, 1}}, {}, Robot{}, 0).cells.empty());
}

}  // namespace navigation_map_test
}  // namespace dynamic_filter::app
