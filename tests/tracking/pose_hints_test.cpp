// SPDX-License-Identifier: MIT
#include "tracking/pose_hints.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace dynamic_filter {
namespace pose_hints_test {

using MaybePoses = std::vector<std::optional<Pose>>;

/// Straight on, 1 m from scan to scan.
MaybePoses straight(std::size_t count) {
    MaybePoses poses;
    for (std::size_t i = 0; i < count; ++i) {
        poses.emplace_back(Pose(Eigen::Translation3d(static_cast<double>(i), 0.0, 0.0)));
    }
    return poses;
}

double deviation(const PoseHint& hint, Eigen::Index axis) {
    return 1.0 / std::sqrt(hint.information(axis, axis));
}

TEST(PoseHints, AreTenMetresApartAndLieOnExactPoses) {
    const MaybePoses poses = straight(101);
    const auto hints = hints_of(poses, poses);
    ASSERT_EQ(hints.size(), 11U);
    for (const PoseHint& hint : hints) {
        EXPECT_TRUE(hint.T_world_sensor.isApprox(*poses[hint.scan], 1e-9));
        EXPECT_NEAR(deviation(hint, 0), 0.02, 1e-9);
    }
}

TEST(PoseHints, HeightsThatWanderAreAllowedToDeviate) {
    MaybePoses given = straight(301);
    for (std::size_t i = 0; i < given.size(); ++i) {
        given[i]->translation().z() = 2.0 * std::sin(static_cast<double>(i) / 30.0);
    }
    const PoseHint hint = hints_of(given, straight(301)).front();
    EXPECT_GT(deviation(hint, 2), 1.0);
    EXPECT_NEAR(deviation(hint, 1), 0.02, 1e-9);
}

TEST(PoseHints, AnOutlierDoesNotMoveTheMiddle) {
    MaybePoses given = straight(101);
    given[50]->translation().y() += 3.0;
    for (const PoseHint& hint : hints_of(given, straight(101))) {
        EXPECT_LT(std::abs(hint.T_world_sensor.translation().y()), 1e-9) << hint.scan;
    }
}

TEST(PoseHints, OnlyScansThatBothKnowHaveHints) {
    MaybePoses given(101);
    EXPECT_TRUE(hints_of(given, straight(101)).empty());
    for (const std::size_t i : {std::size_t{0}, std::size_t{40}, std::size_t{80}}) {
        given[i] = straight(101)[i];
    }
    MaybePoses shown = straight(101);
    shown[40] = std::nullopt;
    const auto hints = hints_of(given, shown);
    ASSERT_EQ(hints.size(), 2U);
    EXPECT_EQ(hints[1].scan, 80U);
}

}  // namespace pose_hints_test
}  // namespace dynamic_filter
