// SPDX-License-Identifier: MIT
/// @file
/// Checks whether the scans of a recording fit together at its poses, and finds the likely mistake
/// if they do not. Estimates the motion of the sensor from the scans, and compares it with the
/// recorded poses. Compares the world frames of several recordings ("drives") at places that two of
/// them pass, and names an offset between the frames.
///
/// - Units: [m], [rad], [deg], [s]; shares 0..1.
/// - Frames: poses T_world_sensor; displacements in the sensor frame. The poses of all drives are
///   read as poses in one world frame. An offset says where the poses of one drive put a thing,
///   relative to where those of the other drive put it.
/// - Shapes: lists, with one entry per scan where a function says so. Findings about stamps come
///   first, then those about points, then about poses.
/// - Ownership: values; recordings are borrowed and must not be null.
/// - Threads: thread-safe; uses parallel_for. Results do not depend on the number of threads.
/// - Errors: none of its own; scans that cannot be read are skipped, or listed in
///   Preflight::unusable.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "dynamic_filter/motion.hpp"
#include "dynamic_filter/recording.hpp"
#include "dynamic_filter/tracking.hpp"

namespace dynamic_filter::io {

/// A likely mistake in the recording or in the options.
struct Finding {
    std::string what;    ///< one sentence with the measured values
    std::string advice;  ///< what to do: an option to try ("--..."), or a sentence
};

/// How well scans overlay if poses and points are interpreted in a certain way. It is the share,
/// 0..1, of upright structures that fall on upright structures of another scan, over pairs of scans
/// that are 1 to 20 scans apart.
struct Overlay {
    /// The interpretation: "as given", a PoseFix, "points in world" or "points in sensor".
    std::string reading;
    double share = 0.0;  ///< 0..1
};

/// Result of the check.
struct Preflight {
    std::vector<Finding> findings;   ///< empty if nothing is suspicious
    std::vector<std::string> notes;  ///< what `run` does by itself, as sentences for the user
    /// "as given" is first; empty if no two scans could be compared.
    std::vector<Overlay> overlays;
    std::size_t scans = 0;  ///< number of scans that were read
    /// Scans that a run would reject, with the reason. Faults that show without reading the points
    /// are listed for all scans, other faults only for the scans that were read.
    std::vector<std::string> unusable;
};

/// How much is checked. `quick` reads about 15 scans, and finds what makes scans overlay badly as a
/// whole. `thorough` reads about 60 scans, and also tests whether small displacements of the scans
/// improve the overlay.
enum class Depth { quick, thorough };

/// Checks some scans at each of several places of the recording. With 64 beams, `thorough` takes
/// one to two seconds, and `quick` about a tenth of a second.
Preflight check_recording(const Recording& recording, Depth depth);

/// Poses of all scans by odometry alone, one entry per scan; empty for a scan that cannot be read.
/// `after` is called after each scan; if it returns false, the work stops.
std::vector<std::optional<Tracked>> track_scans(const Recording& recording,
                                                const OdometryConfig& config,
                                                const std::function<bool()>& after = {});

/// Finds out how a rotating sensor turns. The result is set if scans overlay clearly better when
/// the time of each point is computed from the order of the points or from their azimuths, at the
/// poses that odometry then finds. It is empty if motion compensation was
/// already done, if the sensor did not move, or if it does not rotate. Reads a few consecutive
/// scans at several places of the recording.
std::optional<Sweep> find_sweep(const Recording& recording, const OdometryConfig& config);

/// Where the beams of the sensor meet [m], in the frame of the points of the files: one place, or
/// two if the scans of two sensors are merged. Empty if the scans do not show it: those of sensors
/// that do not rotate, or whose points were put in another order. Reads five scans.
std::vector<Eigen::Vector3d> find_sensor_places(const Recording& recording);

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
    /// 0..1: share of the upright structures of a scan that stand where those of others stand,
    /// which are 1 to 20 scans apart, at the poses of the recording.
    double given_overlay = 0.0;
    double found_overlay = 0.0;  ///< 0..1: the same, at the poses of the odometry
    /// 0..1: share of the scans that do not show the motion in some direction, as in a smooth
    /// tunnel. If it is large, the odometry says nothing about the given poses.
    double weak = 0.0;
    /// True if the errors of the given poses over 20 scans are small everywhere: less than 1 m or a
    /// third of the distance, and less than 0.1 rad. Poses of a wrong frame, format or recording
    /// have larger errors.
    bool nearly_right = false;

