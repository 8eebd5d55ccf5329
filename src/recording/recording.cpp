// SPDX-License-Identifier: MIT
#include "dynamic_filter/recording.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "base/input.hpp"
#include "dynamic_filter/error.hpp"
#include "formats/clouds/cloud_size.hpp"
#include "geometry/no_returns.hpp"
#include "recording/folders.hpp"
#include "recording/mask.hpp"
#include "recording/recording_parts.hpp"

namespace dynamic_filter::io {
namespace {

/// Label of a SemanticKITTI value: the low 16 bits hold the class, the high bits the instance.
Label label_of(std::uint32_t raw) {
    const std::uint32_t kind = raw & 0xFFFFU;
    if (kind <= 1) return Label::unknown;
    return kind >= 251 && kind <= 259 ? Label::dynamic : Label::static_;
}

Labels intensity_truth(const Cloud& cloud, const std::filesystem::path& file) {
    const Field* intensity = cloud.find("intensity");
    if (intensity == nullptr)
        throw InputError(file, "", "has no intensity, which must hold the ground truth");
    Labels truth;
    truth.reserve(cloud.size());
    for (const double value : values(cloud, *intensity)) {
        truth.push_back(value == 1.0   ? Label::dynamic
                        : value == 0.0 ? Label::static_
                                       : Label::unknown);
    }
    return truth;
}

Labels truth_of(const RecordingParts& parts, std::size_t i, const Cloud& cloud) {
    const Info& info = parts.info;
    if (info.intensity_is_truth) return intensity_truth(cloud, info.scan_files[i]);
    if (info.label_files.empty() || info.label_files[i].empty()) return {};
    Labels truth = parts.read_truth ? parts.read_truth(i, cloud) : read_labels(info.label_files[i]);
    if (truth.size() != cloud.size()) {
        throw InputError(info.label_files[i], "",
                         fmt::format("{} labels but {} points in {}", truth.size(), cloud.size(),
                                     info.scan_files[i].string()));
    }
    return truth;
}

/// Adds the ground truth. A fault in it does not reject the scan.
void add_truth(FullScan& scan, const RecordingParts& parts, std::size_t i) {
    try {
        scan.truth = truth_of(parts, i, scan.cloud);
    } catch (const InputError& error) {
        scan.truth_fault = error.what();
    }
}

/// Times of the points: from the scan if it has them, otherwise computed from the azimuths, but not
/// if sensors take turns.
std::vector<float> times_of(const Info& info, const FullScan& scan, bool takes_turns) {
    std::vector<float> times = point_times(scan.cloud, scan.stamp);
    if (!info.sweep) return times;
    if (times.empty() && takes_turns) return {};  // a guess would be that of another sensor
    if (times.empty()) return sweep_times(scan.points, *info.sweep);
    for (float& time : times) time += static_cast<float>(info.sweep->shift);
    return times;
}

void refuse_absurd(const Pose& T_world_sensor, const std::filesystem::path& file) {
    if (!is_absurdly_far(T_world_sensor)) return;
    throw InputError(file, "", "its pose is more than 40,000 km away; expected metres");
}

bool is_of_bag(const Info& info) { return info.layout == "bag"; }

/// Throws InputError if the pose of scan i cannot be used.
void check_pose(const Info& info, std::size_t i) {
    if (info.T_world_sensor.empty()) return;
    const Pose& T_world_sensor = info.T_world_sensor[i];
    if (!T_world_sensor.matrix().allFinite()) {
        throw InputError(info.scan_files[i], "",
                         is_of_bag(info)
                             ? "no pose is known at its time"
                             : "it has no pose, or one that is not finite (lost tracking?)");
    }
    refuse_absurd(T_world_sensor, info.scan_files[i]);
}

void refuse_repeat(const Info& info, std::size_t i) {
    if (info.repeats.empty() || info.repeats[i] == 0) return;
    throw InputError(info.scan_files[i], "",
                     "repeats the scan before it byte for byte: nothing new came from the sensor");
}

/// T_body_sensor: the boxes of the own body are in the frame of a vehicle with several sensors.
Pose frame_of_body(const RecordingParts& parts, std::size_t i) {
    if (parts.sensors.empty()) return Pose::Identity();
    return parts.rig[parts.sensors[i]].T_vehicle_sensor.value_or(Pose::Identity());
}

/// Poses and points: those of the file in the sensor frame.
void place(FullScan& scan, const RecordingParts& parts, std::size_t i) {
    const Info& info = parts.info;
    scan.has_pose = info.has_poses;
    const Eigen::Vector3d at = info.sensor_at.value_or(Eigen::Vector3d::Zero());
    if (info.has_poses && info.T_world_sensor.empty()) {
        scan.T_world_sensor =
            fixed(info.pose_fix, scan.cloud.viewpoint.value_or(Pose::Identity())) *
            Eigen::Translation3d(at);
        refuse_absurd(scan.T_world_sensor, info.scan_files[i]);
    } else if (info.has_poses) {
        scan.T_world_sensor = info.T_world_sensor[i];
    }
    scan.points = info.points_in_world
                      ? into_sensor(scan.cloud, info.point_unit, scan.T_world_sensor)
                      : seen_from(at, in_metres(positions(scan.cloud), info));
    scan.no_returns = drop_no_returns(scan.points);
    scan.own = take_out(info.own_body, frame_of_body(parts, i), scan.points);
    if (std::none_of(scan.points.begin(), scan.points.end(), is_measured)) {
        throw InputError(info.scan_files[i], "", "has no finite point away from the sensor");
    }
}

void treat_motion(FullScan& scan, const RecordingParts& parts, std::size_t i) {
    const Info& info = parts.info;
    const bool takes_turns = !parts.rig.empty();
    if (info.deskewed) {
        const Trajectory& trajectory =
            parts.sensors.empty() ? info.trajectory : parts.rig[parts.sensors[i]].trajectory;
        undo_motion(scan.points, times_of(info, scan, takes_turns), scan.stamp, trajectory);
    }
    if (parts.with_times) scan.times = times_of(info, scan, takes_turns);
    if (parts.velocities.empty() || scan.times.empty()) return;
    scan.points = dynamic_filter::undo_motion(scan.points, scan.times, parts.velocities[i]);
    scan.times.clear();
}

}  // namespace

bool is_absurdly_far(const Pose& T_world_sensor) {
    constexpr double kEarth = 4e7;  // [m]
    // Not "greater": a coordinate that is no number is absurd, too.
    return !(T_world_sensor.translation().cwiseAbs().maxCoeff() <= kEarth);
}

Points seen_from(const Eigen::Vector3d& at, Points points) {
    constexpr float kNoReturn = 0.05F;  // [m] no sensor measures as near
    const Point shift = at.cast<float>();
    if (shift.isZero(0.0F)) return points;
    for (Point& p : points) {
        p -= shift;
        if (p.squaredNorm() < kNoReturn * kNoReturn) p.setZero();
    }
    return points;
}

Points in_metres(Points points, const Info& info) {
    if (info.point_unit == 1.0) return points;
    for (Point& p : points) p *= static_cast<float>(info.point_unit);
    return points;
}

Points into_sensor(const Cloud& cloud, double unit, const Pose& T_world_sensor) {
    const Pose T_sensor_world = T_world_sensor.inverse();
    const std::array<std::vector<double>, 3> world = {values(cloud, *cloud.find("x")),
                                                      values(cloud, *cloud.find("y")),
                                                      values(cloud, *cloud.find("z"))};
    Points points(cloud.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Eigen::Vector3d p(world[0][i], world[1][i], world[2][i]);
        points[i] = (T_sensor_world * (unit * p)).cast<float>();
    }
    return points;
}

Labels read_labels(const std::filesystem::path& file) {
    const std::vector<std::byte> bytes = read_bytes(file);
    if (bytes.size() % sizeof(std::uint32_t) != 0) {
        throw InputError(
            file, fmt::format("byte {}", bytes.size() - bytes.size() % 4),
            fmt::format("its size of {} bytes is no multiple of 4 (uint32 labels)", bytes.size()));
    }
    Labels labels(bytes.size() / sizeof(std::uint32_t));
    for (std::size_t i = 0; i < labels.size(); ++i) {
        std::uint32_t raw = 0;
        std::memcpy(&raw, bytes.data() + i * sizeof raw, sizeof raw);
        labels[i] = label_of(raw);
    }
    return labels;
}

Recording::Recording() : Recording(Info{}) {}

Recording::Recording(Info info) {
    const auto files = info.scan_files;
    const auto read = [files](std::size_t i) { return io::read_cloud(files.at(i)); };
    parts_ = std::make_shared<const RecordingParts>(RecordingParts{
        .info = std::move(info), .read_cloud = read, .refuse_bad_size = [](const auto& file) {
            io::refuse_bad_size(file);
        }});
}

Recording::Recording(RecordingParts parts)
    : parts_(std::make_shared<const RecordingParts>(std::move(parts))) {}

std::size_t Recording::size() const { return info().scan_files.size(); }

const Info& Recording::info() const { return parts_->info; }

void Recording::check(std::size_t i) const {
    const std::filesystem::path& file = info().scan_files.at(i);
    check_pose(info(), i);
    refuse_repeat(info(), i);
    if (parts_->refuse_bad_size && !is_of_bag(info()) && !is_folder(file)) {
        parts_->refuse_bad_size(file);
    }
}

FullScan Recording::read(std::size_t i) const {
    if (i >= size()) {
        throw InputError(
            info().root, "",
            "has " + std::to_string(size()) + " scans; there is no scan " + std::to_string(i));
    }
    refuse_repeat(info(), i);
    FullScan scan;
    scan.cloud = parts_->read_cloud(i);
    if (scan.cloud.size() == 0) throw InputError(info().scan_files[i], "", "has no points");
    check_pose(info(), i);  // a scan that cannot be read has no pose by odometry either
    scan.stamp = info().stamps[i];
    if (!parts_->sensors.empty()) {
        scan.sensor = parts_->sensors[i];
        scan.sensor_name = parts_->rig[scan.sensor].name;
    }
    place(scan, *parts_, i);
    treat_motion(scan, *parts_, i);
    add_truth(scan, *parts_, i);
    return scan;
}

std::string name_of_scan(const RecordingParts& parts, std::size_t i) {
    const std::string name = parts.info.scan_files.at(i).stem().string();
    if (parts.sensors.empty() || parts.rig[parts.sensors[i]].name.empty()) return name;
    return parts.rig[parts.sensors[i]].name + "_" + name;
}

std::size_t sensor_of(const Recording& recording, std::size_t i) {
    const std::vector<std::size_t>& sensors = recording.parts().sensors;
    return sensors.empty() ? 0 : sensors[i];
}

std::string stem(const Recording& recording, std::size_t i) {
    return name_of_scan(recording.parts(), i);
}

}  // namespace dynamic_filter::io
