// SPDX-License-Identifier: MIT
/// Estimates poses for scans without poses, and refines given poses. Single-threaded.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "dynamic_filter/filter.hpp"
#include "dynamic_filter/stage_times.hpp"
#include "dynamic_filter/tracking.hpp"
#include "dynamic_filter/types.hpp"

namespace dynamic_filter {

class PoseTracker {
public:
    explicit PoseTracker(const OdometryConfig& config) : config_(config) {}

    /// Gives the scan a pose if it has none, or a refined pose if refinement is on; does motion
    /// compensation if the times of its points are known. Returns false if the scan keeps its given
    /// pose. Throws Error if only some scans have poses.
    bool track(Scan& scan);
    /// Writes the estimated poses into the instant verdicts on their scans. Returns the labels of
    /// the scan that was tracked last, if its verdict is among them.
    Labels attach(std::vector<Verdict>& verdicts);
    /// Adds the scan that was tracked last to the map of the odometry, without points labelled
    /// dynamic; with empty labels, all points are added.
    void learn(const Labels& labels);
    /// Forgets all scans, because the next one begins a new recording.
    void restart() { odometry_.reset(); }
    /// True if the odometry began a new map with the scan that was tracked last.
    [[nodiscard]] bool begins_anew() const;

    /// [s] of track() and learn() together.
    [[nodiscard]] const Durations& times() const { return times_; }

private:
    Tracked refine(const Scan& scan);

    OdometryConfig config_;
    std::optional<bool> with_poses_;
    std::size_t newest_ = 0;  // Scan::index
    // Keys: Scan::index; kept until the verdict on the scan comes.
    std::map<std::size_t, Tracked> untold_{};
    std::optional<Odometry> odometry_;
    Pose T_world_given_ = Pose::Identity();     // given pose of the previous scan
    Pose T_world_odometry_ = Pose::Identity();  // pose of the odometry frame in the world
    Pose T_odometry_last_ = Pose::Identity();   // pose of the previous scan in the odometry frame
    Durations times_;
};

}  // namespace dynamic_filter
