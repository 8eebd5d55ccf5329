// SPDX-License-Identifier: MIT
#include "run/map_files.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "dynamic_filter/error.hpp"
#include "support/temporary_folder.hpp"

namespace dynamic_filter::app {
namespace map_files_test {

/// x y z in the given type and a ring per point; points (i, 0, 0).
template <class T>
io::FullScan scan_of(io::FieldType type, std::size_t points) {
    io::FullScan scan;
    for (const char* axis : {"x", "y", "z"}) io::add_field(scan.cloud, axis, type);
    io::add_field(scan.cloud, "ring", io::FieldType::u16);
    for (std::size_t i = 0; i < points; ++i) {
        const T xyz[3] = {static_cast<T>(i + 1), 0, 0};
        const auto ring = static_cast<std::uint16_t>(100 + i);
        const auto* bytes = reinterpret_cast<const std::byte*>(xyz);
        scan.cloud.data.insert(scan.cloud.data.end(), bytes, bytes + sizeof xyz);
        bytes = reinterpret_cast<const std::byte*>(&ring);
        scan.cloud.data.insert(scan.cloud.data.end(), bytes, bytes + sizeof ring);
        scan.points.emplace_back(static_cast<float>(i + 1), 0.0F, 0.0F);
    }
    scan.T_world_sensor.translation() = Eigen::Vector3d(10, 20, 30);
    scan.T_world_sensor.linear() = Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitZ()).matrix();
    return scan;
}

Verdict with(Labels labels) { return {.labels = std::move(labels), .probability = {}}; }

template <class T>
void expect_split(io::FieldType type) {
    const test::TemporaryFolder folder;
    MapFiles maps(folder.path(), MapConfig{}, false);
    maps.append(scan_of<T>(type, 4),
                with({Label::static_, Label::dynamic, Label::unknown, Label::static_}));
    maps.commit();
    const io::Cloud still = io::read_cloud(folder / "static_map.pcd");
    const io::Cloud dynamic = io::read_cloud(folder / "dynamic_points.pcd");
    ASSERT_EQ(still.size(), 3U);
    ASSERT_EQ(dynamic.size(), 1U);
    EXPECT_EQ(io::values(still, *still.find("ring")), (std::vector<double>{100, 102, 103}));
    EXPECT_EQ(io::values(dynamic, *dynamic.find("ring")), (std::vector<double>{101}));
    EXPECT_NEAR((io::positions(still)[2] - Point(10, 24, 30)).norm(), 0, 1e-5);
    EXPECT_EQ(still.find("x")->type, type);
}

TEST(MapFiles, KeepOriginalPointsWithAllFieldsInTheWorldFrame) {
    expect_split<float>(io::FieldType::f32);
    expect_split<double>(io::FieldType::f64);
}

TEST(MapFiles, LeaveOutUnknownIfAskedAndPointsThatAreNotFinite) {
    const test::TemporaryFolder folder;
    MapFiles maps(folder.path(), MapConfig{.keep_unknown = false}, false);
    io::FullScan scan = scan_of<float>(io::FieldType::f32, 3);
    scan.points[0].x() = std::numeric_limits<float>::quiet_NaN();
    maps.append(scan, with({Label::static_, Label::unknown, Label::static_}));
    scan.points[2].setZero();
    maps.append(scan, with({Label::static_, Label::unknown, Label::static_}));
    maps.commit();
    EXPECT_EQ(io::read_cloud(folder / "static_map.pcd").size(), 1U);
    EXPECT_EQ(io::read_cloud(folder / "dynamic_points.pcd").size(), 0U);
}

TEST(MapFiles, WhatStaysBelongsToTheStaticMap) {
    const test::TemporaryFolder folder;
    MapFiles maps(folder.path(), MapConfig{}, false);
    Verdict verdict = with({Label::static_, Label::dynamic, Label::dynamic});
    verdict.stays = {false, true, false};
    maps.append(scan_of<float>(io::FieldType::f32, 3), verdict);
    maps.commit();
    const io::Cloud still = io::read_cloud(folder / "static_map.pcd");
    EXPECT_EQ(io::values(still, *still.find("ring")), (std::vector<double>{100, 101}));
    EXPECT_EQ(io::read_cloud(folder / "dynamic_points.pcd").size(), 1U);
}

TEST(MapFiles, FarFromTheOriginCoordinatesAreDoubles) {
    const test::TemporaryFolder folder;
    MapFiles maps(folder.path(), MapConfig{}, false);
    io::FullScan scan = scan_of<float>(io::FieldType::f32, 2);
    scan.T_world_sensor.translation() = Eigen::Vector3d(5e5, 5e6 + 0.125, 30);
    maps.append(scan, with({Label::static_, Label::static_}));
    maps.commit();
    const io::Cloud still = io::read_cloud(folder / "static_map.pcd");
    EXPECT_NEAR(io::values(still, *still.find("y"))[1], 5e6 + 2.125, 1e-6);
    EXPECT_EQ(io::values(still, *still.find("ring")), (std::vector<double>{100, 101}));
}

TEST(MapFiles, RecordsInTheWorldFrameArePassedOnUnchanged) {
    const test::TemporaryFolder folder;
    MapFiles maps(folder.path(), MapConfig{}, true);
    const io::FullScan scan = scan_of<float>(io::FieldType::f32, 3);
    maps.append(scan, with(Labels(3, Label::static_)));
    maps.commit();
    EXPECT_EQ(io::read_cloud(folder / "static_map.pcd").data, scan.cloud.data);
}

TEST(MapFiles, HaveTheProbabilityOfEachPointIfAsked) {
    const test::TemporaryFolder folder;
    io::FullScan scan = scan_of<float>(io::FieldType::f32, 3);
    for (const bool in_world : {false, true}) {
        MapFiles maps(folder.path(), MapConfig{.probability = true}, in_world);
        Verdict verdict = with({Label::static_, Label::dynamic, Label::static_});
        verdict.probability = {0.75F, 0.25F, 1.0F};
        maps.append(scan, verdict);
        maps.commit();
        const io::Cloud still = io::read_cloud(folder / "static_map.pcd");
        const io::Cloud dynamic = io::read_cloud(folder / "dynamic_points.pcd");
        EXPECT_EQ(io::values(still, *still.find("probability")), (std::vector<double>{0.75, 1.0}));
        EXPECT_EQ(io::values(dynamic, *dynamic.find("probability")), (std::vector<double>{0.25}));
        EXPECT_EQ(io::values(still, *still.find("ring")), (std::vector<double>{100, 102}));
        EXPECT_EQ(
            io::positions(still)[1],
            in_world ? Point(3, 0, 0) : Point(scan.T_world_sensor.cast<float>() * Point(3, 0, 0)));
    }
    scan.cloud.data.clear();
    io::add_field(scan.cloud, "probability", io::FieldType::f32);
    MapFiles maps(folder.path(), MapConfig{.probability = true}, false);
    EXPECT_THROW(maps.begin(scan), ConfigError);
}

TEST(MapFiles, LeaveNothingWithoutCommit) {
    const test::TemporaryFolder folder;
    {
        MapFiles maps(folder.path(), MapConfig{}, false);
        maps.append(scan_of<float>(io::FieldType::f32, 1), with({Label::static_}));
    }
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace map_files_test
}  // namespace dynamic_filter::app
