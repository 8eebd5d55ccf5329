// SPDX-License-Identifier: MIT
#include "page/shown.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace dynamic_filter::app {
namespace shown_test {

TEST(IsShown, TakesAllOfFewAndSomeOfMany) {
    std::size_t shown = 0;
    for (std::size_t i = 0; i < 100'000; ++i) shown += is_shown(i, 100'000) ? 1 : 0;
    EXPECT_GT(shown, 200U);
    EXPECT_LE(shown, 400U);
    for (std::size_t i = 0; i < 400; ++i) EXPECT_TRUE(is_shown(i, 400));
}

/// A scan of so many points, the first tenth of which are dynamic.
struct Labelled {
    io::FullScan full;
    Labels labels;

    Labelled(std::size_t points, double at) {
        full.T_world_sensor = Pose(Eigen::Translation3d(at, 0.0, 0.0));
        full.has_pose = true;
        for (std::size_t i = 0; i < points; ++i) {
            full.points.emplace_back(1.0F + 0.1F * static_cast<float>(i % 1000),
                                     0.1F * static_cast<float>(i / 1000), 0.0F);
            labels.push_back(i < points / 10 ? Label::dynamic : Label::static_);
        }
    }
};

std::vector<std::uint64_t> no_places(const Scan& scan) {
    return std::vector<std::uint64_t>(scan.points.size(), kNoVoxelOfPage);
}

TEST(ShownScans, TakesEveryPointOfFewAndPlacesItInTheWorld) {
    ShownScans scans({0, 2}, 3, no_places);
    for (const std::size_t i : {std::size_t{0}, std::size_t{2}}) {
        const Labelled scan(1000, 5000.0 + static_cast<double>(i));
        scans.add(i, scans.draw(i, scan.full, scan.labels, {}, {}));
    }
    const Shown shown = scans.take();
    EXPECT_FALSE(shown.has_intensity);
    EXPECT_EQ(shown.frames.size(), 2000U);
    EXPECT_EQ(shown.frame_begin, (std::vector<std::uint32_t>{0, 1000, 2000}));
    EXPECT_EQ(shown.frame_of_scan, (std::vector<std::int32_t>{0, 1}));
    EXPECT_EQ(shown.map.points().size(), 2000U);
    const ShownPoint& last = shown.frames.back();
    EXPECT_EQ(last.scan, 1U);  // a row of the path
    EXPECT_NEAR(shown.origin.x() + static_cast<double>(last.position.x()), 5002.0 + 100.9, 1e-3);
}

TEST(ShownScans, TakesAFairShareOfManyAndHalfOfItDynamic) {
    const Labelled scan(1'000'000, 0.0);
    std::vector<std::size_t> all(20);
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
    const ShownScans scans(all, all.size(), no_places);
    const std::vector<double> intensity(scan.labels.size(), 7.0);
    const auto drawn = scans.draw(3, scan.full, scan.labels, scan.labels, intensity);
    const double most = static_cast<double>(kFramePoints) / 20.0;
    EXPECT_NEAR(static_cast<double>(drawn.frame.size()), most, 0.05 * most);
    const auto moves = [](const ShownPoint& p) { return (p.verdict & 3U) == 2U; };
    const auto moving = std::count_if(drawn.frame.begin(), drawn.frame.end(), moves);
    EXPECT_NEAR(static_cast<double>(moving), 0.5 * most, 0.05 * most);
    EXPECT_TRUE(drawn.has_intensity);
    EXPECT_EQ(drawn.map.front().intensity, 7.0F);
    for (const ShownPoint& p : drawn.map) EXPECT_EQ(p.verdict >> 4U & 3U, p.verdict & 3U);
}

}  // namespace shown_test
}  // namespace dynamic_filter::app
