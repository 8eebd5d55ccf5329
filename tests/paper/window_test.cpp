// SPDX-License-Identifier: MIT
#include "paper/window.hpp"

#include <gtest/gtest.h>

#include "support/random.hpp"

namespace dynamic_filter {
namespace window_test {

Scan scan_at(std::size_t index, double stamp, double x = 0.0) {
    Scan scan;
    scan.index = index;
    scan.stamp = stamp;
    scan.T_world_sensor.translation().x() = x;
    return scan;
}

std::vector<Window> cut(int keyframes, const KeyframeConfig& config,
                        const std::vector<Scan>& scans) {
    WindowCutter cutter(config, keyframes);
    std::vector<Window> windows;
    for (const Scan& scan : scans) {
        if (auto window = cutter.push(scan)) windows.push_back(std::move(*window));
    }
    if (auto window = cutter.flush()) windows.push_back(std::move(*window));
    EXPECT_FALSE(cutter.flush());
    return windows;
}

std::vector<Scan> random_drive(test::Random& random, std::size_t count) {
    std::vector<Scan> scans;
    Eigen::Vector3d at = Eigen::Vector3d::Zero();
    double stamp = 100.0;
    for (std::size_t i = 0; i < count; ++i) {
        Scan scan = scan_at(i, stamp);
        scan.T_world_sensor.translation() = at;
        scans.push_back(scan);
        stamp += random.chance(0.2) ? 0.0 : random.uniform(0.0, 0.6);
        at += random.point(0.4).cast<double>();
    }
    return scans;
}

TEST(WindowCutter, EveryScanIsInExactlyOneWindowInOrder) {
    test::Random random(1);
    for (const int n : {1, 2, 5, 1000}) {
        const auto scans = random_drive(random, 200);
        std::size_t next = 0;
        for (const Window& w : cut(n, {0.5, 0.7}, scans)) {
            ASSERT_FALSE(w.scans.empty());
            for (const Scan& s : w.scans) EXPECT_EQ(s.index, next++);
        }
        EXPECT_EQ(next, scans.size());
    }
}

TEST(WindowCutter, EveryWindowButTheLastHasItsKeyframesAndStartsWithOne) {
    test::Random random(2);
    for (const int n : {1, 2, 5}) {
        const auto windows = cut(n, {0.5, 0.7}, random_drive(random, 200));
        ASSERT_GT(windows.size(), 2U);
        for (std::size_t w = 0; w < windows.size(); ++w) {
            const auto& keyframes = windows[w].keyframes;
            const auto wanted = static_cast<std::size_t>(n);
            EXPECT_TRUE(w + 1 == windows.size() ? keyframes.size() <= wanted
                                                : keyframes.size() == wanted);
            ASSERT_FALSE(keyframes.empty());
            EXPECT_EQ(keyframes[0], 0U);
            EXPECT_LT(keyframes.back(), windows[w].scans.size());
            for (std::size_t k = 1; k < keyframes.size(); ++k)
                EXPECT_LT(keyframes[k - 1], keyframes[k]);
        }
    }
}

TEST(WindowCutter, KeyframesAreTheScansLateOrFarEnoughFromTheOneBefore) {
    test::Random random(3);
    const auto scans = random_drive(random, 300);
    std::vector<std::size_t> expected, found;
    for (const Scan& s : scans) {
        const Scan* last = expected.empty() ? nullptr : &scans[expected.back()];
        if (last == nullptr || s.stamp - last->stamp >= 0.5 ||
            (s.T_world_sensor.translation() - last->T_world_sensor.translation()).norm() >= 0.7) {
            expected.push_back(s.index);
        }
    }
    for (const Window& w : cut(4, {0.5, 0.7}, scans)) {
        for (const std::size_t k : w.keyframes) found.push_back(w.scans[k].index);
    }
    EXPECT_EQ(found, expected);
}

TEST(WindowCutter, TheIntervalIsInclusive) {
    const auto windows = cut(1, {0.5, 10.0}, {scan_at(0, 0.0), scan_at(1, 0.25), scan_at(2, 0.5)});
    ASSERT_EQ(windows.size(), 2U);
    EXPECT_EQ(windows[0].scans.size(), 2U);
}

TEST(WindowCutter, TheDistanceIsInclusive) {
    const auto windows =
        cut(1, {10.0, 0.5}, {scan_at(0, 0, 1.0), scan_at(1, 0, 0.75), scan_at(2, 0, 0.5)});
    ASSERT_EQ(windows.size(), 2U);
    EXPECT_EQ(windows[0].scans.size(), 2U);
}

TEST(WindowCutter, ScansBetweenKeyframesStayWithTheOneBefore) {
    std::vector<Scan> scans;
    for (std::size_t i = 0; i < 12; ++i) scans.push_back(scan_at(i, 0.25 * static_cast<double>(i)));
    const auto windows = cut(2, {0.5, 10.0}, scans);
    ASSERT_EQ(windows.size(), 3U);
    for (const Window& w : windows) {
        EXPECT_EQ(w.scans.size(), 4U);
        EXPECT_EQ(w.keyframes, (std::vector<std::size_t>{0, 2}));
    }
}

TEST(WindowCutter, ReturnsAWindowAsSoonAsAnotherStarts) {
    WindowCutter cutter({1.0, 10.0}, 2);
    EXPECT_FALSE(cutter.push(scan_at(0, 0.0)));
    EXPECT_FALSE(cutter.push(scan_at(1, 1.0)));
    EXPECT_FALSE(cutter.push(scan_at(2, 1.5)));  // no keyframe: still the same window
    const auto window = cutter.push(scan_at(3, 2.0));
    ASSERT_TRUE(window);
    EXPECT_EQ(window->scans.size(), 3U);
    EXPECT_EQ(cutter.flush()->scans.size(), 1U);
}

TEST(WindowCutter, WithoutScansThereIsNoWindow) { EXPECT_TRUE(cut(2, {1.0, 1.0}, {}).empty()); }

}  // namespace window_test
}  // namespace dynamic_filter
