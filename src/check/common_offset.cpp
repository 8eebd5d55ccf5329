// SPDX-License-Identifier: MIT
#include "check/common_offset.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace dynamic_filter::io {
namespace {

// [m] The shift that is one standard deviation if a place is known as well as it can be.
constexpr double kDeviation = 0.03;
constexpr double kAgree = 0.1;     // [m]
constexpr double kMajority = 0.7;  // share of the places that counts as most of them
constexpr double kWidest = 10.0, kNarrowest = 0.15, kShrink = 0.7;  // [m] scale of the kernel
constexpr int kIterations = 20;

Eigen::Matrix3d about_vertical(double yaw) {
    return Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

/// What is left of the correction of a place: x, y, z, yaw.
Eigen::Vector4d residual(const PlaceOffset& place, const CommonOffset& common) {
    const Eigen::Vector3d arm = place.at - common.pivot;
    const Eigen::Vector3d expected = common.shift + about_vertical(common.yaw) * arm - arm;
    Eigen::Vector4d left;
    left << place.shift - expected, place.yaw - common.yaw;
    return left;
}

double size_of(const Eigen::Vector4d& residual, const PlaceOffset& place) {
    return kDeviation * std::sqrt(residual.dot(place.information * residual));
}

void note_differences(std::span<const PlaceOffset> places, CommonOffset& common) {
    common.differences.clear();
    for (const PlaceOffset& place : places) {
        common.differences.push_back(size_of(residual(place, common), place));
    }
}

/// One step of Gauss and Newton. The derivative of a turn moves a place across its arm.
void improve(std::span<const PlaceOffset> places, double scale, CommonOffset& common) {
    Eigen::Matrix4d H = 1e-9 * Eigen::Matrix4d::Identity();
    Eigen::Vector4d b = Eigen::Vector4d::Zero();
    for (const PlaceOffset& place : places) {
        const Eigen::Vector4d left = residual(place, common);
        const double size = size_of(left, place);
        const double share = scale * scale / (scale * scale + size * size);
        const Eigen::Vector3d arm = about_vertical(common.yaw) * (place.at - common.pivot);
        Eigen::Matrix4d J = Eigen::Matrix4d::Identity();
        J.topRightCorner<3, 1>() = Eigen::Vector3d::UnitZ().cross(arm);
        const Eigen::Matrix4d weight = share * share * place.information;
        H += J.transpose() * weight * J;
        b += J.transpose() * weight * left;
    }
    const Eigen::Vector4d step = H.ldlt().solve(b);
    common.shift += step.head<3>();
    common.yaw += step[3];
}

Eigen::Vector3d middle_of(std::span<const PlaceOffset> places) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const PlaceOffset& place : places) sum += place.at;
    return places.empty() ? sum : Eigen::Vector3d(sum / static_cast<double>(places.size()));
}

}  // namespace

std::size_t CommonOffset::agreeing() const {
    return static_cast<std::size_t>(
        std::count_if(differences.begin(), differences.end(), [](double d) { return d < kAgree; }));
}

bool CommonOffset::is_agreed() const {
    return static_cast<double>(agreeing()) >= kMajority * static_cast<double>(differences.size());
}

CommonOffset no_offset(std::span<const PlaceOffset> places) {
    CommonOffset none;
    none.pivot = middle_of(places);
    note_differences(places, none);
    return none;
}

CommonOffset fit_common(std::span<const PlaceOffset> places) {
    CommonOffset common;
    common.pivot = middle_of(places);
    double scale = kWidest;
    for (int i = 0; i < kIterations; ++i) {
        improve(places, scale, common);
        scale = std::max(kNarrowest, kShrink * scale);
    }
    note_differences(places, common);
    return common;
}

}  // namespace dynamic_filter::io
