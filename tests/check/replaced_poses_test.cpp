// SPDX-License-Identifier: MIT
#include "check/replaced_poses.hpp"

#include <gtest/gtest.h>

#include "support/random.hpp"
#include "support/street_recording.hpp"

namespace dynamic_filter::io {
namespace replaced_poses_test {

class ReplacedPoses : public StreetRecording {
protected:
    /// What is said of these given poses after the true ones replaced them.
    [[nodiscard]] std::vector<Finding> mistakes(const std::vector<Pose>& given) const {
        put(street(false), given);
        std::vector<std::optional<Tracked>> tracked;
        for (const Pose& pose : street(false).truth) tracked.push_back(Tracked{pose});
        return mistakes_in_replaced(open(), with_poses(open(), tracked));
    }
};

TEST_F(ReplacedPoses, AUnitIsNamedIfTheFoundPosesConfirmIt) {
    for (const auto& [unit, advice] : {std::pair{1.0 / 0.3048, "--pose-fix feet"},
                                       {1000.0, "--pose-fix mm"},
                                       {0.3048, "--point-unit feet"}}) {
        std::vector<Pose> poses = street(false).truth;
        for (Pose& pose : poses) pose.translation() *= unit;
        const auto found = mistakes(poses);
        ASSERT_EQ(found.size(), 1U) << advice;
        EXPECT_EQ(found[0].advice, advice);
        EXPECT_EQ(is_of_points(found[0]), unit == 0.3048);
    }
}

TEST_F(ReplacedPoses, MotionsFromScanToScanAreNamed) {
    std::vector<Pose> poses = street(false).truth;
    for (std::size_t i = poses.size() - 1; i > 0; --i) poses[i] = poses[i - 1].inverse() * poses[i];
    const auto found = mistakes(poses);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].advice, "--pose-fix relative");
}

TEST_F(ReplacedPoses, OfNoisyOnesNothingIsSaid) {
    std::vector<Pose> poses = street(false).truth;
    test::Random random(1);
    for (Pose& pose : poses) pose = pose * random.pose(0.5, 0.05);
    EXPECT_TRUE(mistakes(poses).empty());
}

}  // namespace replaced_poses_test
}  // namespace dynamic_filter::io
