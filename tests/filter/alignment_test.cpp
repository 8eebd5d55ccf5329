// SPDX-License-Identifier: MIT
#include "filter/alignment.hpp"

#include <gtest/gtest.h>

#include "support/filled_map.hpp"

namespace dynamic_filter {
namespace alignment_test {

const test::Box kRoom{{-8.0, -6.0, -1.6}, {9.0, 7.0, 4.0}};
constexpr float kGain = 0.15F;

Pose at(double x, double y, double z, double yaw = 0.0) {
    Pose pose = Pose::Identity();
    pose.linear() = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    pose.translation() = Eigen::Vector3d(x, y, z);
    return pose;
}

Scan seen_from(const Pose& pose) {
    return test::scan_room(pose, kRoom, {}, {.rings = 32, .columns = 360}).scan;
}

Keyframe keyframe_of(const Scan& scan) {
    Keyframes keyframes(test::every_scan());
    keyframes.add(scan);
    return keyframes.kept().back();
}

/// How far apart points of the first and the second motion are, at most, near the sensor.
double apart(const Pose& a, const Eigen::Isometry3f& b, const Eigen::Vector3d& sensor) {
    double most = 0.0;
    for (const Eigen::Vector3d& p : {Eigen::Vector3d(5, 0, 0), Eigen::Vector3d(0, 5, -1),
                                     Eigen::Vector3d(-5, 2, 1), Eigen::Vector3d(0, 0, 0)}) {
        const Eigen::Vector3d q = sensor + p;
        most = std::max(most, (a * q - b.cast<double>() * q).norm());
    }
    return most;
}

TEST(Alignment, FindsByHowMuchAPoseIsOff) {
    const Keyframe keyframe = keyframe_of(seen_from(at(0, 0, 0)));
    for (const Pose& error :
         {at(0, 0, 0.3), at(0.2, -0.15, 0.1), at(0, 0, 0, 0.02), at(-0.1, 0.2, -0.2, -0.015)}) {
        const Pose truth = at(1.2, 0.4, 0.1, 0.3);
        Scan scan = seen_from(truth);
        scan.T_world_sensor = error * truth;
        const auto motion = alignment_to(keyframe, alignment_sample(scan), kGain);
        ASSERT_TRUE(motion);
        EXPECT_LT(apart(error.inverse(), *motion, truth.translation()), 0.03)
            << error.translation().transpose();
    }
}

TEST(Alignment, LeavesGoodPosesExactlyAsTheyAre) {
    const Keyframe keyframe = keyframe_of(seen_from(at(0, 0, 0)));
    for (const Pose& pose : {at(0.5, 0, 0), at(2.0, -1.0, 0.2, 0.5), at(-3.0, 0.0, 0.0, -1.0)}) {
        const auto motion = alignment_to(keyframe, alignment_sample(seen_from(pose)), kGain);
        ASSERT_TRUE(motion);
        EXPECT_EQ(motion->matrix(), Eigen::Matrix4f::Identity());
    }
}

TEST(Alignment, IsUnknownWhereScansShareTooLittle) {
    const Keyframe keyframe = keyframe_of(seen_from(at(0, 0, 0)));
    Scan elsewhere = seen_from(at(0, 0, 0));
    elsewhere.T_world_sensor = at(60.0, 0, 0);
    EXPECT_FALSE(alignment_to(keyframe, alignment_sample(elsewhere), kGain));
    EXPECT_FALSE(alignment_to(keyframe, {}, kGain));
}

TEST(Alignment, TakesAnEvenSampleOfWhatWasMeasuredAtMediumRange) {
    Scan scan = seen_from(at(0, 0, 0));
    scan.points.emplace_back(0.5F, 0.0F, 0.0F);
    scan.points.emplace_back(100.0F, 0.0F, 0.0F);
    scan.points.emplace_back(0.0F, 0.0F, 0.0F);
    scan.points.emplace_back(std::nanf(""), 0.0F, 0.0F);
    const Points sample = alignment_sample(scan);
    EXPECT_GE(sample.size(), 400U);
    EXPECT_LT(sample.size(), 800U);
    for (const Point& p : sample) {
        EXPECT_GT(p.norm(), 2.0F);
        EXPECT_LT(p.norm(), 30.0F);
    }
}

/// Share of the voxels that a scan saw free, of a sensor whose pose rises by 3 cm a scan.
double share_free(double gain) {
    Config config = test::every_scan();
    config.scans.sight.alignment_gain = gain;
    std::vector<test::RoomScan> scans;
    for (int i = 0; i < 12; ++i) {
        const Pose truth = at(0.2 * i, 0, 0);
        scans.push_back(test::scan_room(truth, kRoom, {}, {.rings = 32, .columns = 360}));
        scans.back().scan.T_world_sensor = at(0, 0, 0.03 * i) * truth;
        scans.back().scan.stamp = i;
        scans.back().scan.index = static_cast<std::size_t>(i);
    }
    const EvidenceMap map = test::filled(scans, config);
    std::size_t free = 0;
    for (std::uint32_t v = 0; v < map.grid().size(); ++v) {
        free += map.grid()[v].evidence.n_free > 0 ? 1U : 0U;
    }
    return static_cast<double>(free) / map.grid().size();
}

TEST(Alignment, KeepsTheGroundOfADriveWhosePosesRise) {
    EXPECT_GT(share_free(1.0), 0.1);
    EXPECT_LT(share_free(0.15), 0.01);
}

}  // namespace alignment_test
}  // namespace dynamic_filter
