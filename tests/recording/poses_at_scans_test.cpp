// SPDX-License-Identifier: MIT
#include "recording/poses_at_scans.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace dynamic_filter::io {
namespace poses_at_scans_test {

std::vector<double> every(double step, std::size_t count, double first = 0.0) {
    std::vector<double> stamps;
    for (std::size_t i = 0; i < count; ++i) stamps.push_back(first + step * static_cast<double>(i));
    return stamps;
}

/// 1 m a second along x.
Trajectory along_x(const std::vector<double>& stamps) {
    Trajectory trajectory{stamps, {}};
    for (const double stamp : stamps) {
        trajectory.poses.emplace_back(Eigen::Translation3d(stamp, 0, 0));
    }
    return trajectory;
}

PosesAtScans found(const std::vector<double>& scans, const Trajectory& published) {
    return poses_at_scans(scans, published, [&](double stamp) {
        return pose_at(published, stamp, limits_for(scans).apart);
    });
}

/// Every scan with a pose has one that was true within the limits; returns how many have one.
std::size_t count_right(const std::vector<double>& scans, const PosesAtScans& poses) {
    std::size_t with = 0;
    for (std::size_t i = 0; i < scans.size(); ++i) {
        const double x = poses.T_world_sensor[i].translation().x();
        if (!std::isfinite(x)) continue;
        ++with;
        EXPECT_NEAR(x, scans[i], limits_for(scans).nearest + 1e-9);
    }
    return with;
}

TEST(PosesAtScans, DensePosesReachEveryScan) {
    for (const double period : {0.05, 0.1, 0.5}) {
        const auto scans = every(period, 40);
        for (const double step : {0.01, 0.1, 0.2}) {
            const PosesAtScans poses = found(scans, along_x(every(step, 4000, -1.03)));
            EXPECT_EQ(count_right(scans, poses), 40U) << period << " " << step;
            EXPECT_FALSE(poses.are_sparse);
            EXPECT_EQ(poses.note, "");
        }
    }
}

TEST(PosesAtScans, SparsePosesReachOnlyTheScansNextToThem) {
    const auto scans = every(0.1, 101);
    const PosesAtScans poses = found(scans, along_x(every(1.0, 11)));
    EXPECT_EQ(count_right(scans, poses), 11U);
    EXPECT_TRUE(poses.are_sparse);
    EXPECT_EQ(poses.note,
              "poses at 1 of 10 scans: the others are placed by odometry that is tied to them");
    EXPECT_EQ(count_right(scans, found(scans, along_x(every(1.0, 11, 0.03)))), 11U);
    EXPECT_EQ(count_right(scans, found(scans, along_x(every(1.0, 10, 0.46)))), 10U);
}

TEST(PosesAtScans, ScansBeyondTheFirstAndTheLastPoseHaveNone) {
    const auto scans = every(0.1, 50);
    const PosesAtScans poses = found(scans, along_x(every(0.1, 30, 1.0)));
    EXPECT_EQ(count_right(scans, poses), 30U);
    EXPECT_FALSE(poses.are_sparse) << "odometry has nothing to tie them to on the other side";
}

TEST(PosesAtScans, AGapInThePosesIsNotBridged) {
    const auto scans = every(0.1, 60);
    std::vector<double> stamps = every(0.1, 60);
    stamps.erase(stamps.begin() + 20, stamps.begin() + 40);
    const PosesAtScans poses = found(scans, along_x(stamps));
    EXPECT_EQ(count_right(scans, poses), 40U);
    EXPECT_TRUE(poses.are_sparse);
    EXPECT_EQ(poses.note.rfind("poses at 40 of 60 scans", 0), 0U) << poses.note;
}

// The pose of the next scan is not that of this one.
TEST(PosesAtScans, APoseBelongsToTheNearestScan) {
    const auto scans = every(0.04, 20);
    std::vector<double> stamps = every(0.04, 20);
    stamps.erase(stamps.begin());
    EXPECT_EQ(count_right(scans, found(scans, along_x(stamps))), 19U);
}

TEST(PosesAtScans, WithoutAnyPoseNoScanHasOne) {
    const PosesAtScans poses = found(every(0.1, 3), {});
    EXPECT_EQ(count_right(every(0.1, 3), poses), 0U);
    EXPECT_FALSE(poses.are_sparse);
}

}  // namespace poses_at_scans_test
}  // namespace dynamic_filter::io
