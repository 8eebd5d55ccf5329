// SPDX-License-Identifier: MIT
#include "check/choose_poses.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "support/street_recording.hpp"

namespace dynamic_filter::io {
namespace choose_poses_test {

class ChoosePoses : public StreetRecording {
protected:
    [[nodiscard]] std::string doubt() const {
        MotionLook look(open(), {}, "off");
        return doubt_about_poses(look);
    }
};

/// [m] of the motion from the first scan to the last one.
double error_of_ends(const TrackedScans& tracked) {
    const auto& truth = street(false).truth;
    const Pose expected = truth.front().inverse() * truth.back();
    const Pose found = tracked.front()->T_world_sensor.inverse() * tracked.back()->T_world_sensor;
    return (expected.inverse() * found).translation().norm();
}

TEST_F(ChoosePoses, ExactOnesAreKept) {
    put(street(false), street(false).truth);
    EXPECT_EQ(doubt(), "");
    const PosesChoice choice = choose_poses(open(), {}, false, {});
    EXPECT_TRUE(choice.tracked.empty());
    ASSERT_EQ(choice.notes.size(), 1U);
    EXPECT_HAS(choice.notes.front(), "the given ones are used");
    EXPECT_FALSE(choose_poses(open(), {}, true, {}).tracked.empty());
}

TEST_F(ChoosePoses, ThoseThatDriftAreReplaced) {
    auto poses = street(false).truth;
    for (std::size_t i = 0; i < poses.size(); ++i) {
        poses[i].translation().z() += 0.05 * static_cast<double>(i);
    }
    put(street(false), poses);
    EXPECT_NE(doubt(), "");
    const PosesChoice choice = choose_poses(open(), {}, false, {});
    ASSERT_FALSE(choice.tracked.empty());
    EXPECT_LT(error_of_ends(choice.tracked), 0.3);  // the given ones are off by 1.45 m
}

TEST_F(ChoosePoses, OneThatLiesApartIsReplaced) {
    auto poses = street(false).truth;
    poses[11].translation().y() += 4.0;
    put(street(false), poses);
    EXPECT_HAS(doubt(), number(11));
    const PosesChoice choice = choose_poses(open(), {}, false, {});
    ASSERT_FALSE(choice.tracked.empty());
    const Eigen::Vector3d there = choice.tracked[11]->T_world_sensor.translation();
    EXPECT_LT((there - street(false).truth[11].translation()).norm(), 0.1);
    EXPECT_HAS(choice.notes.front(), "the mended ones are used");
    for (std::size_t i = 0; i < poses.size(); ++i) {
        if (i == 11) continue;
        EXPECT_TRUE(choice.tracked[i]->T_world_sensor.isApprox(poses[i], 1e-9)) << i;
    }
}

}  // namespace choose_poses_test
}  // namespace dynamic_filter::io
