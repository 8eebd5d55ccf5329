// SPDX-License-Identifier: MIT
#include "dynamic_filter/recording.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "dynamic_filter/error.hpp"
#include "dynamic_filter/poses.hpp"
#include "formats/poses/rigid.hpp"
#include "recording/bag_scans.hpp"
#include "recording/benchmark.hpp"
#include "recording/frame.hpp"
#include "recording/layout.hpp"
#include "recording/layouts/registry.hpp"
#include "recording/matching.hpp"

namespace dynamic_filter::io {
namespace {

constexpr double assumed_period = 0.1;  // [s] the usual setting of LiDARs

void check_selection(const OpenOptions& options) {
    if (options.stride == 0) throw ConfigError("--stride is 0; expected 1 or more");
    if (options.last && *options.last < options.first) {
        throw ConfigError(
            fmt::format("--last {} is before --first {}", *options.last, options.first));
    }
}

std::vector<double> times_of(const Layout& layout) {
    if (!layout.times) return {};
    std::vector<double> times = read_times(*layout.times);
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
void from_camera_poses(Sequence& sequence, const std::filesystem::path& calib) {
    const Pose Tr = read_calib_tr(calib);
    for (Pose& pose : sequence.T_world_sensor) pose = Tr.inverse() * pose * Tr;
    sequence.notes.push_back("poses taken as camera poses and converted with Tr of " +
                             calib.string());
}

/// Assigns the poses. Returns the stamps, if the recording has any.
std::vector<double> assign_poses(Sequence& sequence, const Layout& layout) {
    sequence.pose_source = layout.poses.value_or(layout.pose_source);
    if (!layout.T_world_sensor.empty()) {
        sequence.T_world_sensor = layout.T_world_sensor;
        return layout.stamps;
    }
    std::vector<double> times = layout.stamps.empty() ? times_of(layout) : layout.stamps;
    if (!layout.poses) return times.empty() ? growing_times_in_names(layout.scans) : times;
    const PoseFile file = read_poses(*layout.poses);
    Match match = match_poses(layout, file, times);
    sequence.T_world_sensor = std::move(match.poses);
    sequence.notes.push_back(match.note);
    sequence.pose_stamps = std::move(match.pose_stamps);
    if (layout.calib && file.stamps.empty()) {
        if (sequence.pose_fix == PoseFix::lidar) {
            sequence.pose_fix = PoseFix::none;
        } else {
            from_camera_poses(sequence, *layout.calib);
        }
    }
    return match.stamps;
}

void assign_stamps(Sequence& sequence, std::vector<double> stamps) {
    const bool constant =
        stamps.size() > 1 &&
        std::adjacent_find(stamps.begin(), stamps.end(), std::not_equal_to<>()) == stamps.end();
    sequence.measured_stamps = !stamps.empty() && !constant;
    sequence.stamps = std::move(stamps);
    if (sequence.measured_stamps) {
        const auto back = std::is_sorted_until(sequence.stamps.begin(), sequence.stamps.end());
        if (back == sequence.stamps.end()) return;
        const auto i = static_cast<std::size_t>(back - sequence.stamps.begin());
        throw InputError(sequence.scan_files[i], "", "its time is before that of the scan before");
    }
    sequence.notes.push_back(constant ? "all stamps are equal; 10 Hz assumed"
                                      : "no stamps found; 10 Hz assumed");
    sequence.stamps.resize(sequence.size());
    for (std::size_t i = 0; i < sequence.size(); ++i) {
        sequence.stamps[i] = static_cast<double>(i) * assumed_period;
    }
}

template <typename T>
void keep(std::vector<T>& values, std::size_t first, std::size_t last, std::size_t stride) {
    std::vector<T> kept;
    for (std::size_t i = first; i < values.size() && i <= last; i += stride) {
        kept.push_back(values[i]);
        if (stride > values.size()) break;  // because i + stride may overflow
    }
    values = std::move(kept);
}

void select(Sequence& sequence, const OpenOptions& options) {
    if (options.first >= sequence.size()) {
        throw ConfigError(fmt::format("--first {} is beyond the last of {} scans (index {})",
                                      options.first, sequence.size(), sequence.size() - 1));
    }
    const std::size_t last = options.last.value_or(sequence.size() - 1);
    keep(sequence.scan_files, options.first, last, options.stride);
    keep(sequence.label_files, options.first, last, options.stride);
    keep(sequence.T_world_sensor, options.first, last, options.stride);
    keep(sequence.stamps, options.first, last, options.stride);
    keep(sequence.pose_stamps, options.first, last, options.stride);
    keep(sequence.bag_scans, options.first, last, options.stride);
}

Sequence open_folder(const std::filesystem::path& data, const OpenOptions& options) {
    if (!options.topic.empty() || !options.pose_topic.empty()) {
        throw ConfigError("--topic and --pose-topic are for bags; " + data.string() + " is none");
    }
    const Layout layout = find_layout(data, options);
    Sequence sequence;
    sequence.layout = layout.name;
    sequence.pose_fix = options.pose_fix;
    sequence.root = data;
    sequence.scan_files = layout.scans;
    sequence.notes = layout.notes;
    sequence.points_in_world = layout.points_in_world;
    sequence.label_files = find_labels(layout, sequence.notes);
    assign_stamps(sequence, assign_poses(sequence, layout));
    if (options.without_poses) sequence.T_world_sensor.clear();
    sequence.has_poses =
        !options.without_poses && (layout.poses_in_scans || !sequence.T_world_sensor.empty());
    if (layout.poses_in_scans && sequence.has_poses) require_viewpoints(sequence);
    select(sequence, options);
    if (layout.truth_in_intensity) find_intensity_truth(sequence, layout);
    return sequence;
}

void apply_fixes(Sequence& sequence, const OpenOptions& options) {
    for (auto* poses : {&sequence.T_world_sensor, &sequence.trajectory.poses}) {
        for (Pose& pose : *poses) pose = fixed(sequence.pose_fix, pose);
    }
    if (!sequence.measured_stamps) return;
    std::vector<double>& of_poses = sequence.pose_stamps;
    const auto span = [](const std::vector<double>& s) { return s.back() - s.front(); };
    const double unit = options.time_unit;
    // Stamps of poses matched by order may be in seconds although those of the scans are not.
    if (!of_poses.empty() && std::abs(span(of_poses) - span(sequence.stamps)) <
                                 std::abs(span(of_poses) - unit * span(sequence.stamps))) {
        for (double& stamp : of_poses) stamp *= unit;
    }
    for (auto* stamps : {&sequence.stamps, &sequence.trajectory.stamps}) {
        for (double& stamp : *stamps) stamp *= unit;
    }
}

/// Throws if points are in the world frame but there are no poses, because the position of the
/// sensor is then not known.
void refuse_world_frame(const Sequence& sequence, const std::filesystem::path& data) {
    if (!sequence.points_in_world) return;
    throw InputError(data, "",
                     "its points are in the world's frame, so poses are needed to tell what each "
                     "scan saw; give them with --poses");
}

bool is_bag(const std::filesystem::path& data, const OpenOptions& options) {
    if (!options.layout.empty()) return layout_row(options.layout).turn == Turn::bag;
    return Bag::recognises(data) && !has_scans(data);
}

}  // namespace

Sequence open_sequence(const std::filesystem::path& data, const OpenOptions& options) {
    check_selection(options);
    Sequence sequence;
    if (is_bag(data, options)) {
        sequence = open_bag(data, options);
        sequence.pose_fix = options.pose_fix;
        select(sequence, options);
    } else {
        sequence = open_folder(data, options);
    }
    if (options.points_in_world) sequence.points_in_world = true;
    if (!sequence.has_poses) refuse_world_frame(sequence, data);
    apply_fixes(sequence, options);
    if (options.deskew && sequence.has_poses) prepare_deskew(sequence);
    return sequence;
}

// Poses between the scans are needed only if the scans have times of points.
void prepare_deskew(Sequence& sequence) {
    if (sequence.trajectory.stamps.empty() && sequence.measured_stamps) {
        sequence.trajectory = {sequence.stamps, sequence.T_world_sensor};
        put_in_order(sequence.trajectory);
    }
    if (sequence.trajectory.stamps.size() < 2) {
        sequence.notes.push_back(
            "no poses over time: the sensor's motion during each scan is not undone; give poses "
            "with stamps");
        return;
    }
    const Cloud first = read_scan(sequence, 0);
    if (!sequence.sweep && point_times(first, sequence.stamps.front()).empty()) {
        sequence.notes.push_back(
            "the points have no times of their own (no field t, time, timestamp or offset_time "
            "that varies): the sensor's motion during each scan is not undone");
        return;
    }
    sequence.deskew = true;
}

void use_poses(Sequence& sequence, const std::vector<std::optional<Tracked>>& tracked) {
    sequence.has_poses = true;
    sequence.T_world_sensor.assign(sequence.size(), lost_pose());
    sequence.velocities.assign(sequence.size(), Twist::Zero());
    for (std::size_t i = 0; i < sequence.size(); ++i) {
        if (!tracked[i]) continue;
        sequence.T_world_sensor[i] = tracked[i]->T_world_sensor;
        sequence.velocities[i] = tracked[i]->velocity;
    }
}

std::string stem(const Sequence& sequence, std::size_t i) {
    return sequence.scan_files.at(i).stem().string();
}

}  // namespace dynamic_filter::io
