// SPDX-License-Identifier: MIT
#include "formats/poses/rigid.hpp"

#include "support/bytes.hpp"

namespace dynamic_filter::io {
namespace rigid_test {

Rows34 rows(const Eigen::Matrix3d& R) {
    Rows34 out;
    out << R, Eigen::Vector3d(1, 2, 3);
    return out;
}

Eigen::Matrix3d some_rotation() {
    return Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
}

std::string error(const Rows34& r) {
    const Lines lines("", "f");
    return error_of([&] { pose_from_rows(r, lines); });
}

TEST(Rigid, NearRotationsAreMadeExact) {
    const Lines lines("", "f");
    Eigen::Matrix3d R = some_rotation();
    R(0, 1) += 3e-4;
    const Pose pose = pose_from_rows(rows(R), lines);
    const Eigen::Matrix3d exact = pose.linear();
    EXPECT_LT((exact.transpose() * exact - Eigen::Matrix3d::Identity()).norm(), 1e-14);
    EXPECT_LT((exact - R).norm(), 1e-3);
    const Pose same = pose_from_rows(rows(Eigen::Matrix3d::Identity()), lines);
    EXPECT_EQ(same.linear(), Eigen::Matrix3d::Identity());
    EXPECT_EQ(same.translation(), Eigen::Vector3d(1, 2, 3));
}

TEST(Rigid, CausesAreNamed) {
    EXPECT_HAS(error(rows(2.0 * some_rotation())), "scaled by 2");
    EXPECT_HAS(error(rows(Eigen::Vector3d(1, 1, -1).asDiagonal())), "reflection");
    EXPECT_HAS(error(rows(Eigen::Matrix3d::Zero())), "not orthogonal");
    Rows34 columns;  // R and t written column by column
    const Eigen::Matrix3d R = some_rotation();
    std::copy(R.data(), R.data() + 9, columns.data());
    columns.data()[9] = columns.data()[10] = columns.data()[11] = 5.0;
    EXPECT_HAS(error(columns), "column-major");
}

TEST(Rigid, QuaternionsWithinOnePercent) {
    const Lines lines("", "f");
    const auto pose = [&](double w) {
        return pose_from_quaternion({1, 2, 3}, Eigen::Quaterniond(w, 0, 0, 0), "order wxyz", lines);
    };
    EXPECT_EQ(pose(1.001).linear(), Eigen::Matrix3d::Identity());
    for (const double w : {0.0, 0.95, 1.05, std::nan("")}) {
        EXPECT_HAS(error_of([&] { pose(w); }), "order wxyz");
    }
    EXPECT_FALSE(lost_pose().matrix().allFinite());
}

}  // namespace rigid_test
}  // namespace dynamic_filter::io
