// SPDX-License-Identifier: MIT
/// The poses of scans that come without, or with poses that are to be refined. Single-threaded.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "dynamic_filter/odometry/odometry.hpp"
#include "dynamic_filter/stage_times.hpp"
#include "dynamic_filter/types.hpp"
#include "dynamic_filter/verdict.hpp"

namespace dynamic_filter {

class PoseTracker {
public:
    explicit PoseTracker(const OdometryConfig& config) : config_(config) {}

    /// Gives the scan a pose if it has none, or a better one if poses are refined, and undoes the
    /// sensor's motion during the scan if the times of its points are known. False: the scan has a
    /// pose, which is taken as it is. Throws Error if only some scans have poses.
    bool track(Scan& scan);
    /// Tells instant verdicts the poses of their scans; returns the labels of the scan tracked
    /// last, if its verdict is among them.
    Labels attach(std::vector<Verdict>& verdicts);
    /// The labels of the scan tracked last: what moves is no landmark. Empty: nothing is known.
    void learn(const Labels& labels);
    /// What comes next has nothing to do with what came before.
    void restart() { odometry_.reset(); }
    /// Whether the odometry began a new map with the scan tracked last.
    [[nodiscard]] bool begins_anew() const;

    [[nodiscard]] const Durations& times() const { return times_; }  ///< [s] of both

private:
    Tracked refine(const Scan& scan);

    OdometryConfig config_;
    std::optional<bool> with_poses_;
    std::size_t newest_ = 0;                   // Scan::index
    std::map<std::size_t, Tracked> untold_{};  // by Scan::index: until the scan's verdict comes
    std::optional<Odometry> odometry_;
    Pose T_world_given_ = Pose::Identity();     // of the scan before, as it came
    Pose T_world_odometry_ = Pose::Identity();  // where the odometry's frame is
    Pose T_odometry_last_ = Pose::Identity();   // of the scan before
    Durations times_;
};

}  // namespace dynamic_filter
