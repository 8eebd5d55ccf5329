// SPDX-License-Identifier: MIT
#include "recording/bag_scans.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <memory>

#include "dynamic_filter/error.hpp"
#include "dynamic_filter/poses.hpp"
#include "formats/byte_reader.hpp"
#include "formats/messages/messages.hpp"
#include "recording/bag_clouds.hpp"
#include "recording/bag_contents.hpp"
#include "recording/bag_poses.hpp"
#include "recording/matching.hpp"
#include "recording/poses_at_scans.hpp"

namespace dynamic_filter::io {
namespace {

void assign_at_scans(Info& info, const std::function<std::optional<Pose>(double)>& known) {
    PosesAtScans found = poses_at_scans(info.stamps, info.trajectory, known);
    info.T_world_sensor = std::move(found.T_world_sensor);
    info.sparse_poses = found.are_sparse;
    if (found.are_sparse) info.notes.push_back(found.note);
}

/// Assigns poses from a file: interpolated if it has stamps, otherwise one row per scan.
void assign_file_poses(Info& info, const std::filesystem::path& file) {
    PoseFile poses = read_pose_file(file, info.pose_fix);
    info.pose_source = file;
    info.notes.insert(info.notes.end(), poses.notes.begin(), poses.notes.end());
    if (poses.stamps.empty()) {
        if (poses.poses.size() != info.stamps.size()) {
            throw InputError(file, "",
                             fmt::format("{} poses without stamps for {} scans; give one pose per "
                                         "scan, or poses with stamps (TUM)",
                                         poses.poses.size(), info.stamps.size()));
        }
        info.T_world_sensor = std::move(poses.poses);
        info.trajectory = {info.stamps, info.T_world_sensor};
        info.notes.push_back("poses matched to the scans by their order");
        return;
    }
    const double unit = unit_between(poses.stamps, info.stamps);
    for (double& stamp : poses.stamps) stamp *= unit;
    info.trajectory = {std::move(poses.stamps), std::move(poses.poses)};
    put_in_order(info.trajectory);
    const double gap = limits_for(info.stamps).apart;
    assign_at_scans(info, [&](double stamp) { return pose_at(info.trajectory, stamp, gap, 0.2); });
    info.notes.push_back("poses interpolated at the scans' stamps, from " + file.string());
}

/// Clouds in the frame of a vehicle are seen from its LiDAR, if /tf_static has a single one.
void find_sensor(Info& info, const FrameTree& frames, const std::string& of_clouds) {
    if (names_lidar(of_clouds)) return;
    const auto lidar = only_lidar(frames, frames.fixed_below(of_clouds));
    if (!lidar) return;
    const auto pose = frames.pose(*lidar, of_clouds, info.stamps.front());
    if (!pose) return;
    info.sensor_at = pose->translation();
    info.notes.push_back(fmt::format(
        "points in the frame '{}' are seen from '{}', which is at ({:.2f}, {:.2f}, {:.2f}) m by "
        "/tf_static; --sensor-at 0,0,0 takes its origin",
        of_clouds, *lidar, info.sensor_at->x(), info.sensor_at->y(), info.sensor_at->z()));
}

void refuse_if_all_lost(const Info& info, const std::filesystem::path& data) {
    const bool all_lost = std::all_of(info.T_world_sensor.begin(), info.T_world_sensor.end(),
                                      [](const Pose& pose) { return !pose.matrix().allFinite(); });
    if (!all_lost) return;
    const auto& of = info.trajectory.stamps;
    throw InputError(
        data, "",
        fmt::format("no scan has a pose: scans are from {:.3f} to {:.3f} s, poses {}; are the "
                    "poses of another recording, of another clock, or in another unit of time?",
                    info.stamps.front(), info.stamps.back(),
                    of.empty() ? "at no time"
                               : fmt::format("from {:.3f} to {:.3f} s", of.front(), of.back())));
}

Cloud read_message(const Bag& bag, const MessageRef& message, const Topic& topic, std::size_t i) {
    const auto data = bag.read(message);
    try {
        return read_cloud_message(data, topic).cloud;
    } catch (const Malformed& error) {
        throw InputError(bag.files().at(message.file), fmt::format("scan {} of {}", i, topic.name),
                         error.what());
    }
}

/// The poses of each of several sensors, whose frames /tf or a topic leads to.
struct SeveralSensors {
    std::vector<std::size_t> sensors;      // by scan
    std::vector<Pose> T_world_sensor;      // by scan
    std::vector<Trajectory> trajectories;  // by sensor
    std::vector<std::string> notes;
};

/// Empty if the poses of a frame are not known for all scans, or not certain.
std::optional<SeveralSensors> poses_of_several(const BagContents& contents, const BagClouds& clouds,
                                               const OpenOptions& options, const Bag& bag) {
    SeveralSensors several;
    several.sensors.resize(clouds.scans.size());
    several.T_world_sensor.resize(clouds.scans.size());
    for (std::size_t sensor = 0; sensor < clouds.frames.size(); ++sensor) {
        std::vector<std::size_t> scans;
        std::vector<double> stamps;
        for (std::size_t i = 0; i < clouds.scans.size(); ++i) {
            if (clouds.scans[i].frame != clouds.frames[sensor]) continue;
            scans.push_back(i);
            stamps.push_back(clouds.scans[i].stamp);
        }
        const auto read = [&](std::size_t i) {
            return read_message(bag, clouds.scans[scans[i]].ref, clouds.topic, i);
        };
        BagPoses poses =
            choose_poses(contents, clouds.frames[sensor], stamps, options.pose_topic, read);
        const bool is_certain = poses.T_world_sensor && poses.notes.size() == 1;
        if (!is_certain || poses.points_in_world || !poses.is_linked) return std::nullopt;
        const PosesAtScans found = poses_at_scans(stamps, poses.trajectory, poses.T_world_sensor);
        if (found.are_sparse) return std::nullopt;
        for (std::size_t k = 0; k < scans.size(); ++k) {
            several.sensors[scans[k]] = sensor;
            several.T_world_sensor[scans[k]] = found.T_world_sensor[k];
        }
        several.trajectories.push_back(std::move(poses.trajectory));
        several.notes.insert(several.notes.end(), poses.notes.begin(), poses.notes.end());
    }
    several.notes.push_back(
        fmt::format("the clouds are those of {} sensors, which take turns: each scan has the pose "
                    "of its own sensor; --topic {}@{} reads those of one",
                    clouds.frames.size(), clouds.topic.name, clouds.frames.front()));
    return several;
}

/// Corrections that a user gives are those of one sensor.
bool may_have_several(const OpenOptions& options) {
    return !options.poses && !options.without_poses && !options.sensor_at &&
           options.pose_fix == PoseFix::none && options.time_unit == 1.0 &&
           !options.points_in_world;
}

void add(std::vector<std::string>& all, const std::vector<std::string>& more) {
    all.insert(all.end(), more.begin(), more.end());
}

void find_poses(Info& info, const BagContents& contents, const std::string& frame,
                const OpenOptions& options, const std::function<Cloud(std::size_t)>& read) {
    if (options.poses) return assign_file_poses(info, *options.poses);
    if (options.without_poses) return;
    BagPoses poses = choose_poses(contents, frame, info.stamps, options.pose_topic, read);
    add(info.notes, poses.notes);
    info.points_in_world = poses.points_in_world;
    if (!poses.T_world_sensor) return;
    info.trajectory = std::move(poses.trajectory);
    assign_at_scans(info, poses.T_world_sensor);
}

}  // namespace

RecordingParts open_bag(const std::filesystem::path& data, const OpenOptions& options) {
    auto scans = std::make_shared<BagScans>(BagScans{Bag(data), {}, {}});
    const BagContents contents = contents_of(scans->bag);
    Info info;
    info.layout = "bag";
    info.pose_fix = options.pose_fix;
    info.root = data;
    info.notes = contents.notes;
    info.losses = contents.losses;
    if (scans->bag.files().size() > 1) {
        info.notes.push_back(fmt::format(
            "{} bags are read as parts of one recording; if they are not, give one of them",
            scans->bag.files().size()));
    }
    BagClouds clouds = choose_clouds(scans->bag, contents, data, options.topic);
    std::optional<SeveralSensors> several;
    if (clouds.frames.size() > 1 && may_have_several(options)) {
        several = poses_of_several(contents, clouds, options, scans->bag);
    }
    if (!several) keep_first_frame(clouds);
    const std::string& frame = clouds.frames.front();
    add(info.notes, clouds.notes);
    add(info.losses, clouds.losses);
    for (const FoundScan& scan : clouds.scans) {
        info.stamps.push_back(scan.stamp);
        scans->messages.push_back(scan.ref);
    }
    info.repeats = clouds.repeats;
    info.measured_stamps = true;
    scans->topic = clouds.topic;
    if (several) {
        add(info.notes, several->notes);
        info.T_world_sensor = std::move(several->T_world_sensor);
        info.trajectory = several->trajectories.front();
    } else {
        find_poses(info, contents, frame, options,
                   [&](std::size_t i) { return read_bag_cloud(*scans, i); });
        if (!options.sensor_at && !info.points_in_world) find_sensor(info, contents.frames, frame);
    }
    info.has_poses = !info.T_world_sensor.empty();
    if (info.has_poses) refuse_if_all_lost(info, data);
    const std::size_t digits =
        std::max<std::size_t>(6, fmt::format("{}", scans->messages.size()).size());
    for (std::size_t i = 0; i < scans->messages.size(); ++i) {
        info.scan_files.push_back(data / fmt::format("{:0{}}", i, digits));
    }
    RecordingParts parts{.info = std::move(info), .read_cloud = [scans](std::size_t i) {
                             return read_bag_cloud(*scans, i);
                         }};
    if (several) {
        parts.sensors = std::move(several->sensors);
        for (Trajectory& trajectory : several->trajectories) {
            parts.rig.push_back({.trajectory = std::move(trajectory)});
        }
    }
    return parts;
}

Cloud read_bag_cloud(const BagScans& scans, std::size_t i) {
    return read_message(scans.bag, scans.messages.at(i), scans.topic, i);
}

}  // namespace dynamic_filter::io
