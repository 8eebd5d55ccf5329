// SPDX-License-Identifier: MIT
#include "navigation/survey.hpp"

#include <gtest/gtest.h>

namespace dynamic_filter::app {
namespace survey_test {

/// A sensor 1 m above a floor that is seen to 6 m, turned, far from the origin of the world.
struct Room {
    Pose T_world_sensor = Eigen::Translation3d(500000.0, 5800000.0, 101.0) *
                          Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitZ());
    Points points;
    Labels labels;

    Room() {
        for (float x = -6.0F; x < 6.0F; x += 0.05F) {
            for (float y = -6.0F; y < 6.0F; y += 0.05F) add({x, y, -1.0F}, Label::static_);
        }
        for (float z = -1.0F; z < 0.5F; z += 0.05F) {
            for (float y = -0.3F; y < 0.3F; y += 0.05F) {
                add({3.0F, y, z}, Label::dynamic);
                add({-3.0F, y, z}, Label::static_);
            }
        }
    }
    void add(const Point& point, Label label) {
        points.push_back(point);
        labels.push_back(label);
    }
    [[nodiscard]] Passage at(const Survey& survey, const NavigationMap& map, double x,
                             double y) const {
        const Eigen::Vector3d cell =
            (T_world_sensor * Eigen::Vector3d(x, y, -1.0) - survey.origin()) / survey.cell();
        const auto cx = static_cast<int>(std::floor(cell.x()));
        const auto cy = static_cast<int>(std::floor(cell.y()));
        return map.area.holds(cx, cy) ? map.cells[map.area.index(cx, cy)] : Passage::unknown;
    }
};

TEST(Survey, WhatMovesIsNoObstacleAndWhatStandsIs) {
    const Room room;
    Survey survey(0.1);
    survey.add(room.points, room.labels, room.T_world_sensor, 0.0);
    const NavigationMap map = survey.map(Robot{}, 0);
    EXPECT_NEAR(map.floor.sensor_height, 1.0F, 0.06F);
    EXPECT_EQ(room.at(survey, map, 3.0, 0.0), Passage::free);
    EXPECT_EQ(room.at(survey, map, -3.0, 0.0), Passage::occupied);
    EXPECT_EQ(room.at(survey, map, 0.0, 3.0), Passage::free);
    EXPECT_EQ(room.at(survey, map, 0.0, 9.0), Passage::unknown);
}

TEST(Survey, GroundIsNearTheFloorThatIsReached) {
    const Room room;
    Survey survey(0.1);
    survey.add_surfaces(room.points, room.labels, room.T_world_sensor);
    const Ground ground = survey.ground({.height = 1.0F, .step = 0.3F});
    const auto is_ground = [&](double x, double y, double z) {
        return ground.is_near(room.T_world_sensor * Eigen::Vector3d(x, y, z), 0.1);
    };
    EXPECT_TRUE(is_ground(3.0, 2.0, -1.05));
    EXPECT_FALSE(is_ground(3.0, 2.0, -0.85)) << "above it";
    EXPECT_FALSE(is_ground(-3.05, 0.0, -0.5)) << "what stands";
    EXPECT_FALSE(is_ground(9.0, 0.0, -1.0)) << "not seen";
}

TEST(Survey, ThePlaceOfTheWorldDoesNotMatter) {
    Room far, near;
    near.T_world_sensor =
        Eigen::Translation3d(-far.T_world_sensor.translation()) * far.T_world_sensor;
    std::vector<std::vector<Passage>> maps;
    for (const Room* room : {&far, &near}) {
        Survey survey(0.1);
        survey.add(room->points, room->labels, room->T_world_sensor, 0.0);
        maps.push_back(survey.map(Robot{}, 0).cells);
    }
    EXPECT_EQ(maps[0], maps[1]);
}

TEST(Survey, PointsWithoutAMeasurementCountForNothing) {
    Room room;
    Survey survey(0.1), with_more(0.1);
    survey.add(room.points, room.labels, room.T_world_sensor, 0.0);
    room.add({0, 0, 0}, Label::static_);
    room.add({NAN, 0, 0}, Label::static_);
    with_more.add(room.points, room.labels, room.T_world_sensor, 0.0);
    EXPECT_EQ(survey.map(Robot{}, 0).cells, with_more.map(Robot{}, 0).cells);
}

}  // namespace survey_test
}  // namespace dynamic_filter::app
