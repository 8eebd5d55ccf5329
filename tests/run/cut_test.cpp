// SPDX-License-Identifier: MIT
#include "run/cut.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "support/random.hpp"

namespace dynamic_filter::app {
namespace cut_test {

constexpr double kEdge = 12.8;

io::FullScan some_scan() {
    test::Random random(5);
    io::FullScan full;
    full.T_world_sensor = Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitZ());
    full.T_world_sensor.translation() = Eigen::Vector3d(30.0, -20.0, 1.0);
    for (int i = 0; i < 20000; ++i) {
        const auto at = [&] { return static_cast<float>(random.below(20000)) / 100.0F - 100.0F; };
        full.points.emplace_back(at(), at(), at());
        full.truth.push_back(i % 3 == 0 ? Label::dynamic : Label::static_);
    }
    full.points[7].x() = std::numeric_limits<float>::quiet_NaN();
    full.points[8] = Point::Zero();
    full.points[9].y() = 1e30F;
    return full;
}

TEST(Cut, HoldsThePointsInAndAroundTheTileInOrder) {
    const io::FullScan full = some_scan();
    const Tile tile{.level = 1, .x = 0, .y = -1};
    const Cut cut = cut_of(full, tile, kEdge);
    std::size_t next = 0;
    each_measured(full, [&](std::size_t i, const Eigen::Vector3d& world) {
        const PlaneCell cell = cell_at(world, kEdge);
        const bool is_around = cell.x >= -1 && cell.x <= 4 && cell.y >= -5 && cell.y <= 0;
        if (!is_around) return;
        ASSERT_LT(next, cut.indices.size());
        EXPECT_EQ(cut.indices[next], i);
        EXPECT_EQ(cut.inside[next], tile_at(cell, 1) == tile);
        EXPECT_EQ(cut.points[next], full.points[i]);
        EXPECT_EQ(cut.truth[next], full.truth[i]);
        ++next;
    });
    EXPECT_EQ(next, cut.indices.size());
    EXPECT_GT(next, 100U);
}

TEST(Cut, OfTheOnlyTileIsAllThatWasMeasured) {
    const io::FullScan full = some_scan();
    const Cut cut = cut_of(full, {.is_whole = true}, kEdge);
    EXPECT_EQ(cut.points.size(), full.points.size() - 3);
    EXPECT_EQ(labels_of(cut, full.truth), cut.truth);
}

TEST(Cut, OutsideOfTheTileNothingIsScored) {
    const io::FullScan full = some_scan();
    const Cut cut = cut_of(full, {.level = 0, .x = 1, .y = -1}, kEdge);
    const auto scan = labelled_inside(cut, full.T_world_sensor, {10.0, 0.0, 0.0});
    for (std::size_t i = 0; i < scan.points.size(); ++i) {
        EXPECT_EQ(scan.truth[i], cut.inside[i] ? cut.truth[i] : Label::unknown);
        const Eigen::Vector3d world = full.T_world_sensor * cut.points[i].cast<double>();
        EXPECT_NEAR(world.x() - 10.0, scan.points[i].x(), 1e-4);
        EXPECT_NEAR(world.y(), scan.points[i].y(), 1e-4);
    }
}

}  // namespace cut_test
}  // namespace dynamic_filter::app
