// SPDX-License-Identifier: MIT
/// @file
/// A recording: scans in order, a pose and a stamp for each scan, and ground truth if there is any.
///
/// - Units: [m]; stamps [s].
/// - Frames: points in the sensor frame, poses T_world_sensor; other conventions are converted. The
///   files may hold points in another frame with the same axes, such as the vehicle's; then
///   Info::sensor_at is where the sensor is in it.
/// - Shapes: arrays of an Info have one entry per scan, those of a FullScan one per point.
/// - Ownership: values; copies of a Recording share its open bag and its Info.
/// - Threads: a Recording never changes; its members and functions that take one are thread-safe.
/// - Errors: InputError (with the file and the place in it) and ConfigError.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dynamic_filter/cloud.hpp"
#include "dynamic_filter/motion.hpp"
#include "dynamic_filter/poses.hpp"
#include "dynamic_filter/types.hpp"

namespace dynamic_filter::io {

/// How the files of a recording may be arranged; see docs/formats.md.
struct LayoutName {
    std::string name;   ///< "kitti-360"
    std::string what;   ///< "a drive of KITTI-360"
    std::string files;  ///< the files by which it is recognised
};

/// All layouts, in the order in which they are looked for.
std::vector<LayoutName> layouts();
std::vector<std::string> layout_names();  ///< the names alone, in the same order

/// Axis-aligned boxes [m].
using Boxes = std::vector<Eigen::AlignedBox3f>;

/// How to read a recording, where its files do not tell.
struct OpenOptions {
    /// Name of one of layouts(), to read this one only; empty: recognised by the files.
    std::string layout;
    /// Pose file; empty: the usual place of the layout.
    std::optional<std::filesystem::path> poses;
    bool without_poses = false;  ///< true: the poses of the recording are not read
    std::size_t first = 0;       ///< index of the first scan to use
    /// Index of the last scan to use; empty: the last one of the recording.
    std::optional<std::size_t> last;
    std::size_t stride = 1;  ///< use every scan (1), every second scan (2), and so on
    std::string topic;       ///< topic of the scans of a bag; empty: the only one
    /// Topic of the poses of a bag, or "/tf"; empty: chosen, and a note says how.
    std::string pose_topic;
    bool deskew = false;               ///< do motion compensation of each scan
    PoseFix pose_fix = PoseFix::none;  ///< correction of the poses
    /// True: points are in the frame of the poses, not in the sensor frame.
    bool points_in_world = false;
    double time_unit = 1.0;  ///< [s] per unit of the stamps of scans and poses
    /// [m] Place of the sensor in the frame of the points; empty: what the recording says, or not
    /// known.
    std::optional<Eigen::Vector3d> sensor_at;
    double point_unit = 1.0;  ///< [m] per unit of the coordinates of points
    Boxes own_body{};         ///< see Info::own_body
};

/// What is known of a recording without reading the scans.
struct Info {
    std::string layout;          ///< name of one of layouts(), as recognised
    std::filesystem::path root;  ///< path that was opened
    /// In the natural order of their names. For a bag, these are no files, but numbers below its
    /// path.
    std::vector<std::filesystem::path> scan_files;
    /// The files that hold or define the ground truth. Parallel to scan_files, an empty path if a
    /// scan has none; or empty.
    std::vector<std::filesystem::path> label_files;
    /// Parallel to scan_files; empty if the scan files hold the poses, or if there are none.
    std::vector<Pose> T_world_sensor;
    /// File of the poses; empty: the files of the scans, the bag, or none.
    std::filesystem::path pose_source;
    bool has_poses = true;         ///< false: poses are not known, and T_world_sensor is empty
    bool tracked = false;          ///< true: the poses are those of with_poses()
    std::vector<double> stamps;    ///< parallel to scan_files [s]; assumed at 10 Hz if not measured
    bool measured_stamps = false;  ///< true: the stamps come from the recording
    /// All poses of the recording, as dense in time as they are; may be empty.
    Trajectory trajectory;
    /// True: scans between the poses of `trajectory` are too far in time from them to have a pose,
    /// for instance between key frames. They are to be placed by odometry that is tied to these
    /// poses; until then, T_world_sensor has none for them, and they cannot be read.
    bool sparse_poses = false;
    /// Tells the times of points if the scans do not hold them; if they do, only its shift counts.
    std::optional<Sweep> sweep;
    bool deskewed = false;         ///< true: the points are those of deskewed()
    bool points_in_world = false;  ///< true: the files have points in the frame of the poses
    /// For poses in the files of the scans; all other poses are already corrected.
    PoseFix pose_fix = PoseFix::none;
    /// [m] Place of the sensor in the frame of the points of the files, which has the axes of the
    /// sensor frame; empty: not known, so taken for the origin. The poses above, and the points and
    /// the pose of a FullScan, are those of the sensor.
    std::optional<Eigen::Vector3d> sensor_at;
    double point_unit = 1.0;  ///< [m] per unit of the coordinates of points in the files
    /// What moves with the sensor, such as its vehicle, in the sensor frame; with a rig file, in
    /// the frame of the vehicle. Points in these boxes are no measurements of the world.
    Boxes own_body{};
    bool intensity_is_truth = false;  ///< `benchmark` with ground truth in the intensity
    std::vector<std::string> notes;   ///< assumptions that were made, as sentences for the user
    /// What makes the result doubtful or incomplete, as sentences for the user: parts of a bag that
    /// cannot be read, so that scans are missing, or motion that the scans do not show.
    std::vector<std::string> losses;
    /// Parallel to scan_files, or empty: 1 for a file that repeats the one before it, as drivers
    /// write when no new scan came. It cannot be read as a scan of its own.
    std::vector<std::uint8_t> repeats;
    /// [s] Stamps of poses that were matched to scans by their order, if both have stamps.
    std::vector<double> pose_stamps;

