// SPDX-License-Identifier: MIT
#include "recording/scan_overlay.hpp"

#include <gtest/gtest.h>

#include "dynamic_filter/error.hpp"
#include "formats/poses/rigid.hpp"
#include "support/pillars.hpp"

namespace dynamic_filter::io {
namespace scan_overlay_test {

Pose true_pose(std::size_t i) { return on_a_curve(static_cast<double>(i)); }

TEST(ScanOverlay, ScansOverlayAtTheRightPosesOnly) {
    const ScanOverlay overlay(40, [](std::size_t i) { return pillars_seen_from(true_pose(i)); });
    EXPECT_GT(overlay.share(true_pose), 0.8);
    EXPECT_LT(overlay.share([](std::size_t i) { return on_a_curve(1.3 * double(i)); }), 0.3);
    EXPECT_LT(overlay.share(true_pose, true), 0.3);
    EXPECT_EQ(overlay.share([](std::size_t) { return lost_pose(); }), 0.0);
}

TEST(ScanOverlay, PointsInTheWorldOverlayAsSuch) {
    const ScanOverlay overlay(40,
                              [](std::size_t i) { return pillars_seen_from(true_pose(i), true); });
    EXPECT_GT(overlay.share(true_pose, true), 0.8);
    EXPECT_LT(overlay.share(true_pose, false), 0.3);
}

TEST(ScanOverlay, ScansThatCannotBeReadAreLeftOut) {
    const ScanOverlay overlay(40, [](std::size_t i) {
        if (i % 3 == 1) throw InputError("a.bag", "", "is damaged");
        return pillars_seen_from(true_pose(i));
    });
    for (const std::size_t i : overlay.scans()) EXPECT_NE(i % 3, 1U);
    EXPECT_GT(overlay.share(true_pose), 0.8);
    EXPECT_TRUE(ScanOverlay(1, [](std::size_t) { return Cloud{}; }).scans().empty());
}

}  // namespace scan_overlay_test
}  // namespace dynamic_filter::io
