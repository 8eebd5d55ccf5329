// SPDX-License-Identifier: MIT
/// @file
/// A recording: scans in order, a pose and a stamp for each, ground truth where there is any.
///
/// - Units: [m]; stamps [s].
/// - Frames: points in the sensor's, poses T_world_sensor; what comes otherwise is converted.
/// - Shapes: arrays of a Sequence have an entry a scan, those of a Frame one a point.
/// - Ownership: values; a Sequence shares its open bag with its copies.
/// - Threads: a Sequence is not changed once open; functions that take one are thread-safe.
/// - Errors: InputError (which file, where in it) and ConfigError.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dynamic_filter/io/cloud.hpp"
#include "dynamic_filter/io/pose_fix.hpp"
#include "dynamic_filter/io/trajectory.hpp"
#include "dynamic_filter/odometry/odometry.hpp"
#include "dynamic_filter/odometry/sweep_times.hpp"
#include "dynamic_filter/types.hpp"

namespace dynamic_filter::io {

/// The layouts that are told apart; docs/formats.md.
enum class Format { kitti, benchmark, folder, bag };

std::string to_string(Format format);  ///< "kitti", "benchmark", "folder", "bag"

struct BagScans;

/// How to read a recording, where looking at it does not say.
struct OpenOptions {
    std::optional<Format> format;                ///< empty: recognised by looking at the folder
    std::optional<std::filesystem::path> poses;  ///< empty: the format's usual place
    bool without_poses = false;                  ///< leave the recording's poses alone
    std::size_t first = 0;                       ///< index of the first scan used
    std::optional<std::size_t> last;             ///< index of the last scan used; empty: the end
    std::size_t stride = 1;                      ///< every so many scans
    std::string topic;                           ///< of a bag's scans; empty: the only one
    std::string pose_topic;  ///< of a bag's poses, or "/tf"; empty: chosen, and a note says how
    bool deskew = false;     ///< undo the sensor's motion during each scan
    PoseFix pose_fix = PoseFix::none;  ///< what is put right of the poses
    bool points_in_world = false;      ///< scans are in the poses' frame, not in the sensor's
    double time_unit = 1.0;            ///< [s] of the stamps of scans and poses
};

/// What is known without reading the scans. Immutable after open_sequence; thread-safe.
struct Sequence {
    Format format = Format::folder;                  ///< as recognised or forced
    std::filesystem::path root;                      ///< what was opened
    std::vector<std::filesystem::path> scan_files;   ///< in natural order of their names; of a bag
                                                     ///< not files, but numbers below its path
    std::vector<std::filesystem::path> label_files;  ///< parallel to scan_files (empty path: none),
                                                     ///< or empty
    std::vector<Pose> T_world_sensor;  ///< parallel; empty for `benchmark` (poses are in the files)
    std::filesystem::path pose_source;  ///< what they were read from; empty: the scans' own files,
                                        ///< the bag, or nothing
    bool has_poses = true;              ///< false: nobody knows them, and T_world_sensor is empty
    bool wants_times = false;           ///< frames get the times of their points
    std::optional<Sweep> sweep;         ///< from which those times follow if scans do not hold them
    /// Parallel, or empty: how the sensor moved. If the sequence wants_times, the motion during
    /// each scan is undone with it, and frames have no times any more.
    std::vector<Twist> velocities;
    std::vector<double> stamps;    ///< parallel [s]; made up at 10 Hz where not measured
    bool measured_stamps = false;  ///< they come from the recording
    Trajectory trajectory;  ///< poses as dense in time as the recording has them; may be empty
    bool deskew = false;    ///< as asked for
    bool points_in_world = false;         ///< as asked for
    PoseFix pose_fix = PoseFix::none;     ///< of the poses in the scans' files; all others have it
    std::shared_ptr<const BagScans> bag;  ///< of format `bag`
    std::vector<std::size_t> bag_scans;   ///< parallel to scan_files: places in it
    bool intensity_is_truth = false;      ///< `benchmark` with ground truth in the intensity
    std::vector<std::string> notes;       ///< for the user: what was assumed
    std::vector<std::string> losses;      ///< what of a bag cannot be read: scans are missing
    std::vector<double> pose_stamps;      ///< [s] of poses matched by order, where both have stamps

    /// How many scans there are.
    [[nodiscard]] std::size_t size() const { return scan_files.size(); }
    /// Whether there is ground truth of any.
    [[nodiscard]] bool has_truth() const { return intensity_is_truth || !label_files.empty(); }
};

/// One scan as read: the record's own fields, and the points in the sensor frame.
struct Frame {
    Cloud cloud;    ///< as in the file (`benchmark`: x y z in the world frame)
    Points points;  ///< sensor frame, same order, their motion undone if that was asked for
    Pose T_world_sensor = Pose::Identity();  ///< at `stamp`
    bool has_pose = true;                    ///< false: T_world_sensor means nothing
    double stamp = 0.0;                      ///< [s]
    std::vector<float> times;  ///< [s] of the points from `stamp`; empty: unknown, or not wanted
    Labels truth;              ///< empty without ground truth; otherwise one per point
    std::string truth_fault;   ///< why this scan's truth cannot be used; the scan itself can
};

/// Recognises the layout, checks that scans, poses and stamps agree in number. Where no poses are
/// found, a note says what was looked for.
/// Throws InputError (nothing there, counts that differ, bad rotation) and
/// ConfigError (topics to choose from).
Sequence open_sequence(const std::filesystem::path& data, const OpenOptions& options = {});

/// From now on, the motion during each scan is undone by the recording's poses and the times of the
/// points. A note says why if that cannot be done.
void prepare_deskew(Sequence& sequence);

/// Gives the recording poses that were found or refined, a scan each; empty: not known. The scans'
/// motion is undone accordingly from now on.
void use_poses(Sequence& sequence, const std::vector<std::optional<Tracked>>& tracked);

/// Reads scan i. Throws InputError if the scan cannot be used (truncated, no points, a non-finite
/// pose): the caller may count it as rejected and go on. Thread-safe.
Frame read_frame(const Sequence& sequence, std::size_t i);

/// Why a scan is rejected whose fields are not those of the scans before it.
inline constexpr const char* kOtherFields =
    "its fields are not those of the first scan; one map cannot hold both";

/// Throws what read_frame would, as far as that shows without reading the points. Thread-safe.
void refuse_unusable(const Sequence& sequence, std::size_t i);

/// "000123" for velodyne/000123.bin.
std::string stem(const Sequence& sequence, std::size_t i);

/// Ground-truth labels as SemanticKITTI writes them: low 16 bits; 251-259 dynamic, 0 and 1 unknown,
/// everything else static. Throws InputError.
Labels read_labels(const std::filesystem::path& file);

/// "a2" before "a10".
bool natural_less(const std::string& a, const std::string& b);

}  // namespace dynamic_filter::io
