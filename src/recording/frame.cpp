// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "base/input.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/recording.hpp"
#include "formats/clouds/cloud_size.hpp"
#include "recording/bag_scans.hpp"
#include "recording/folders.hpp"
#include "recording/frame.hpp"
#include "recording/layouts/layouts.hpp"

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

Labels truth_of(const Sequence& sequence, std::size_t i, const Cloud& cloud) {
    if (sequence.intensity_is_truth) return intensity_truth(cloud, sequence.scan_files[i]);
    if (sequence.label_files.empty() || sequence.label_files[i].empty()) return {};
    Labels truth = read_labels(sequence.label_files[i]);
    if (truth.size() != cloud.size()) {
        throw InputError(sequence.label_files[i], "",
                         fmt::format("{} labels but {} points in {}", truth.size(), cloud.size(),
                                     sequence.scan_files[i].string()));
    }
    return truth;
}

/// Adds the ground truth. A fault in it does not reject the scan.
void add_truth(Frame& frame, const Sequence& sequence, std::size_t i) {
    try {
        frame.truth = truth_of(sequence, i, frame.cloud);
    } catch (const InputError& error) {
        frame.truth_fault = error.what();
    }
}

/// Times of the points: from the scan if it has them, otherwise computed from the azimuths.
std::vector<float> times_of(const Sequence& sequence, const Frame& frame) {
    std::vector<float> times = point_times(frame.cloud, frame.stamp);
    if (times.empty() && sequence.sweep) times = sweep_times(frame.points, *sequence.sweep);
    return times;
}

void refuse_absurd(const Pose& T_world_sensor, const std::filesystem::path& file) {
    if (!is_absurdly_far(T_world_sensor)) return;
    throw InputError(file, "", "its pose is more than 40,000 km away; expected metres");
}

}  // namespace

bool is_absurdly_far(const Pose& T_world_sensor) {
    constexpr double kEarth = 4e7;  // [m]
    // Not "greater": a coordinate that is no number is absurd, too.
    return !(T_world_sensor.translation().cwiseAbs().maxCoeff() <= kEarth);
}

Points into_sensor(const Cloud& cloud, const Pose& T_world_sensor) {
    const Pose T_sensor_world = T_world_sensor.inverse();
    const std::array<std::vector<double>, 3> world = {values(cloud, *cloud.find("x")),
                                                      values(cloud, *cloud.find("y")),
                                                      values(cloud, *cloud.find("z"))};
    Points points(cloud.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Eigen::Vector3d p(world[0][i], world[1][i], world[2][i]);
        points[i] = (T_sensor_world * p).cast<float>();
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

Cloud read_scan(const Sequence& sequence, std::size_t i) {
    if (sequence.bag) return read_bag_cloud(*sequence.bag, sequence.bag_scans.at(i));
    const std::filesystem::path& file = sequence.scan_files.at(i);
    return is_folder(file) ? read_submap(file) : read_cloud(file);
}

void refuse_unusable(const Sequence& sequence, std::size_t i) {
    const std::filesystem::path& file = sequence.scan_files.at(i);
    if (!sequence.T_world_sensor.empty()) {
        const Pose& T_world_sensor = sequence.T_world_sensor[i];
        if (!T_world_sensor.matrix().allFinite()) {
            throw InputError(file, "",
                             sequence.bag
                                 ? "no pose is known at its time"
                                 : "it has no pose, or one that is not finite (lost tracking?)");
        }
        refuse_absurd(T_world_sensor, file);
    }
    if (!sequence.bag && !is_folder(file)) refuse_bad_size(file);
}

Frame read_frame(const Sequence& sequence, std::size_t i) {
    if (i >= sequence.size()) {
        throw InputError(sequence.root, "",
                         "has " + std::to_string(sequence.size()) + " scans; there is no scan " +
                             std::to_string(i));
    }
    refuse_unusable(sequence, i);
    const std::filesystem::path& file = sequence.scan_files[i];
    Frame frame;
    frame.cloud = read_scan(sequence, i);
    if (frame.cloud.size() == 0) throw InputError(file, "", "has no points");
    frame.has_pose = sequence.has_poses;
    if (!sequence.has_poses) {
        frame.T_world_sensor = Pose::Identity();
    } else if (sequence.T_world_sensor.empty()) {
        frame.T_world_sensor =
            fixed(sequence.pose_fix, frame.cloud.viewpoint.value_or(Pose::Identity()));
        refuse_absurd(frame.T_world_sensor, file);
    } else {
        frame.T_world_sensor = sequence.T_world_sensor[i];
    }
    frame.points = sequence.points_in_world ? into_sensor(frame.cloud, frame.T_world_sensor)
                                            : positions(frame.cloud);
    if (std::none_of(frame.points.begin(), frame.points.end(), is_measured)) {
        throw InputError(file, "", "has no finite point away from the sensor");
    }
    frame.stamp = sequence.stamps[i];
    if (sequence.deskew) {
        undo_motion(frame.points, times_of(sequence, frame), frame.stamp, sequence.trajectory);
    }
    if (sequence.wants_times) {
        frame.times = times_of(sequence, frame);
    }
    if (!sequence.velocities.empty() && !frame.times.empty()) {
        frame.points =
            dynamic_filter::undo_motion(frame.points, frame.times, sequence.velocities[i]);
        frame.times.clear();
    }
    add_truth(frame, sequence, i);
    return frame;
}

}  // namespace dynamic_filter::io
