// SPDX-License-Identifier: MIT
/// @file
/// A recording: scans in order, a pose and a stamp for each scan, and ground truth if there is any.
///
/// - Units: [m]; stamps [s].
/// - Frames: points in the sensor frame, poses T_world_sensor; other conventions are converted.
/// - Shapes: arrays of a Sequence have one entry per scan, those of a Frame one per point.
/// - Ownership: values; copies of a Sequence share its open bag.
/// - Threads: a Sequence is not changed after it is open; functions that take one are thread-safe.
/// - Errors: InputError (with the file and the place in it) and ConfigError.
#pragma once

#include <cstddef>
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

struct BagScans;

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
};

/// What is known of a recording without reading the scans. Not changed after open_sequence();
/// thread-safe.
struct Sequence {
    std::string layout;          ///< name of one of layouts(), as recognised
    std::filesystem::path root;  ///< path that was opened
    /// In the natural order of their names. For a bag, these are no files, but numbers below its
    /// path.
    std::vector<std::filesystem::path> scan_files;
    /// Parallel to scan_files, an empty path if a scan has none; or empty.
    std::vector<std::filesystem::path> label_files;
    /// Parallel to scan_files; empty for `benchmark`, whose scan files hold the poses.
    std::vector<Pose> T_world_sensor;
    /// File of the poses; empty: the files of the scans, the bag, or none.
    std::filesystem::path pose_source;
    bool has_poses = true;       ///< false: poses are not known, and T_world_sensor is empty
    bool wants_times = false;    ///< true: read_frame() returns the times of the points
    std::optional<Sweep> sweep;  ///< used to compute these times if the scans do not hold them
    /// Velocities of the sensor, parallel to scan_files, or empty. If wants_times is set, motion
    /// compensation is done with them, and frames then have no times.
    std::vector<Twist> velocities;
    std::vector<double> stamps;    ///< parallel to scan_files [s]; assumed at 10 Hz if not measured
    bool measured_stamps = false;  ///< true: the stamps come from the recording
    /// All poses of the recording, as dense in time as they are; may be empty.
    Trajectory trajectory;
    bool deskew = false;           ///< as in OpenOptions
    bool points_in_world = false;  ///< as in OpenOptions
    /// For poses in the files of the scans; all other poses are already corrected.
    PoseFix pose_fix = PoseFix::none;
    std::shared_ptr<const BagScans> bag;  ///< only for layout `bag`
    std::vector<std::size_t> bag_scans;   ///< parallel to scan_files: positions in the bag
    bool intensity_is_truth = false;      ///< `benchmark` with ground truth in the intensity
    std::vector<std::string> notes;       ///< assumptions that were made, as sentences for the user
    /// Parts of a bag that cannot be read, so that scans are missing.
    std::vector<std::string> losses;
    /// [s] Stamps of poses that were matched to scans by their order, if both have stamps.
    std::vector<double> pose_stamps;

    /// Number of scans.
    [[nodiscard]] std::size_t size() const { return scan_files.size(); }
    /// True if any scan has ground truth.
    [[nodiscard]] bool has_truth() const { return intensity_is_truth || !label_files.empty(); }
};

/// One scan as read: all fields of the file, and the points in the sensor frame.
struct Frame {
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
};

/// Recognizes the layout, and checks that the numbers of scans, poses and stamps agree. If no poses
/// are found, a note says which files were looked for. Throws InputError (nothing found, different
/// numbers, invalid rotation) and ConfigError (several topics to choose from).
Sequence open_sequence(const std::filesystem::path& data, const OpenOptions& options = {});

/// Switches on motion compensation of each scan with the poses of the recording and the times of
/// the points. If that is not possible, a note says why.
void prepare_deskew(Sequence& sequence);

/// Gives the recording the poses that were estimated or refined, one entry per scan; empty: not
/// known. From then on, motion compensation uses them.
void use_poses(Sequence& sequence, const std::vector<std::optional<Tracked>>& tracked);

/// Reads scan i. Throws InputError if the scan cannot be used (truncated, without points, with a
/// non-finite pose); the caller may then count the scan as rejected and continue. Thread-safe.
Frame read_frame(const Sequence& sequence, std::size_t i);

/// Reason for rejecting a scan whose fields differ from those of the previous scans.
inline constexpr const char* kOtherFields =
    "its fields are not those of the first scan; one map cannot hold both";

/// Throws the exception that read_frame() would throw, as far as the fault shows without reading
/// the points. Thread-safe.
void refuse_unusable(const Sequence& sequence, std::size_t i);

/// Name of a scan without folder and extension: "000123" for velodyne/000123.bin.
std::string stem(const Sequence& sequence, std::size_t i);

/// Reads ground-truth labels in the format of SemanticKITTI. The low 16 bits count: 251-259 are
/// dynamic, 0 and 1 unknown, all others static. Throws InputError.
Labels read_labels(const std::filesystem::path& file);

}  // namespace dynamic_filter::io