    /// True if any scan has ground truth.
    [[nodiscard]] bool has_truth() const { return intensity_is_truth || !label_files.empty(); }
};

/// One scan as read: all fields of the file, and the points in the sensor frame.
struct FullScan {
    Cloud cloud;    ///< as in the file (`benchmark`: x y z in the world frame)
    Points points;  ///< sensor frame, same order; after motion compensation if that was asked for
    Pose T_world_sensor = Pose::Identity();  ///< at `stamp`
    bool has_pose = true;                    ///< false: T_world_sensor has no meaning
    double stamp = 0.0;                      ///< [s]
    /// [s] of the points relative to `stamp`; empty: unknown, or not asked for.
    std::vector<float> times;
    Labels truth;  ///< one per point; empty without ground truth
    /// Why the ground truth of this scan cannot be used; the scan itself can.
    std::string truth_fault;
    /// Points at the greatest range, where drivers put beams without a return; in `points`, they
    /// are at the origin, as points without a measurement.
    std::size_t no_returns = 0;
    /// 1 for each point of the own body, or empty; in `points`, they are at the origin, as points
    /// without a measurement.
    std::vector<std::uint8_t> own{};
    std::size_t sensor = 0;     ///< which of several sensors made it
    std::string sensor_name{};  ///< its name in the rig file; empty: the only sensor, or no name
};

struct RecordingParts;

/// Scans in order. A value that is cheap to copy, and that never changes: the functions below make
/// another recording of one. Thread-safe.
class Recording {
public:
    Recording();  ///< has no scans
    /// A recording of the files in `info.scan_files`.
    explicit Recording(Info info);
    /// For open_recording() and the functions below.
    explicit Recording(RecordingParts parts);

    [[nodiscard]] std::size_t size() const;  ///< number of scans
    [[nodiscard]] const Info& info() const;  ///< valid as long as any copy of the recording

    /// Reads scan i. Throws InputError if the scan cannot be used (truncated, without points, with
    /// a non-finite pose); the caller may then count the scan as rejected and continue.
    [[nodiscard]] FullScan read(std::size_t i) const;
    /// Throws the exception that read() would throw, as far as the fault shows without reading the
    /// points.
    void check(std::size_t i) const;
    /// For the functions below.
    [[nodiscard]] const RecordingParts& parts() const { return *parts_; }

private:
    std::shared_ptr<const RecordingParts> parts_;
};

/// Recognizes the layout, and checks that the numbers of scans, poses and stamps agree. If no poses
/// are found, a note says which files were looked for. Throws InputError (nothing found, different
/// numbers, invalid rotation) and ConfigError (several topics to choose from).
Recording open_recording(const std::filesystem::path& data, const OpenOptions& options = {});

/// The scans `first`, `first + stride`, and so on up to `last` (empty: the last one). Throws
/// ConfigError if that selects nothing.
Recording slice(const Recording& recording, std::size_t first, std::optional<std::size_t> last = {},
                std::size_t stride = 1);

/// Scans have the times of their points, if the files hold them; otherwise those of the sweep, if
/// it is known or given. The shift of the sweep counts for both.
Recording with_times(const Recording& recording, std::optional<Sweep> sweep = {});

/// The sensor's motion within each scan is undone, with the poses of the recording and the times of
/// the points (as in with_times()), which scans then no longer have. If that is not possible, a
/// note says why, and the recording is otherwise the same.
Recording deskewed(const Recording& recording, std::optional<Sweep> sweep = {});

/// Poses that were estimated or refined, one entry per scan; empty: not known. If scans have
/// times, the motion within each scan is undone with the velocities, and scans then have none.
Recording with_poses(const Recording& recording,
                     const std::vector<std::optional<Tracked>>& tracked);

/// The same with the sensor at another place in the frame of the points of the files [m].
Recording with_sensor_at(const Recording& recording, const Eigen::Vector3d& at);

/// The same without poses; points are as in the files.
Recording without_poses(const Recording& recording);

/// More notes, after those that there are.
Recording with_notes(const Recording& recording, const std::vector<std::string>& notes);

/// Reason for rejecting a scan whose fields differ from those of the previous scans.
inline constexpr const char* kOtherFields =
    "its fields are not those of the first scan; one map cannot hold both";

/// More losses, after those that there are.
Recording with_losses(const Recording& recording, const std::vector<std::string>& losses);

/// Name of a scan without folder and extension: "000123" for velodyne/000123.bin, and
/// "front_000123" for that of the sensor "front" of a rig.
std::string stem(const Recording& recording, std::size_t i);

/// Reads ground-truth labels in the format of SemanticKITTI. The low 16 bits count: 251-259 are
/// dynamic, 0 and 1 unknown, all others static. Throws InputError.
Labels read_labels(const std::filesystem::path& file);

}  // namespace dynamic_filter::io
