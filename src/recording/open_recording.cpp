// SPDX-License-Identifier: MIT
#include "dynamic_filter/recording.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <utility>

#include "dynamic_filter/error.hpp"
#include "dynamic_filter/poses.hpp"
#include "formats/poses/rigid.hpp"
#include "recording/bag_scans.hpp"
#include "recording/benchmark.hpp"
#include "recording/layout.hpp"
#include "recording/layouts/registry.hpp"
#include "recording/matching.hpp"
#include "recording/recording_parts.hpp"
#include "recording/repeats.hpp"
#include "recording/rig.hpp"
#include "recording/rig_file.hpp"
#include "recording/times_in_names.hpp"

namespace dynamic_filter::io {
namespace {

constexpr double assumed_period = 0.1;  // [s] the usual setting of LiDARs

/// The unit of the numbers that are stamps, if it is given.
std::optional<double> unit_of(const OpenOptions& options) {
    return options.time_unit == 1.0 ? std::nullopt : std::optional(options.time_unit);
}

std::vector<double> times_of(const Layout& layout) {
    if (!layout.times) return {};
    std::vector<double> times = read_times(*layout.times);
    if (const auto rows = rows_in_names(layout.scans, times.size()); !rows.empty()) {
        std::vector<double> of_scans;
        for (const std::size_t row : rows) of_scans.push_back(times[row]);
        times = std::move(of_scans);
    }
    if (times.size() != layout.scans.size()) {
        throw InputError(*layout.times, "",
                         fmt::format("{} times but {} scans in {}", times.size(),
                                     layout.scans.size(), layout.scan_folder.string()));
    }
    const auto back = std::is_sorted_until(times.begin(), times.end());
    if (back != times.end()) {
        const auto i = static_cast<std::size_t>(back - times.begin());
        throw InputError(
            *layout.times, "",
            fmt::format("time {} of scan {} is before {} of the scan before it; stamps "
                        "must not go back",
                        times[i], i, times[i - 1]));
    }
    return times;
}

/// Converts KITTI rows, which are poses of the left camera if there is a calibration. Files with
/// stamps (TUM, CSV) come from other sources, and contain poses of the LiDAR.
void from_camera_poses(Info& info, const std::filesystem::path& calib) {
    const Pose Tr = read_calib_tr(calib);
    for (Pose& pose : info.T_world_sensor) pose = Tr.inverse() * pose * Tr;
    info.notes.push_back("poses taken as camera poses and converted with Tr of " + calib.string());
}

/// Assigns the poses. Returns the stamps, if the recording has any.
std::vector<double> assign_poses(Info& info, const Layout& layout, std::optional<double> unit) {
    info.pose_source = layout.poses.value_or(layout.pose_source);
    const bool has_own = !layout.T_world_sensor.empty() && !layout.poses_in_scans;
    std::vector<double> times =
        has_own || !layout.stamps.empty() ? layout.stamps : times_of(layout);
    for (double& time : times) time *= unit.value_or(1.0);
    info.T_world_sensor = layout.T_world_sensor;
    if (has_own) return times;
    if (!layout.poses) return times.empty() ? growing_times_in_names(layout.scans, unit) : times;
    const PoseFile file = read_pose_file(*layout.poses, info.pose_fix);
    info.notes.insert(info.notes.end(), file.notes.begin(), file.notes.end());
    Match match = match_poses(layout, file, times, unit);
    info.T_world_sensor = std::move(match.poses);
    info.notes.push_back(match.note);
    info.pose_stamps = std::move(match.pose_stamps);
    info.trajectory = std::move(match.trajectory);
    info.sparse_poses = match.are_sparse;
    if (match.are_sparse) info.notes.push_back(match.sparse_note);
    if (layout.calib && file.stamps.empty()) {
        if (info.pose_fix == PoseFix::lidar) {
            info.pose_fix = PoseFix::none;
        } else {
            from_camera_poses(info, *layout.calib);
        }
    }
    return match.stamps;
}

void assign_stamps(Info& info, std::vector<double> stamps) {
    const bool constant =
        stamps.size() > 1 &&
        std::adjacent_find(stamps.begin(), stamps.end(), std::not_equal_to<>()) == stamps.end();
    info.measured_stamps = !stamps.empty() && !constant;
    info.stamps = std::move(stamps);
    if (info.measured_stamps) {
        const auto back = std::is_sorted_until(info.stamps.begin(), info.stamps.end());
        if (back == info.stamps.end()) return;
        const auto i = static_cast<std::size_t>(back - info.stamps.begin());
        throw InputError(info.scan_files[i], "", "its time is before that of the scan before");
    }
    info.notes.push_back(constant ? "all stamps are equal; 10 Hz assumed"
                                  : "no stamps found; 10 Hz assumed");
    info.stamps.resize(info.scan_files.size());
    for (std::size_t i = 0; i < info.scan_files.size(); ++i) {
        info.stamps[i] = static_cast<double>(i) * assumed_period;
    }
}

RecordingParts open_folder(const std::filesystem::path& data, const OpenOptions& options) {
    if (!options.topic.empty() || !options.pose_topic.empty()) {
        throw ConfigError("--topic and --pose-topic are for bags; " + data.string() + " is none");
    }
    const Layout layout = find_layout(data, options);
    Info info;
    info.layout = layout.name;
    info.pose_fix = options.pose_fix;
    info.root = data;
    info.scan_files = layout.scans;
    info.notes = layout.notes;
    info.points_in_world = layout.points_in_world;
    info.label_files = layout.read_truth ? layout.truth_files : find_labels(layout, info.notes);
    info.repeats = repeats_among(layout.scans);
    assign_stamps(info, assign_poses(info, layout, unit_of(options)));
    if (options.without_poses) {
        info.T_world_sensor.clear();
        info.trajectory = {};
        info.sparse_poses = false;
    }
    info.has_poses =
        !options.without_poses && (layout.poses_in_scans || !info.T_world_sensor.empty());
    if (layout.poses_in_scans && info.has_poses) require_viewpoints(info);
    RecordingParts parts{.info = std::move(info),
                         .read_cloud = [files = layout.scans, read = layout.read](
                                           std::size_t i) { return read(files.at(i)); },
                         .refuse_bad_size = layout.refuse_bad_size,
                         .read_truth = layout.read_truth};
    select(parts, options.first, options.last, options.stride);
    if (layout.truth_in_intensity) find_intensity_truth(parts.info, layout);
    return parts;
}

RecordingParts open_selected_bag(const std::filesystem::path& data, const OpenOptions& options) {
    RecordingParts parts = open_bag(data, options);
    for (auto* stamps : {&parts.info.stamps, &parts.info.trajectory.stamps}) {
        for (double& stamp : *stamps) stamp *= options.time_unit;
    }
    select(parts, options.first, options.last, options.stride);
    return parts;
}

/// A stride is that of each sensor, so that none of them is left out.
RecordingParts open_selected_rig(const std::filesystem::path& file, const OpenOptions& options) {
    if (!is_rig_file(file)) throw not_of_layout(file, layout_row("rig"));
    RecordingParts parts = open_rig(file, options);
    select(parts, options.first, options.last, 1);
    if (options.stride == 1) return parts;
    std::vector<std::size_t> seen(parts.rig.size()), chosen;
    for (std::size_t i = 0; i < parts.sensors.size(); ++i) {
        if (seen[parts.sensors[i]]++ % options.stride == 0) chosen.push_back(i);
    }
    return chosen_scans(Recording(std::move(parts)), chosen).parts();
}

void apply_fix(Info& info) {
    if (info.pose_fix == PoseFix::relative) {  // and no file of motions was read
        throw ConfigError(
            "--pose-fix relative joins the motions of a pose file with one row for each scan, and "
            "the poses of this recording are not from such a file");
    }
    for (auto* poses : {&info.T_world_sensor, &info.trajectory.poses}) {
        for (Pose& pose : *poses) pose = fixed(info.pose_fix, pose);
    }
}

/// Throws if points are in the world frame but there are no poses, because the position of the
/// sensor is then not known.
void refuse_world_frame(const Info& info, const std::filesystem::path& data) {
    if (!info.points_in_world) return;
    throw InputError(data, "",
                     "its points are in the world's frame, so poses are needed to tell what each "
                     "scan saw; give them with --poses");
}

bool is_rig(const std::filesystem::path& data, const OpenOptions& options) {
    if (!options.layout.empty()) return layout_row(options.layout).turn == Turn::rig;
    return is_rig_file(data);
}

bool is_bag(const std::filesystem::path& data, const OpenOptions& options) {
    if (!options.layout.empty()) return layout_row(options.layout).turn == Turn::bag;
    return Bag::recognises(data) && !has_scans(data);
}

}  // namespace

Recording open_recording(const std::filesystem::path& data, const OpenOptions& options) {
    check_selection(options.first, options.last, options.stride);
    RecordingParts parts = is_rig(data, options)   ? open_selected_rig(data, options)
                           : is_bag(data, options) ? open_selected_bag(data, options)
                                                   : open_folder(data, options);
    Info& info = parts.info;
    if (options.points_in_world) info.points_in_world = true;
    info.point_unit = options.point_unit;
    info.own_body = options.own_body;
    if (!info.has_poses) refuse_world_frame(info, data);
    if (parts.rig.empty()) apply_fix(info);
    const auto at = options.sensor_at ? options.sensor_at : std::exchange(info.sensor_at, {});
    const Recording opened(std::move(parts));
    const Recording recording = at ? with_sensor_at(opened, *at) : opened;
    const bool deskew = options.deskew && recording.info().has_poses;
    return deskew ? deskewed(recording) : recording;
}

}  // namespace dynamic_filter::io
