// SPDX-License-Identifier: MIT
#include "tracking/tracker.hpp"

#include <algorithm>
#include <chrono>
#include <string>
#include <utility>

#include "dynamic_filter/error.hpp"

namespace dynamic_filter {

namespace {

using Clock = std::chrono::steady_clock;

}  // namespace

std::optional<Tracked> Tracker::place(Scan& scan) {
    if (with_poses_.value_or(scan.has_pose) != scan.has_pose) {
        throw Error("scan " + std::to_string(scan.index) +
                    (scan.has_pose ? " has a pose, but those before had none"
                                   : " has no pose, but those before had one"));
    }
    with_poses_ = scan.has_pose;
    is_learning_ = !scan.has_pose || config_.refine;
    if (!is_learning_) return std::nullopt;
    const auto start = Clock::now();
    if (!scan.times.empty() && scan.times.size() != scan.points.size()) {
        throw Error("scan " + std::to_string(scan.index) + " has " +
                    std::to_string(scan.times.size()) + " times, but " +
                    std::to_string(scan.points.size()) + " points");
    }
    Tracked tracked;
    if (scan.has_pose) {
        tracked = refine(scan);
    } else {
        if (!odometry_) odometry_.emplace(config_);
        tracked = odometry_->track(scan.points, scan.times, scan.stamp);
    }
    scan.T_world_sensor = tracked.T_world_sensor;
    scan.has_pose = true;
    if (!scan.times.empty()) scan.points = undo_motion(scan.points, scan.times, tracked.velocity);
    scan.times.clear();
    times_.add(seconds_since(start));
    return tracked;
}

/// Combines two sources: the odometry is accurate from scan to scan, and the given poses over long
/// distances. So the frame of the odometry is slowly moved in the world, in proportion to the
/// distance driven.
Tracked Tracker::refine(const Scan& scan) {
    const Pose T_world_given = scan.T_world_sensor;
    std::optional<Pose> guess;
    if (odometry_) {
        guess = T_world_given_.inverse() * T_world_given;
    } else {
        odometry_.emplace(config_);
        T_world_odometry_ = T_world_given;
    }
    T_world_given_ = T_world_given;
    Tracked tracked = odometry_->track(scan.points, scan.times, scan.stamp, guess);
    const Pose T_odometry = tracked.T_world_sensor;
    const double way = (T_odometry_last_.inverse() * T_odometry).translation().norm();
    const double share = std::min(1.0, way / config_.return_over);
    const Pose T_world_refined = T_world_odometry_ * T_odometry;
    const Twist off = log(T_world_refined.inverse() * T_world_given);
    T_odometry_last_ = T_odometry;
    tracked.T_world_sensor = T_world_refined * exp(share * off);
    T_world_odometry_ = tracked.T_world_sensor * T_odometry.inverse();
    return tracked;
}

void Tracker::learn(const Labels& labels) {
    if (!is_learning_) return;
    const auto start = Clock::now();
    odometry_->learn(labels);
    times_.add(seconds_since(start));
}

}  // namespace dynamic_filter
