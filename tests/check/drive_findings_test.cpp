// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "dynamic_filter/check.hpp"

namespace dynamic_filter::io {
namespace drive_findings_test {

class DriveFindings : public testing::Test {
protected:
    DriveFindings() {
        for (const char* name : {"city/monday", "city/tuesday/", "city/friday", "other/monday"}) {
            drives_.push_back(drive(name));
        }
    }
    static Recording drive(const char* root) {
        Info info;
        info.root = root;
        return Recording(info);
    }
    /// Findings about the first `count` drives.
    std::vector<Finding> of(std::size_t count, const std::vector<DriveOffset>& offsets) {
        std::vector<const Recording*> all;
        for (std::size_t i = 0; i < count; ++i) all.push_back(&drives_[i]);
        return findings_of(all, offsets);
    }
    static DriveOffset pair(std::size_t a, std::size_t b, FrameMatch match, double gap = 1.0) {
        DriveOffset offset;
        offset.a = a;
        offset.b = b;
        offset.match = match;
        offset.gap = gap;
        offset.places = offset.fitting = offset.agreeing = 8;
        return offset;
    }
    static DriveOffset shifted(std::size_t a, std::size_t b, const Eigen::Vector3d& shift,
                               double yaw_deg = 0.0) {
        DriveOffset offset = pair(a, b, FrameMatch::shifted);
        offset.shift = shift;
        offset.yaw_deg = yaw_deg;
        offset.pivot = {10.0, 20.0, 0.0};
        return offset;
    }
    std::vector<Recording> drives_;
};

bool says(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

TEST_F(DriveFindings, EqualFramesAreNoFinding) {
    EXPECT_TRUE(of(2, {pair(0, 1, FrameMatch::equal)}).empty());
    EXPECT_TRUE(of(2, {pair(0, 1, FrameMatch::not_known)}).empty());
    EXPECT_TRUE(of(1, {}).empty());
    EXPECT_TRUE(of(0, {}).empty());
}

TEST_F(DriveFindings, AShiftIsNamedInMetres) {
    const auto findings = of(2, {shifted(0, 1, {0.3, -0.0001, 0.0})});
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_TRUE(says(findings[0].what,
                     "the world frames of monday and tuesday differ: tuesday shows things "
                     "(0.30, 0.00, 0.00) m from where monday shows them; this holds at 8 of 8"))
        << findings[0].what;
    EXPECT_TRUE(says(findings[0].advice,
                     "add (-0.30, 0.00, 0.00) m to the positions of the poses of tuesday"))
        << findings[0].advice;
}

TEST_F(DriveFindings, ATurnIsNamedInDegreesAndWithItsCentre) {
    const auto findings = of(2, {shifted(0, 1, {1.0, 0.0, 0.0}, 1.5)});
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_TRUE(
        says(findings[0].what, "turned by 1.50 deg about the vertical through (10.0, 20.0)"))
        << findings[0].what;
    EXPECT_TRUE(says(findings[0].advice, "and then turn them by -1.50 deg about"));
    EXPECT_FALSE(says(of(2, {shifted(0, 1, {1.0, 0.0, 0.0}, 0.1)})[0].what, "turned"));
}

TEST_F(DriveFindings, AHeightHasCausesOfItsOwn) {
    EXPECT_TRUE(says(of(2, {shifted(0, 1, {0.0, 0.0, 47.3})})[0].advice, "ellipsoid"));
    EXPECT_TRUE(says(of(2, {shifted(0, 1, {0.0, 0.0, 0.4})})[0].advice, "mounting height"));
}

TEST_F(DriveFindings, TheDriveWithWhichFewerAgreeIsOff) {
    // monday is off; tuesday and friday agree.
    const auto findings = of(3, {shifted(0, 1, {-1.5, 2.0, 0.0}), shifted(0, 2, {-1.5, 2.0, 0.0}),
                                 pair(1, 2, FrameMatch::equal)});
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_TRUE(says(findings[0].what, "monday shows things (1.50, -2.00, 0.00) m from"))
        << findings[0].what;
    EXPECT_TRUE(says(findings[0].advice, "add (-1.50, 2.00, 0.00) m")) << findings[0].advice;
    EXPECT_TRUE(says(findings[0].advice, "poses of monday"));
}

TEST_F(DriveFindings, TurningRoundKeepsTheOffset) {
    // R(90 deg) p + (2, 0) is undone by R(-90 deg) p - R(-90 deg) (2, 0) = R(-90 deg) p + (0, 2).
    const auto findings = of(3, {shifted(0, 1, {2.0, 0.0, 0.0}, 90.0),
                                 pair(0, 2, FrameMatch::not_known), pair(1, 2, FrameMatch::equal)});
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_TRUE(says(findings[0].what, "monday shows things (0.00, 2.00, 0.00) m"))
        << findings[0].what;
    EXPECT_TRUE(says(findings[0].what, "turned by -90.00 deg"));
}

TEST_F(DriveFindings, WhatFollowsFromOthersIsNotRepeated) {
    const auto findings = of(3, {shifted(0, 1, {1.0, 0.0, 0.0}), shifted(0, 2, {3.0, 0.0, 0.0}),
                                 shifted(1, 2, {2.0, 0.0, 0.0})});
    ASSERT_EQ(findings.size(), 2U);
    EXPECT_TRUE(says(findings[0].advice, "poses of tuesday"));
    EXPECT_TRUE(says(findings[1].advice, "poses of friday"));
    // Both drives of the smaller group are to be moved.
    drives_.push_back(drive("city/sunday"));
    const auto groups = of(5, {pair(0, 1, FrameMatch::equal), pair(0, 2, FrameMatch::equal),
                               pair(3, 4, FrameMatch::equal), shifted(0, 3, {1.0, 0.0, 0.0}),
                               shifted(1, 4, {1.0, 0.0, 0.0})});
    ASSERT_EQ(groups.size(), 1U);
    EXPECT_TRUE(says(groups[0].advice, "other/monday and sunday")) << groups[0].advice;
}

TEST_F(DriveFindings, DriftAndOtherSurroundingsAreToldApart) {
    DriveOffset drift = pair(0, 1, FrameMatch::drifting);
    drift.least = 0.1;
    drift.most = 0.55;
    drift.spread = 0.4;
    auto findings = of(2, {drift});
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_TRUE(says(findings[0].what, "off by 0.10 to 0.55 m")) << findings[0].what;
    EXPECT_TRUE(says(findings[0].advice, "at least one drive drift"));
    findings = of(2, {pair(0, 1, FrameMatch::unlike)});
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_TRUE(says(findings[0].what, "different surroundings"));
    findings = of(2, {pair(0, 1, FrameMatch::same_poses)});
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_TRUE(says(findings[0].what, "given twice"));
}

TEST_F(DriveFindings, DrivesThatMeetNoneAreReportedIfNoneMeetOrFarAway) {
    auto findings = of(2, {pair(0, 1, FrameMatch::apart, 4e5)});
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_TRUE(says(findings[0].what, "they are 400.0 km apart at their nearest"))
        << findings[0].what;
    EXPECT_TRUE(says(findings[0].advice, "UTM"));
    findings = of(2, {pair(0, 1, FrameMatch::apart, 350.0)});
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_TRUE(says(findings[0].what, "350 m apart"));
    // Another quarter of the city, as long as two drives meet.
    EXPECT_TRUE(of(3, {pair(0, 1, FrameMatch::equal), pair(0, 2, FrameMatch::apart, 3000.0),
                       pair(1, 2, FrameMatch::apart, 2000.0)})
                    .empty());
    findings = of(3, {pair(0, 1, FrameMatch::equal), pair(0, 2, FrameMatch::apart, 4e5),
                      pair(1, 2, FrameMatch::apart, 3.9e5)});
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_TRUE(says(findings[0].what, "tuesday and friday")) << findings[0].what;
}

TEST_F(DriveFindings, DrivesWithoutPosesAreNamed) {
    for (const std::size_t i : {0, 3}) drives_[i] = without_poses(drives_[i]);
    const auto findings = of(4, {pair(1, 2, FrameMatch::equal)});
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_TRUE(says(findings[0].what, "city/monday, other/monday have no poses"))
        << findings[0].what;
}

}  // namespace drive_findings_test
}  // namespace dynamic_filter::io
