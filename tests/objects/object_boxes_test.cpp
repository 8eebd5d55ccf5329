// SPDX-License-Identifier: MIT
#include "objects/object_boxes.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <numbers>

namespace dynamic_filter::app {
namespace object_boxes_test {

constexpr double kPi = std::numbers::pi;

TEST(ObjectBoxes, LieAlongTheDirection) {
    const double yaw = 0.6;
    const Eigen::AngleAxisd turn(yaw, Eigen::Vector3d::UnitZ());
    std::vector<Eigen::Vector3d> places;
    for (const double x : {-2.0, 2.0}) {
        for (const double y : {-0.9, 0.9}) {
            places.emplace_back(Eigen::Vector3d(10, -5, 1) + turn * Eigen::Vector3d(x, y, 0.0));
        }
    }
    places.emplace_back(10, -5, 2.5);
    const ObjectBox box = box_around(places, yaw);
    EXPECT_LT((box.center - Eigen::Vector3d(10, -5, 1.75)).norm(), 1e-9);
    EXPECT_LT((box.size - Eigen::Vector3d(4.0, 1.8, 1.5)).norm(), 1e-9);
    EXPECT_EQ(box.points, 5U);
    EXPECT_EQ(box.yaw, yaw);
}

/// Two objects; the first one goes 10 m to the east in ten scans.
std::vector<ObjectBox> sample() {
    std::vector<ObjectBox> boxes;
    for (std::size_t i = 0; i <= 10; ++i) {
        const auto t = 0.5 * static_cast<double>(i);
        ObjectBox box{1, i, t, {2.0 * t, 0, 1}, {4.0, 1.8, 1.5}, 0.0, {2, 0, 0}, 100};
        boxes.push_back(box);
        if (i > 2) continue;
        boxes.push_back({7, i, t, {0, 8, 1}, {0.5, 0.5, 1.7}, kPi / 2, {0, 0, 0}, 9});
    }
    return boxes;
}

TEST(ObjectBoxes, Summaries) {
    const std::vector<ObjectBox> boxes = sample();
    const std::vector<ObjectSummary> objects = summaries_of(boxes);
    ASSERT_EQ(objects.size(), 2U);
    EXPECT_EQ(objects[0].object, 1U);
    EXPECT_EQ(objects[0].points, 1100U);
    EXPECT_NEAR(objects[0].path, 10.0, 1e-9);
    EXPECT_EQ(objects[0].size, Eigen::Vector3d(4.0, 1.8, 1.5));
    EXPECT_EQ(objects[1].object, 7U);
    EXPECT_EQ(objects[1].boxes.size(), 3U);
    EXPECT_EQ(objects_csv(objects).substr(objects_csv(objects).find('\n') + 1),
              "1,0.000,5.000,11,1100,4.00,1.80,1.50,10.00,2.00,0.000,0.000,1.000,10.000,0.000,"
              "1.000\n"
              "7,0.000,1.000,3,27,0.50,0.50,1.70,0.00,0.00,0.000,8.000,1.000,0.000,8.000,1.000\n");
}

TEST(ObjectBoxes, AsTablesAndAsJson) {
    const std::vector<ObjectBox> boxes = sample();
    std::vector<std::string> stems;
    for (int i = 0; i <= 10; ++i) stems.push_back("s" + std::to_string(i));
    const std::string table = boxes_csv(boxes, stems);
    EXPECT_NE(
        table.find("\ns2,1.000000,7,0.000,8.000,1.000,0.500,0.500,1.700,1.5708,0.000,0.000,9\n"),
        std::string::npos)
        << table;
    const auto json = nlohmann::json::parse(objects_json(summaries_of(boxes), stems));
    EXPECT_EQ(json["objects"][1]["object"], 7);
    EXPECT_EQ(json["objects"][0]["boxes"][4]["scan"], "s4");
    EXPECT_EQ(json["objects"][0]["boxes"][4]["center"][0], 4.0);
    EXPECT_NE(objects_page(summaries_of(boxes)).find("pictures/000007.png"), std::string::npos);
}

/// A sensor that looks north, 2 m above the ground: what is north is in front, what is east is on
/// the right.
TEST(ObjectBoxes, ForTheTrackingBenchmark) {
    Pose T_world_sensor = Pose(Eigen::Translation3d(0, 0, 2));
    T_world_sensor.rotate(Eigen::AngleAxisd(kPi / 2, Eigen::Vector3d::UnitZ()));
    const std::vector<ObjectBox> boxes = {
        {3, 0, 0.0, {5, 20, 0.75}, {4.0, 1.8, 1.5}, kPi / 2, {}, 10},  // drives ahead
        {4, 0, 0.0, {5, 20, 0.75}, {4.0, 1.8, 1.5}, 0.5, {}, 10}};     // to the right, and away
    EXPECT_EQ(kitti_tracking(boxes, std::vector{T_world_sensor}),
              "0 3 Misc -1 -1 -10 -1 -1 -1 -1 1.500 1.800 4.000 5.000 2.000 20.000 -1.5708\n"
              "0 4 Misc -1 -1 -10 -1 -1 -1 -1 1.500 1.800 4.000 5.000 2.000 20.000 -0.5000\n");
}

}  // namespace object_boxes_test
}  // namespace dynamic_filter::app
