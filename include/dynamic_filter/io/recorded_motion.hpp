// SPDX-License-Identifier: MIT
/// @file
/// Estimates the motion of the sensor from the scans of a recording, and compares it with the
/// recorded poses.
///
/// - Units: [m], [rad], [s].
/// - Frames: poses T_world_sensor; displacements in the sensor frame.
/// - Shapes: lists, with one entry per scan where a function says so.
/// - Ownership: values; the sequence is borrowed.
/// - Threads: thread-safe.
/// - Errors: none of their own; scans that cannot be read are skipped.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "dynamic_filter/io/sequence.hpp"
#include "dynamic_filter/odometry/odometry.hpp"
#include "dynamic_filter/odometry/sweep_times.hpp"

namespace dynamic_filter::io {

/// Poses of all scans by odometry alone, one entry per scan; empty for a scan that cannot be read.
/// `after` is called after each scan; if it returns false, the work stops.
std::vector<std::optional<Tracked>> track_scans(const Sequence& sequence,
                                                const OdometryConfig& config,
                                                const std::function<bool()>& after = {});

/// Finds out how a rotating sensor turns. The result is set if scans overlay clearly better when
/// the time of each point is computed from its azimuth. It is empty if motion compensation was
/// already done, if the sensor did not move, or if it does not rotate. Reads a few consecutive
/// scans at several places of the recording.
std::optional<Sweep> find_sweep(const Sequence& sequence, const OdometryConfig& config);

/// Difference between the recorded poses and the motion that the scans show, for pairs of scans
/// with a given separation. All values are medians.
struct PoseError {
    std::size_t apart = 0;  ///< separation in scans
    double way = 0.0;       ///< [m] distance between the two scans
    double shift = 0.0;     ///< [m] error of the translation
    double turn = 0.0;      ///< [rad] error of the rotation
};

/// Blur of overlaid consecutive scans, from overlay_blur() [m]; 0: not known.
struct Blur {
    double as_measured = 0.0;  ///< [m] with the points as they are in the scans
    double undone = 0.0;       ///< [m] after motion compensation with the times of the points

    [[nodiscard]] double least() const;  ///< [m] the smaller of the known values
    /// True if scans overlay clearly better after motion compensation.
    [[nodiscard]] bool is_distorted() const;
};

/// How well the poses of a recording fit its scans, if it has poses.
struct MotionQuality {
    /// For scans 1, 5, 10 and 20 apart, as far as the recording is long enough.
    std::vector<PoseError> errors;
    Blur given;  ///< blur at the poses of the recording
    Blur found;  ///< blur at the poses of the odometry
    /// True if the errors of the given poses over 20 scans are small everywhere: less than 1 m or a
    /// third of the distance, and less than 0.1 rad. Poses of a wrong frame, format or recording
    /// have larger errors.
    bool nearly_right = false;

    /// True if scans overlay clearly better at other poses than the given ones.
    [[nodiscard]] bool has_bad_poses() const;
};

/// Measures the pose errors and the blur. Reads 21 consecutive scans at each of several places of
/// the recording, with the times of their points if Sequence::wants_times is set.
MotionQuality measure_motion(const Sequence& sequence, const OdometryConfig& config);

/// Describes the mistake in the poses, if scans overlay clearly better at other poses, or if the
/// poses belong to another frame or are delayed. Returns one sentence with the measured values;
/// empty if there is no mistake. Reads up to 180 scans.
std::string find_pose_mistake(const Sequence& sequence, const OdometryConfig& config);

}  // namespace dynamic_filter::io
