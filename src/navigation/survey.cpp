// SPDX-License-Identifier: MIT
#include "navigation/survey.hpp"

#include <algorithm>
#include <bitset>
#include <cmath>
#include <numbers>

#include "geometry/angle.hpp"

namespace dynamic_filter::app {

namespace {

constexpr float kPathStep = 0.1F;  // [m]
// One beam in each direction suffices.
constexpr int kAzimuths = 720, kElevations = 90;

std::size_t direction_of(const Point& way, float length) {
    constexpr auto kPi = std::numbers::pi_v<float>;
    const auto step = [](float share, int steps) {
        return std::clamp(static_cast<int>(share * static_cast<float>(steps)), 0, steps - 1);
    };
    const int azimuth = step((angle_of(way.y(), way.x()) + kPi) / (2.0F * kPi), kAzimuths);
    const int elevation = step(angle_of_sine(way.z() / length) / kPi + 0.5F, kElevations);
    return static_cast<std::size_t>(elevation * kAzimuths + azimuth);
}

Look look_of(const Eigen::Isometry3f& T_map_sensor, const Points& points) {
    Look look{T_map_sensor.translation(), {}};
    std::bitset<static_cast<std::size_t>(kAzimuths) * kElevations> seen;
    for (const Point& point : points) {
        if (!is_measured(point)) continue;
        const Point way = T_map_sensor.linear() * point;
        const float length = way.norm();
        const std::size_t direction = direction_of(way, length);
        if (seen.test(direction)) continue;
        seen.set(direction);
        look.ends.push_back(look.from + way * std::min(1.0F, kFarthestLook / length));
    }
    look.ends.shrink_to_fit();
    return look;
}

}  // namespace

void Survey::pass(const Eigen::Vector3d& place) {
    if (path_.empty()) origin_ = (place / cell_).array().floor() * cell_;
    const Point in_map = (place - origin_).cast<float>();
    if (path_.empty() || (in_map - path_.back()).norm() >= kPathStep) path_.push_back(in_map);
}

Pose Survey::to_map(const Pose& T_world_sensor) const {
    return Eigen::Translation3d(-origin_) * T_world_sensor;
}

void Survey::add_surfaces(const Points& points, const Labels& labels, const Pose& T_world_sensor,
                          std::span<const std::uint32_t> counts) {
    pass(T_world_sensor.translation());
    const Eigen::Isometry3f T_map_sensor = to_map(T_world_sensor).cast<float>();
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (labels[i] != Label::static_ || !is_measured(points[i])) continue;
        columns_.add(T_map_sensor * points[i], counts.empty() ? 1 : counts[i]);
    }
}

void Survey::add_beams(const Points& points, const Pose& T_world_sensor) {
    pass(T_world_sensor.translation());
    looks_.push_back(look_of(to_map(T_world_sensor).cast<float>(), points));
}

Ground Survey::ground(const Robot& robot) const {
    const std::vector<Surface> surfaces = columns_.surfaces();
    const Area area = area_of(surfaces);
    Floor floor =
        reached_floor(surfaces, area, static_cast<float>(cell_), path_, robot, /*storey=*/0);
    return {origin_, cell_, area, std::move(floor.height)};
}

void Survey::add(const Points& points, const Labels& labels, const Pose& T_world_sensor,
                 double stamp) {
    add_surfaces(points, labels, T_world_sensor);
    if (chooser_.chooses(to_map(T_world_sensor).translation(), stamp)) {
        add_beams(points, T_world_sensor);
    }
}

}  // namespace dynamic_filter::app
