// SPDX-License-Identifier: MIT
#include "geometry/pose.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "support/random.hpp"

namespace dynamic_filter {
namespace pose_test {

void expect_rotation(const Eigen::Matrix3d& r) {
    EXPECT_TRUE((r * r.transpose()).isIdentity(1e-9));
    EXPECT_NEAR(r.determinant(), 1.0, 1e-9);
}

TEST(TurnedBy, TurnsAboutFixedAxesInTurn) {
    const Eigen::Matrix3d half = turned_by({0.0, 0.0, 90.0});
    EXPECT_TRUE((half * Eigen::Vector3d::UnitX()).isApprox(Eigen::Vector3d::UnitY(), 1e-12));
    // Roll brings y to z, and yaw then turns about the world's z, which leaves it there.
    const Eigen::Matrix3d both = turned_by({90.0, 0.0, 45.0});
    EXPECT_TRUE((both * Eigen::Vector3d::UnitY()).isApprox(Eigen::Vector3d::UnitZ(), 1e-12));
}

TEST(AnglesOf, AreThoseOfTurnedBy) {
    test::Random random(8);
    for (int i = 0; i < 200; ++i) {
        const Eigen::Matrix3d r = random.pose(1.0, 3.1).linear();
        EXPECT_TRUE(turned_by(angles_of(r)).isApprox(r, 1e-9));
    }
    for (const double pitch : {90.0, -90.0}) {
        const Eigen::Matrix3d r = turned_by({20.0, pitch, 50.0});
        EXPECT_TRUE(turned_by(angles_of(r)).isApprox(r, 1e-6));
    }
}

TEST(MeanPose, OfOnePoseIsThatPose) {
    test::Random random(1);
    for (int i = 0; i < 100; ++i) {
        const Pose pose = random.pose(1000.0, 3.1);
        EXPECT_TRUE(mean_pose(std::array{pose}).isApprox(pose, 1e-9));
    }
}

TEST(MeanPose, TranslationIsTheMean) {
    test::Random random(2);
    std::vector<Pose> poses;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int i = 0; i < 17; ++i) {
        poses.push_back(random.pose(50.0, 0.3));
        sum += poses.back().translation();
    }
    EXPECT_TRUE(mean_pose(poses).translation().isApprox(sum / 17.0, 1e-12));
}

TEST(MeanPose, TurnsToBothSidesCancel) {
    test::Random random(3);
    for (int i = 0; i < 50; ++i) {
        const Pose middle = random.pose(5.0, 3.0);
        const Eigen::Vector3d axis = random.direction();
        std::vector<Pose> poses;
        for (const double angle : {-0.4, 0.4, -0.1, 0.1}) {
            poses.push_back(middle * Eigen::AngleAxisd(angle, axis));
        }
        EXPECT_TRUE(mean_pose(poses).linear().isApprox(middle.linear(), 1e-9));
    }
}

TEST(MeanPose, IsTheRotationNearestToTheSumHoweverScatteredTheyAre) {
    test::Random random(4);
    for (int i = 0; i < 200; ++i) {
        std::vector<Pose> poses;
        Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
        for (int k = 0; k < 5; ++k) {
            poses.push_back(random.pose(1.0, 3.14));
            sum += poses.back().linear();
        }
        const Eigen::Matrix3d mean = mean_pose(poses).linear();
        expect_rotation(mean);
        const double best = (mean - sum).squaredNorm();
        for (int k = 0; k < 100; ++k) {
            const Eigen::Matrix3d other = random.pose(1.0, 3.14).linear();
            EXPECT_LE(best, (other - sum).squaredNorm() + 1e-9);
        }
    }
}

TEST(MeanPose, IsARotationEvenWhenTheSumIsAReflection) {
    std::vector<Pose> poses;  // half turns about nearly orthogonal axes: the sum is nearly -I
    for (int axis = 0; axis < 3; ++axis) {
        const Eigen::Vector3d tilted =
            (Eigen::Vector3d::Unit(axis) + Eigen::Vector3d(0.01, 0.02, 0.03)).normalized();
        poses.push_back(Pose(Eigen::AngleAxisd(3.1, tilted)));
    }
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (const Pose& p : poses) sum += p.linear();
    ASSERT_LT(sum.determinant(), 0.0);
    expect_rotation(mean_pose(poses).linear());
}

TEST(NearbyOrigin, IsNearAndAWholeMultipleOfTheStep) {
    test::Random random(5);
    for (const double step : {0.05, 0.2, 0.25, 1.0}) {
        for (const double reach : {1.0, 500.0, 5e6}) {
            const Pose pose = random.pose(reach, 1.0);
            const Eigen::Vector3d origin = nearby_origin(pose, step);
            for (int axis = 0; axis < 3; ++axis) {
                EXPECT_LE(std::abs(origin[axis] - pose.translation()[axis]), 50.0 * step + 1e-6);
                const double steps = origin[axis] / step;
                EXPECT_NEAR(steps, std::round(steps), 1e-6 * std::max(1.0, std::abs(steps) * 1e-6));
            }
        }
    }
    EXPECT_TRUE(nearby_origin(Pose::Identity(), 0.2).isZero());
}

}  // namespace pose_test
}  // namespace dynamic_filter
