// SPDX-License-Identifier: MIT
#include "tracking/upright.hpp"

#include <tsl/robin_set.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <vector>

#include "dynamic_filter/motion.hpp"
#include "geometry/beam_axis.hpp"
#include "geometry/voxel.hpp"

namespace dynamic_filter {
namespace {

std::optional<VoxelKey> column_of(const Point& p, float size) {
    const auto cell = cell_of({p.x(), p.y(), 0.0F}, 1.0F / size);
    return cell ? std::optional(pack(*cell)) : std::nullopt;
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
    constexpr double kClearly = 1.2;
    const Eigen::Index axis = beam_axis(points);
    if (axis == 2) return Eigen::Matrix3d::Identity();
    const Eigen::Vector3d one = Eigen::Vector3d::Unit(axis);
    const double share = share_in_ground(points, one.cast<float>());
    const double opposite = share_in_ground(points, (-one).cast<float>());
    const double as_it_is = share_in_ground(points, Point::UnitZ());
    if (std::max(share, opposite) <= kClearly * as_it_is) return Eigen::Matrix3d::Identity();
    const Eigen::Vector3d up = share > opposite ? one : Eigen::Vector3d(-one);
    return Eigen::Quaterniond::FromTwoVectors(up, Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

Points upright_points(const Points& points) {
    constexpr float kNearest = 2.0F, kFarthest = 30.0F;  // [m]
    constexpr float kColumn = 0.6F, kUpright = 0.5F;     // [m]
    constexpr int kReach = static_cast<int>(kFarthest / kColumn) + 1, kSide = 2 * kReach;
    struct Extent {
        float low = std::numeric_limits<float>::infinity(),
              high = -std::numeric_limits<float>::infinity();
    };
    std::vector<Extent> columns(std::size_t{kSide} * kSide);
    struct Near {
        std::uint32_t point, column;
    };
    std::vector<Near> near;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        const Point& p = points[i];
        if (!is_measured(p) || !(p.norm() > kNearest && p.norm() < kFarthest)) continue;
        const auto cell = cell_of({p.x(), p.y(), 0.0F}, 1.0F / kColumn);
        if (!cell) continue;
        near.push_back(
            {i, static_cast<std::uint32_t>((cell->x() + kReach) * kSide + cell->y() + kReach)});
        Extent& e = columns[near.back().column];
        e = {std::min(e.low, p.z()), std::max(e.high, p.z())};
    }
    Points kept;
    for (const auto& [i, column] : near) {
        const Extent& e = columns[column];
        const float height = points[i].z();
        if (e.high - e.low > kUpright && height > e.low + 0.5F * kUpright) {
            kept.push_back(points[i]);
        }
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
