// SPDX-License-Identifier: MIT
#include "tracking/tracker.hpp"

#include <algorithm>
#include <chrono>
#include <string>
#include <utility>

#include "dynamic_filter/error.hpp"
#include "tracking/beginning.hpp"
#include "tracking/upright.hpp"

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
        tracked = find(scan);
    }
    scan.T_world_sensor = tracked.T_world_sensor;
    scan.has_pose = true;
    if (!scan.times.empty()) scan.points = undo_motion(scan.points, scan.times, tracked.velocity);
    scan.times.clear();
    times_.add(seconds_since(start));
    return tracked;
}

Tracked Tracker::find(const Scan& scan) {
    std::optional<Pose> guess;
    if (!odometry_) {
        odometry_.emplace(config_);
        guess = Pose(upright_rotation(scan.points));  // of the first scan in the world
    }
    Tracked tracked = odometry_->track(scan.points, scan.times, scan.stamp, guess);
    if (tracked.begins_anew) beginning_.clear();
    if (beginning_.size() == kBeginning) return tracked;
    if (beginning_.size() == 1) {
        T_first_second_ = T_world_first_.inverse() * tracked.T_world_sensor;
    }
    if (beginning_.empty()) T_world_first_ = tracked.T_world_sensor;
    beginning_.push_back(scan);
    if (beginning_.size() == kBeginning) {
        if (const auto again = begin_again()) return *again;
    }
    return tracked;
}

/// When the first scans are known, they show whether the odometry set out with the right velocity.
/// If not, it tracks them again, and a new map begins. Returns the pose of the newest one then.
std::optional<Tracked> Tracker::begin_again() {
    constexpr double kSame = 1.0;  // [m/s]
    const std::vector<Scan> scans = std::exchange(beginning_, std::vector<Scan>(kBeginning));
    const auto velocity = initial_velocity(scans, config_);
    const double passed = scans[1].stamp - scans[0].stamp;
    if (!velocity || !(passed > 0.0)) return std::nullopt;
    const Twist set_out = log(*T_first_second_) / passed;
    if ((set_out - *velocity).head<3>().norm() < kSame) return std::nullopt;
    odometry_.emplace(config_);
    Tracked tracked;
    for (std::size_t i = 0; i < scans.size(); ++i) {
        std::optional<Pose> guess;
        if (i == 0) guess = T_world_first_;
        if (i == 1) guess = exp(*velocity * passed);
        tracked = odometry_->track(scans[i].points, scans[i].times, scans[i].stamp, guess);
        if (i + 1 < scans.size()) odometry_->learn({});
    }
    tracked.begins_anew = true;
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
