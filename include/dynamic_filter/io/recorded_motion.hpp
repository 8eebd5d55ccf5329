// SPDX-License-Identifier: MIT
/// @file
/// What the scans of a recording say about how the sensor moved, beside what its poses say.
///
/// - Units: [m], [rad], [s].
/// - Frames: poses T_world_sensor; displacements in the sensor frame.
/// - Shapes: lists, an entry a scan where they say so.
/// - Ownership: values; the sequence is borrowed.
/// - Threads: thread-safe.
/// - Errors: none of their own; scans that cannot be read are passed over.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "dynamic_filter/io/sequence.hpp"
#include "dynamic_filter/odometry/odometry.hpp"
#include "dynamic_filter/odometry/sweep_times.hpp"

namespace dynamic_filter::io {

/// Poses of all scans by odometry alone; empty for those that cannot be read. `after` is called
/// after each scan, and stops the work by returning false.
std::vector<std::optional<Tracked>> track_scans(const Sequence& sequence,
                                                const OdometryConfig& config,
                                                const std::function<bool()>& after = {});

/// How a turning sensor turns, if scans overlay clearly better when each point is taken for
/// measured at the time that follows from its azimuth; empty if not: the motion during the scans is
/// undone already, there was none, or the sensor does not turn. Reads a few scans in a row at some
/// places of the recording.
std::optional<Sweep> find_sweep(const Sequence& sequence, const OdometryConfig& config);

/// How far the poses of scans so far apart are off what the scans show: medians.
struct PoseError {
    std::size_t apart = 0;  ///< scans
    double way = 0.0;       ///< [m] between them
    double shift = 0.0;     ///< [m]
    double turn = 0.0;      ///< [rad]
};

/// How much scans blur: overlay_blur() of scans in a row [m]; 0: not known.
struct Blur {
    double as_measured = 0.0;  ///< [m] points as they are in the scans
    double undone = 0.0;       ///< [m] the motion during scans undone by the times of the points

    [[nodiscard]] double least() const;  ///< [m] of those that are known
    /// Whether scans overlay clearly better with their motion undone.
    [[nodiscard]] bool is_distorted() const;
};

/// How well the poses of a recording fit its scans, as far as it has poses.
struct MotionQuality {
    std::vector<PoseError> errors;  ///< of scans 1, 5, 10 and 20 apart, as far as there are
    Blur given;                     ///< at the recording's poses
    Blur found;                     ///< at those that the odometry finds
    /// Whether over 20 scans the given poses err by little, everywhere: less than a metre or a
    /// third of the way, and a tenth of a radian. Poses of another frame, format or recording do
    /// not.
    bool nearly_right = false;

    /// Whether scans overlay clearly better at other poses than those that are given.
    [[nodiscard]] bool has_bad_poses() const;
};

/// Reads 21 scans in a row at each of some places of the recording, with the times of their points
/// if the sequence wants_times.
MotionQuality measure_motion(const Sequence& sequence, const OdometryConfig& config);

/// What is wrong with the poses, if scans overlay clearly better at others, or if they are another
/// frame's or late: one sentence, with figures; empty if nothing is. Reads up to 180 scans.
std::string find_pose_mistake(const Sequence& sequence, const OdometryConfig& config);

}  // namespace dynamic_filter::io
