// SPDX-License-Identifier: MIT
// Recordings that are made of others.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "dynamic_filter/error.hpp"
#include "dynamic_filter/recording.hpp"
#include "formats/poses/rigid.hpp"
#include "recording/recording_parts.hpp"

namespace dynamic_filter::io {
namespace {

template <typename T>
void keep(std::vector<T>& values, const std::vector<std::size_t>& chosen) {
    if (values.empty()) return;
    std::vector<T> kept;
    for (const std::size_t i : chosen) kept.push_back(std::move(values[i]));
    values = std::move(kept);
}

std::vector<std::size_t> chosen_of(std::size_t size, std::size_t first, std::size_t last,
                                   std::size_t stride) {
    std::vector<std::size_t> chosen;
    for (std::size_t i = first; i < size && i <= last; i += stride) {
        chosen.push_back(i);
        if (stride > size) break;  // because i + stride may overflow
    }
    return chosen;
}

void keep_scans(RecordingParts& parts, const std::vector<std::size_t>& chosen) {
    Info& info = parts.info;
    keep(info.scan_files, chosen);
    keep(info.label_files, chosen);
    keep(info.T_world_sensor, chosen);
    keep(info.stamps, chosen);
    keep(info.pose_stamps, chosen);
    keep(info.repeats, chosen);
    keep(parts.velocities, chosen);
    keep(parts.sensors, chosen);
    info.sparse_poses &= std::any_of(info.T_world_sensor.begin(), info.T_world_sensor.end(),
                                     [](const Pose& pose) { return !pose.matrix().allFinite(); });
    parts.read_cloud = [read = std::move(parts.read_cloud), chosen](std::size_t i) {
        return read(chosen.at(i));
    };
    if (!parts.read_truth) return;
    parts.read_truth = [read = std::move(parts.read_truth), chosen](
                           std::size_t i, const Cloud& cloud) { return read(chosen.at(i), cloud); };
}

/// Why the motion within scans cannot be undone; empty if it can.
std::string obstacle_to_deskew(const RecordingParts& parts) {
    const Info& info = parts.info;
    if (info.trajectory.stamps.size() < 2) {
        return "no poses over time: the sensor's motion during each scan is not undone; give poses "
               "with stamps";
    }
    if (info.sweep && parts.rig.empty()) return "";
    // Of several sensors, some may have times: one scan of each tells.
    std::set<std::size_t> asked;
    for (std::size_t i = 0; i < info.stamps.size(); ++i) {
        const bool is_first = asked.insert(parts.sensors.empty() ? 0 : parts.sensors[i]).second;
        if (!is_first) continue;
        if (!point_times(parts.read_cloud(i), info.stamps[i]).empty()) return "";
        if (parts.sensors.empty()) break;
    }
    return "the points have no times of their own (no field t, time, timestamp or offset_time "
           "that varies), which would tell how the sensor moved during each scan";
}

}  // namespace

void check_selection(std::size_t first, std::optional<std::size_t> last, std::size_t stride) {
    if (stride == 0) throw ConfigError("--stride is 0; expected 1 or more");
    if (last && *last < first) {
        throw ConfigError(fmt::format("--last {} is before --first {}", *last, first));
    }
}

void select(RecordingParts& parts, std::size_t first, std::optional<std::size_t> last,
            std::size_t stride) {
    check_selection(first, last, stride);
    const std::size_t size = parts.info.scan_files.size();
    if (first >= size) {
        throw ConfigError(fmt::format("--first {} is beyond the last of {} scans (index {})", first,
                                      size, size - 1));
    }
    const auto chosen = chosen_of(size, first, last.value_or(size - 1), stride);
    if (chosen.size() != size) keep_scans(parts, chosen);
}

Recording chosen_scans(const Recording& recording, const std::vector<std::size_t>& indices) {
    RecordingParts parts = recording.parts();
    keep_scans(parts, indices);
    return Recording(std::move(parts));
}

std::vector<std::filesystem::path> folders_of(const Recording& recording) {
    std::set<std::filesystem::path> folders = {recording.info().root};
    for (const auto& file : recording.info().scan_files) folders.insert(file.parent_path());
    for (const RigSensor& sensor : recording.parts().rig) {
        if (!sensor.recording.empty()) folders.insert(sensor.recording);
    }
    return {folders.begin(), folders.end()};
}

std::vector<Recording> by_sensor(const Recording& recording) {
    const std::vector<std::size_t>& sensors = recording.parts().sensors;
    std::map<std::size_t, std::vector<std::size_t>> scans;
    for (std::size_t i = 0; i < sensors.size(); ++i) scans[sensors[i]].push_back(i);
    if (scans.size() < 2) return {recording};
    std::vector<Recording> each;
    for (const auto& [sensor, indices] : scans) {
        RecordingParts parts = chosen_scans(recording, indices).parts();
        parts.info.trajectory = parts.rig[sensor].trajectory;
        each.emplace_back(std::move(parts));
    }
    return each;
}

Recording slice(const Recording& recording, std::size_t first, std::optional<std::size_t> last,
                std::size_t stride) {
    RecordingParts parts = recording.parts();
    select(parts, first, last, stride);
    return Recording(std::move(parts));
}

Recording with_times(const Recording& recording, std::optional<Sweep> sweep) {
    RecordingParts parts = recording.parts();
    parts.with_times = true;
    if (sweep) parts.info.sweep = sweep;
    return Recording(std::move(parts));
}

// Poses between the scans are needed only if the scans have times of points.
Recording deskewed(const Recording& recording, std::optional<Sweep> sweep) {
    RecordingParts parts = recording.parts();
    Info& info = parts.info;
    if (sweep) info.sweep = sweep;
    // Of times that are shares of the step between stamps, the clock does not matter.
    const bool has_clock = info.measured_stamps || info.sweep;
    if (info.trajectory.stamps.empty() && info.has_poses && has_clock) {
        info.trajectory = {info.stamps, info.T_world_sensor};
        put_in_order(info.trajectory);
    }
    const std::string obstacle = obstacle_to_deskew(parts);
    if (obstacle.empty()) {
        info.deskewed = true;
        parts.with_times = false;
    } else {
        info.notes.push_back(obstacle);
    }
    return Recording(std::move(parts));
}

Recording with_poses(const Recording& recording,
                     const std::vector<std::optional<Tracked>>& tracked) {
    RecordingParts parts = recording.parts();
    Info& info = parts.info;
    info.has_poses = info.tracked = true;
    info.sparse_poses = false;
    for (RigSensor& sensor : parts.rig) sensor.trajectory = {};
    info.T_world_sensor.assign(recording.size(), lost_pose());
    parts.velocities.assign(recording.size(), Twist::Zero());
    for (std::size_t i = 0; i < recording.size(); ++i) {
        if (!tracked[i]) continue;
        info.T_world_sensor[i] = tracked[i]->T_world_sensor;
        parts.velocities[i] = tracked[i]->velocity;
    }
    return Recording(std::move(parts));
}

Recording with_sensor_at(const Recording& recording, const Eigen::Vector3d& at) {
    RecordingParts parts = recording.parts();
    Info& info = parts.info;
    const Eigen::Vector3d move = at - info.sensor_at.value_or(Eigen::Vector3d::Zero());
    info.sensor_at = at;
    if (move.isZero(0.0)) return Recording(std::move(parts));
    for (auto* poses : {&info.T_world_sensor, &info.trajectory.poses}) {
        for (Pose& pose : *poses) pose = pose * Eigen::Translation3d(move);
    }
    for (Twist& velocity : parts.velocities) {
        velocity.head<3>() += velocity.tail<3>().cross(move);
    }
    return Recording(std::move(parts));
}

Recording without_poses(const Recording& recording) {
    RecordingParts parts = recording.parts();
    Info& info = parts.info;
    info.T_world_sensor.clear();
    info.trajectory = {};
    info.has_poses = info.tracked = info.points_in_world = info.deskewed = false;
    info.sparse_poses = false;
    for (RigSensor& sensor : parts.rig) sensor.trajectory = {};
    parts.velocities.clear();
    return Recording(std::move(parts));
}

Recording with_notes(const Recording& recording, const std::vector<std::string>& notes) {
    RecordingParts parts = recording.parts();
    parts.info.notes.insert(parts.info.notes.end(), notes.begin(), notes.end());
    return Recording(std::move(parts));
}

Recording with_losses(const Recording& recording, const std::vector<std::string>& losses) {
    RecordingParts parts = recording.parts();
    parts.info.losses.insert(parts.info.losses.end(), losses.begin(), losses.end());
    return Recording(std::move(parts));
}

}  // namespace dynamic_filter::io
