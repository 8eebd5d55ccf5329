// SPDX-License-Identifier: MIT
/// The only owner of poses: estimates them for scans without poses, and refines given poses.
/// Single-threaded.
#pragma once

#include <optional>
#include <vector>

#include "dynamic_filter/stage_times.hpp"
#include "dynamic_filter/tracking.hpp"
#include "dynamic_filter/types.hpp"

namespace dynamic_filter {

class Tracker {
public:
    explicit Tracker(const OdometryConfig& config) : config_(config) {}

    /// Gives the scan a pose if it has none, or a refined pose if refinement is on; does motion
    /// compensation if the times of its points are known. Returns empty if the scan keeps its given
    /// pose. Throws Error if only some scans have poses.
    std::optional<Tracked> place(Scan& scan);
    /// If the newest scan was tracked: adds it to the map of the odometry, without points labelled
    /// dynamic; with empty labels, all points are added.
    void learn(const Labels& labels);
    /// Forgets all scans, because the next one begins a new recording.
    void restart() {
        odometry_.reset();
        beginning_.clear();
    }

    /// [s] of place() and learn() together.
    [[nodiscard]] const Durations& times() const { return times_; }

private:
    Tracked refine(const Scan& scan);
    Tracked find(const Scan& scan);
    std::optional<Tracked> begin_again();

    OdometryConfig config_;
    std::optional<bool> with_poses_;
    bool is_learning_ = false;  // the newest scan was tracked
    std::optional<Odometry> odometry_;
    std::vector<Scan> beginning_;            // the first scans of a map, until there are kBeginning
    Pose T_world_first_ = Pose::Identity();  // of the first of them
    std::optional<Pose> T_first_second_;     // motion that the odometry found between the first two
    Pose T_world_given_ = Pose::Identity();  // given pose of the previous scan
    Pose T_world_odometry_ = Pose::Identity();  // pose of the odometry frame in the world
    Pose T_odometry_last_ = Pose::Identity();   // pose of the previous scan in the odometry frame
    Durations times_;
};

}  // namespace dynamic_filter