    /// True if most scans show the motion in all directions.
    [[nodiscard]] bool shows_motion() const;
    /// True if scans show the motion, and overlay clearly more sharply at other poses than the
    /// given ones, and as many structures overlay.
    [[nodiscard]] bool has_bad_poses() const;
};

/// Measures the pose errors and the blur. Reads 21 consecutive scans at each of several places of
/// the recording, with the times of their points if they have them (with_times()).
MotionQuality measure_motion(const Recording& recording, const OdometryConfig& config);
/// The same for the 21 scans around one scan. All values are 0 if they cannot be read.
MotionQuality measure_motion_at(const Recording& recording, std::size_t scan,
                                const OdometryConfig& config);

/// Describes the mistake in the poses, if a run would replace them because scans overlay better at
/// other poses, or if they belong to another frame or are delayed. Returns one sentence with the
/// measured values; empty if there is no mistake. Reads up to 180 scans; all, if the poses of those
/// look bad.
std::string find_pose_mistake(const Recording& recording, const OdometryConfig& config);

/// What the places that two drives pass say about the frames of their poses.
enum class FrameMatch {
    equal,     ///< the scans overlay as they are
    shifted,   ///< one offset makes the scans overlay at nearly all places
    drifting,  ///< scans overlay with an offset that differs from place to place
    unlike,    ///< the drives should meet, but their scans overlay with no offset
    apart,     ///< no place of one drive is near a place of the other
    /// The scans of the common places show too little, cannot be read, or were not looked at.
    not_known,
    same_poses,  ///< both drives have the same poses: they are probably one recording
};

/// The offset of the frame of drive `b` from that of drive `a`.
struct DriveOffset {
    std::size_t a = 0;                         ///< index of a drive
    std::size_t b = 0;                         ///< index of the other drive, greater than `a`
    FrameMatch match = FrameMatch::not_known;  ///< what the other members mean
    /// Smallest horizontal distance [m] between a position of `a` and one of `b`; for distances
    /// above 10 m, it is accurate to about one percent of the lengths of the drives.
    double gap = 0.0;
    std::size_t places = 0;    ///< number of places that were looked at
    std::size_t fitting = 0;   ///< number of those at which the scans of both drives fit together
    std::size_t agreeing = 0;  ///< number of those whose offset is the common one
    /// `b` shows a thing at R (p - pivot) + pivot + shift that `a` shows at p, where R turns by
    /// yaw_deg about the vertical axis. [m] in the world frame.
    Eigen::Vector3d shift = Eigen::Vector3d::Zero();
    double yaw_deg = 0.0;  ///< [deg] counterclockwise, seen from above
    /// [m] in the world frame: the middle of the places.
    Eigen::Vector3d pivot = Eigen::Vector3d::Zero();
    double least = 0.0;  ///< [m] smallest offset of a single place
    double most = 0.0;   ///< [m] largest offset of a single place
    double spread =
        0.0;  ///< [m] largest difference between the offset of a place and the common one
};

/// Measures the offsets between pairs of drives, in the order (0,1), (0,2), (1,2), (0,3), and so
/// on: 8 scans at each of at most 8 places of a pair. A drive is compared with the three drives
/// before it that it meets at most places; its other pairs are `not_known` or `apart`. Drives
/// without poses are left out. The first `known` drives are taken to fit each other, and are not
/// compared.
std::vector<DriveOffset> measure_drive_offsets(std::span<const Recording* const> drives,
                                               std::size_t known = 0);

/// Sentences with advice about offsets between drives; empty if nothing is suspicious or if there
/// are fewer than two drives. Of two drives that differ by a constant offset, the one with which
/// fewer others agree is said to be off; otherwise the later one. A drive that meets no other one
/// is reported if no two drives meet, or if it is more than 20 km away from all others. Drives
/// without poses are reported.
std::vector<Finding> compare_drives(std::span<const Recording* const> drives);

/// The same, for offsets that are known already.
std::vector<Finding> findings_of(std::span<const Recording* const> drives,
                                 std::span<const DriveOffset> offsets);

}  // namespace dynamic_filter::io
