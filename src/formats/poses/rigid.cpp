// SPDX-License-Identifier: MIT
#include "formats/poses/rigid.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace dynamic_filter::io {
namespace {

constexpr double orthogonal_tolerance = 1e-3;
constexpr double quaternion_tolerance = 1e-2;

/// Largest deviation of R^T R from the identity.
double skewness(const Eigen::Matrix3d& R) {
    return (R.transpose() * R - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
}

/// True if the 12 numbers are a rigid motion when they are read column by column.
bool is_column_major(const Rows34& rows) {
    const Eigen::Map<const Eigen::Matrix3d> columns(rows.data());
    return skewness(columns) < orthogonal_tolerance;
}

bool is_scaled(const Eigen::Matrix3d& R, double& scale) {
    scale = R.col(0).norm();
    return scale > 0 && skewness(R / scale) < orthogonal_tolerance;
}

[[noreturn]] void explain_skew(const Rows34& rows, const Lines& where) {
    const Eigen::Matrix3d R = rows.leftCols<3>();
    double scale = 0.0;
    std::string cause = "the left 3x3 block of each row-major 3x4 matrix must be a rotation";
    if (is_scaled(R, scale)) {
        cause = fmt::format("it is a rotation scaled by {:.6g}; remove the scale", scale);
    } else if (is_column_major(rows)) {
        cause = "the matrix is transposed (column-major); write it row by row";
    }
    where.fail(fmt::format("the rotation is not orthogonal (off by {:.3g}, allowed {}): {}",
                           skewness(R), orthogonal_tolerance, cause));
}

/// The nearest rotation, by Newton's iteration. An exact rotation is not changed.
Eigen::Matrix3d made_exact(Eigen::Matrix3d R) {
    for (int step = 0; step < 3; ++step) {
        R = R * (1.5 * Eigen::Matrix3d::Identity() - 0.5 * R.transpose() * R);
    }
    return R;
}

}  // namespace

Pose pose_from_quaternion(const Eigen::Vector3d& translation, const Eigen::Quaterniond& rotation,
                          const std::string& order, const Lines& where) {
    const double norm = rotation.norm();
    if (!(std::abs(norm - 1.0) <= quaternion_tolerance)) {
        where.fail(
            fmt::format("the quaternion has length {:.6g}, expected 1: the order of the "
                        "columns is {}; check that it is not another one",
                        norm, order));
    }
    Pose pose = Pose::Identity();
    pose.linear() = rotation.normalized().toRotationMatrix();
    pose.translation() = translation;
    return pose;
}

Pose pose_from_rows(const Rows34& rows, const Lines& where) {
    const Eigen::Matrix3d R = rows.leftCols<3>();
    if (!(skewness(R) <= orthogonal_tolerance)) explain_skew(rows, where);
    if (R.determinant() < 0) {
        where.fail(
            "the rotation is a reflection (determinant -1): one axis is flipped; use a "
            "right-handed frame");
    }
    Pose pose = Pose::Identity();
    pose.linear() = made_exact(R);
    pose.translation() = rows.col(3);
    return pose;
}

Pose lost_pose() {
    Pose pose = Pose::Identity();
    pose.matrix().topRows<3>().setConstant(std::numeric_limits<double>::quiet_NaN());
    return pose;
}

}  // namespace dynamic_filter::io
