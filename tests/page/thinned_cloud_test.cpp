// SPDX-License-Identifier: MIT
#include "page/thinned_cloud.hpp"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>
#include <tuple>

namespace dynamic_filter::app {
namespace thinned_cloud_test {

std::vector<ShownPoint> random_points(std::size_t count) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> place(-20.0F, 20.0F);
    std::vector<ShownPoint> points(count);
    for (std::size_t i = 0; i < count; ++i) {
        points[i].position = {place(random), place(random), 0.1F * place(random)};
        points[i].scan = static_cast<std::uint32_t>(i);
        points[i].verdict = static_cast<std::uint8_t>(random() % 3);
    }
    return points;
}

ThinnedCloud thinned(const std::vector<ShownPoint>& points, std::size_t most) {
    ThinnedCloud cloud(most);
    cloud.add(points);
    return cloud;
}

TEST(ThinnedCloud, LeavesNothingOutWhileThereIsRoom) {
    const auto points = random_points(1000);
    const ThinnedCloud cloud = thinned(points, 1000);
    EXPECT_EQ(cloud.points().size(), 1000U);
    EXPECT_EQ(cloud.spacing(), 0.0F);
}

TEST(ThinnedCloud, KeepsTheFirstOfEachVerdictInACube) {
    const auto points = random_points(50'000);
    const ThinnedCloud cloud = thinned(points, 4000);
    ASSERT_GT(cloud.spacing(), 0.0F);
    EXPECT_LE(cloud.points().size(), 4000U);
    EXPECT_GT(cloud.points().size(), 1000U);
    using Place = std::tuple<int, int, int, int>;
    const auto place = [&](const ShownPoint& p) {
        const auto cell = *cell_of(p.position, 1.0F / cloud.spacing());
        return Place{cell.x(), cell.y(), cell.z(), p.verdict};
    };
    std::map<Place, std::uint32_t> kept;
    for (const ShownPoint& p : cloud.points()) {
        EXPECT_TRUE(kept.emplace(place(p), p.scan).second) << "two in a cube";
    }
    // Cubes of one size do not nest in those of the next, so a few lose all they had.
    std::set<Place> all, lost;
    for (const ShownPoint& p : points) {
        all.insert(place(p));
        if (!kept.contains(place(p))) lost.insert(place(p));
    }
    EXPECT_LT(lost.size(), all.size() / 4);
}

TEST(ThinnedCloud, IsTheSameEveryTime) {
    const auto points = random_points(20'000);
    const ThinnedCloud a = thinned(points, 3000), b = thinned(points, 3000);
    ASSERT_EQ(a.points().size(), b.points().size());
    for (std::size_t i = 0; i < a.points().size(); ++i) {
        EXPECT_EQ(a.points()[i].scan, b.points()[i].scan);
    }
}

}  // namespace thinned_cloud_test
}  // namespace dynamic_filter::app
