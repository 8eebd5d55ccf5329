// SPDX-License-Identifier: MIT
#include "tracking/upright.hpp"

#include <tsl/robin_map.h>
#include <tsl/robin_set.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "dynamic_filter/motion.hpp"
#include "geometry/voxel.hpp"

namespace dynamic_filter {
namespace {

std::optional<VoxelKey> column_of(const Point& p, float size) {
    const auto cell = cell_of({p.x(), p.y(), 0.0F}, 1.0F / size);
    return cell ? std::optional(pack(*cell)) : std::nullopt;
}

/// Direction along which the beams spread least: the one about which a rotating sensor turns.
Point axis_of_beams(const Points& points) {
    Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
    for (const Point& p : points) {
        const Eigen::Vector3d direction = p.cast<double>().normalized();
        if (is_measured(p)) moments += direction * direction.transpose();
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(moments);
    return axes.eigenvectors().col(0).cast<float>();
}

/// Share of the points in the fullest layer below the sensor, if `up` is the vertical.
double share_in_ground(const Points& points, const Point& up) {
    constexpr float kHighest = -0.3F, kLowest = -4.0F, kThick = 0.2F, kFar = 30.0F;  // [m]
    std::map<int, std::size_t> layers;
    std::size_t all = 0;
    for (const Point& p : points) {
        if (!is_measured(p) || p.norm() > kFar) continue;
        ++all;
        const float height = up.dot(p);
        if (height > kLowest && height < kHighest) {
            ++layers[static_cast<int>(std::floor(height / kThick))];
        }
    }
    std::size_t most = 0;
    for (const auto& [layer, count] : layers) {
        const auto next = layers.find(layer + 1);
        most = std::max(most, count + (next == layers.end() ? 0 : next->second));
    }
    return all == 0 ? 0.0 : static_cast<double>(most) / static_cast<double>(all);
}

}  // namespace

Eigen::Matrix3d upright_rotation(const Points& points) {
    constexpr float kNearlyUp = 0.7F;
    constexpr double kClearly = 1.2;
    const Point axis = axis_of_beams(points);
    if (std::abs(axis.z()) > kNearlyUp) return Eigen::Matrix3d::Identity();
    const double as_it_is = share_in_ground(points, Point::UnitZ());
    const double one = share_in_ground(points, axis), other = share_in_ground(points, -axis);
    if (std::max(one, other) <= kClearly * as_it_is) return Eigen::Matrix3d::Identity();
    const Eigen::Vector3d up = (one > other ? axis : Point(-axis)).cast<double>();
    // The axes of drivers are nearly those of the sensor, in another order.
    Eigen::Index nearest = 0;
    up.cwiseAbs().maxCoeff(&nearest);
    const Eigen::Vector3d vertical =
        std::copysign(1.0, up[nearest]) * Eigen::Vector3d::Unit(nearest);
    return Eigen::Quaterniond::FromTwoVectors(vertical, Eigen::Vector3d::UnitZ())
        .toRotationMatrix();
}

Points upright_points(const Points& points) {
    constexpr float kNearest = 2.0F, kFarthest = 30.0F;  // [m]
    constexpr float kColumn = 0.6F, kTall = 0.5F;        // [m]
    struct Extent {
        float low, high;
    };
    tsl::robin_map<VoxelKey, Extent, VoxelHash> columns;
    const auto column = [&](const Point& p) {
        const bool usable = is_measured(p) && p.norm() > kNearest && p.norm() < kFarthest;
        return usable ? column_of(p, kColumn) : std::nullopt;
    };
    for (const Point& p : points) {
        if (const auto key = column(p)) {
            Extent& e = columns.try_emplace(*key, Extent{p.z(), p.z()}).first.value();
            e = {std::min(e.low, p.z()), std::max(e.high, p.z())};
        }
    }
    Points kept;
    for (const Point& p : points) {
        const auto key = column(p);
        if (!key) continue;
        const Extent& e = columns.at(*key);
        if (e.high - e.low > kTall && p.z() > e.low + 0.5F * kTall) kept.push_back(p);
    }
    return kept;
}

double upright_overlay(const Points& a, const Points& b, const Pose& T_a_b) {
    constexpr float kSize = 0.3F;  // [m]
    using Columns = tsl::robin_set<VoxelKey, VoxelHash>;
    const auto columns_of = [](const Points& points) {
        Columns columns;
        for (const Point& p : points) {
            if (const auto key = column_of(p, kSize)) columns.insert(*key);
        }
        return columns;
    };
    const Columns there = columns_of(a), here = columns_of(moved(b, T_a_b));
    const auto common =
        std::count_if(here.begin(), here.end(), [&](VoxelKey key) { return there.contains(key); });
    return here.empty() ? 0.0 : static_cast<double>(common) / static_cast<double>(here.size());
}

}  // namespace dynamic_filter
