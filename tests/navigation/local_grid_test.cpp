// SPDX-License-Identifier: MIT
#include "navigation/local_grid.hpp"

#include <gtest/gtest.h>

namespace dynamic_filter::app {
namespace local_grid_test {

constexpr double kAway = 5000.0;  // [m] of the robot from the world's origin

/// A floor 1 m below the sensor to 6 m around it, with a pillar 3 m in front of the world's place
/// (kAway, 0).
Scan scan_at(double x, double t, bool has_floor = true) {
    Scan scan{{}, Pose(Eigen::Translation3d(kAway + x, 0.0, 1.0)), t, 0, true, {}};
    scan.index = static_cast<std::size_t>(10.0 * t);
    if (has_floor) {
        for (float px = -6.0F; px < 6.0F; px += 0.05F) {
            for (float py = -6.0F; py < 6.0F; py += 0.05F) scan.points.emplace_back(px, py, -1.0F);
        }
    }
    for (float z = -0.9F; z < 0.8F; z += 0.05F) {
        for (float y = -0.2F; y < 0.2F; y += 0.05F) {
            scan.points.emplace_back(static_cast<float>(3.0 - x), y, z);
        }
    }
    return scan;
}

/// Everything stands, but what is higher than the floor if `pillar` says so.
LocalGrid::Judge judge(Label pillar) {
    return [pillar](const Scan& scan) {
        Verdict verdict;
        for (const Point& p : scan.points) {
            verdict.labels.push_back(p.z() > -0.95F ? pillar : Label::static_);
        }
        return verdict;
    };
}

int at(const io::OccupancyCells& cells, double x, double y) {
    const auto cx = static_cast<std::size_t>((kAway + x - cells.origin.x()) / cells.cell);
    const auto cy = static_cast<std::size_t>((y - cells.origin.y()) / cells.cell);
    return cells.values.at(cy * cells.width + cx);
}

TEST(LocalGrid, KnowsWhatIsFreeAndWhatIsNot) {
    LocalGrid grid({.radius = 10.0});
    for (int i = 0; i < 10; ++i) grid.add(scan_at(0.1 * i, 0.5 * i));
    const auto cells = grid.cells(judge(Label::static_));
    ASSERT_TRUE(cells.has_value());
    EXPECT_EQ(cells->width, 200U);
    EXPECT_EQ(cells->values.size(), 200U * 200U);
    EXPECT_NEAR(cells->origin.x() + 10.0, kAway + 0.9, 0.11);
    EXPECT_NEAR(cells->origin.z(), 0.0, 0.1);
    EXPECT_EQ(at(*cells, 3.05, 0.05), 100);
    EXPECT_EQ(at(*cells, 0.05, 3.05), 0);
    EXPECT_EQ(at(*cells, -4.05, -3.05), 0);
    EXPECT_EQ(at(*cells, 0.05, 8.05), -1) << "nobody looked";
}

TEST(LocalGrid, ForgetsWhatTheFilterForgets) {
    LocalGrid grid({.radius = 10.0});
    for (int i = 0; i < 10; ++i) grid.add(scan_at(0.0, 0.5 * i));
    EXPECT_EQ(at(*grid.cells(judge(Label::static_)), 3.05, 0.05), 100);
    EXPECT_EQ(at(*grid.cells(judge(Label::dynamic)), 3.05, 0.05), 0);
}

/// A table: points that lie flat, one above the other in no column.
TEST(LocalGrid, SeesWhatIsThin) {
    LocalGrid grid({.radius = 10.0});
    for (int i = 0; i < 10; ++i) {
        Scan scan = scan_at(0.0, 0.5 * i);
        for (float x = 1.0F; x < 2.0F; x += 0.05F) {
            for (float y = 2.0F; y < 3.0F; y += 0.05F) scan.points.emplace_back(x, y, -0.25F);
        }
        grid.add(scan);
    }
    const auto cells = grid.cells(judge(Label::static_));
    for (double x = 1.15; x < 1.9; x += 0.1) EXPECT_EQ(at(*cells, x, 2.55), 100) << x;
}

TEST(LocalGrid, GoesWithTheRobot) {
    LocalGrid grid({.radius = 5.0});
    for (int i = 0; i < 40; ++i) grid.add(scan_at(0.5 * i, 0.5 * i));
    const auto cells = grid.cells(judge(Label::static_));
    ASSERT_TRUE(cells.has_value());
    EXPECT_NEAR(cells->origin.x() + 5.0, kAway + 19.5, 0.11);
    EXPECT_EQ(at(*cells, 19.55, 2.05), 0);
}

TEST(LocalGrid, IsNothingWithoutAFloorAndAfterABreak) {
    LocalGrid grid({.radius = 5.0});
    EXPECT_FALSE(grid.cells(judge(Label::static_)).has_value());
    grid.add(scan_at(0.0, 0.0, false));
    EXPECT_FALSE(grid.cells(judge(Label::unknown)).has_value());
    grid.add(scan_at(0.0, 1.0));
    EXPECT_TRUE(grid.cells(judge(Label::static_)).has_value());
    grid.begin_world(11);
    grid.add(scan_at(0.0, 1.0));
    EXPECT_FALSE(grid.cells(judge(Label::static_)).has_value());
}

}  // namespace local_grid_test
}  // namespace dynamic_filter::app
