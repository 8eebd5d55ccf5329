// SPDX-License-Identifier: MIT
#include "recording/rig.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <utility>

#include "dynamic_filter/error.hpp"
#include "recording/rig_file.hpp"
#include "recording/rig_poses.hpp"
#include "recording/rig_scans.hpp"

namespace dynamic_filter::io {
namespace {

void refuse_other_options(const std::filesystem::path& file, const OpenOptions& o) {
    const char* const given = !o.topic.empty() || !o.pose_topic.empty() ? "--topic"
                              : !o.layout.empty() && o.layout != "rig"  ? "--format"
                              : o.sensor_at                             ? "--sensor-at"
                              : o.points_in_world                       ? "--points-in-world"
                                                                        : nullptr;
    if (given == nullptr) return;
    throw ConfigError(fmt::format(
        "{} is for the recording of one sensor; what holds for each sensor stands in {}", given,
        file.string()));
}

void refuse_unusable(const RigEntry& entry, const Recording& recording) {
    const Info& info = recording.info();
    const auto fail = [&](const std::string& why) {
        throw InputError(entry.recording, "", fmt::format("sensor '{}': {}", entry.name, why));
    };
    if (!info.measured_stamps) {
        fail(
            "its scans have no stamps, so their order among those of the other sensors is not "
            "known; give times.txt, or bags");
    }
    if (info.points_in_world) {
        fail("its points are in the frame of the world; a rig needs them as the sensor saw them");
    }
    if (!recording.parts().sensors.empty()) {
        fail("its topic has clouds of several sensors; choose one with topic = \"TOPIC@FRAME\"");
    }
    if (info.has_poses && info.T_world_sensor.empty()) {
        fail(
            "its poses stand in the scans themselves; give those of the vehicle, with stamps, in a "
            "file: poses = \"FILE\"");
    }
}

Recording open_sensor(const RigEntry& entry, const OpenOptions& options, bool with_poses) {
    OpenOptions how;
    how.without_poses = !with_poses;
    how.topic = entry.topic;
    how.pose_fix = with_poses ? options.pose_fix : PoseFix::none;
    how.time_unit = options.time_unit;
    if (!entry.field.empty()) how.sensor_at = Eigen::Vector3d::Zero();
    try {
        Recording recording = open_recording(entry.recording, how);
        refuse_unusable(entry, recording);
        return recording;
    } catch (const ConfigError& error) {
        std::string why = error.what();
        for (auto at = why.find("--topic"); at != why.npos; at = why.find("--topic")) {
            why.replace(at, 7, "topic = in the rig file");
        }
        throw InputError(entry.recording, "", fmt::format("sensor '{}': {}", entry.name, why));
    }
}

std::vector<double> stamps_of(const RigEntry& entry, const Recording& recording) {
    std::vector<double> stamps = recording.info().stamps;
    for (double& stamp : stamps) stamp += entry.clock;
    return stamps;
}

/// Throws InputError if a sensor has no scan while the others have: their clocks differ, or they
/// are of different drives.
void refuse_apart(const std::vector<RigEntry>& entries,
                  const std::vector<std::vector<double>>& stamps) {
    for (std::size_t s = 1; s < stamps.size(); ++s) {
        const bool meet =
            stamps[s].front() <= stamps[0].back() && stamps[0].front() <= stamps[s].back();
        if (meet) continue;
        throw InputError(
            entries[s].recording, "",
            fmt::format("sensor '{}': its scans are from {:.3f} to {:.3f} s, those of '{}' from "
                        "{:.3f} to {:.3f} s; give scans of one drive and of one clock (clock = "
                        "SECONDS in the rig file is added to the stamps)",
                        entries[s].name, stamps[s].front(), stamps[s].back(), entries[0].name,
                        stamps[0].front(), stamps[0].back()));
    }
}

std::vector<OneOf> in_order(const std::vector<std::vector<double>>& stamps) {
    std::vector<OneOf> scans;
    for (std::size_t s = 0; s < stamps.size(); ++s) {
        for (std::size_t i = 0; i < stamps[s].size(); ++i) scans.push_back({s, i});
    }
    std::stable_sort(scans.begin(), scans.end(), [&](const OneOf& a, const OneOf& b) {
        return stamps[a.sensor][a.scan] < stamps[b.sensor][b.scan];
    });
    return scans;
}

void require_places(const RigFile& rig, const std::filesystem::path& file) {
    for (const RigEntry& entry : rig.sensors) {
        if (entry.T_vehicle_sensor) continue;
        throw InputError(file, "",
                         fmt::format("sensor '{}' has no place; expected at = [x, y, z] in metres, "
                                     "and turn = [roll, pitch, yaw] in degrees if it is turned",
                                     entry.name));
    }
}

/// From the frame whose poses the recording has to that of the sensor: clouds of several sensors
/// are merged in the frame of the vehicle.
Pose T_posed_sensor(const RigEntry& entry) {
    return entry.field.empty() ? Pose::Identity() : *entry.T_vehicle_sensor;
}

/// Sets the poses of all scans, if there are any.
void assign_poses(RecordingParts& parts, const Rig& rig,
                  const std::vector<std::vector<double>>& stamps,
                  std::optional<Trajectory> vehicle) {
    Info& info = parts.info;
    const auto has_poses = [](const Recording& r) { return r.info().has_poses; };
    const bool all = std::all_of(rig.recordings.begin(), rig.recordings.end(), has_poses);
    const auto first = std::find_if(rig.recordings.begin(), rig.recordings.end(), has_poses);
    if (!vehicle && !all && first != rig.recordings.end()) {
        const auto s = static_cast<std::size_t>(first - rig.recordings.begin());
        const RigEntry& entry = rig.file.sensors[s];
        require_places(rig.file, info.root);
        vehicle = moved_by(known_poses(first->info(), entry.clock),
                           T_posed_sensor(entry) * entry.T_vehicle_sensor->inverse());
        info.pose_source = first->info().pose_source;
        info.notes.push_back(fmt::format(
            "the poses are those of sensor '{}'; the other sensors have none, and are where the "
            "rig file says",
            entry.name));
    }
    info.has_poses = vehicle || all;
    if (!info.has_poses) return require_places(rig.file, info.root);
    if (vehicle) require_places(rig.file, info.root);
    std::vector<std::vector<Pose>> poses;
    for (std::size_t s = 0; s < rig.recordings.size(); ++s) {
        const Info& own = rig.recordings[s].info();
        const RigEntry& entry = rig.file.sensors[s];
        Trajectory& trajectory = parts.rig[s].trajectory;
        if (vehicle) {
            trajectory = moved_by(*vehicle, *entry.T_vehicle_sensor);
            poses.push_back(poses_near(trajectory, stamps[s]));
            continue;
        }
        const Pose T = T_posed_sensor(entry);
        trajectory = moved_by(known_poses(own, entry.clock), T);
        std::vector<Pose>& of_scans = poses.emplace_back(own.T_world_sensor);
        for (Pose& pose : of_scans) pose = pose * T;
    }
    for (const auto& [sensor, scan] : rig.scans) {
        info.T_world_sensor.push_back(poses[sensor][scan]);
    }
    info.trajectory = parts.rig.front().trajectory;
    const auto is_known = [](const Pose& pose) { return pose.matrix().allFinite(); };
    const auto known =
        std::count_if(info.T_world_sensor.begin(), info.T_world_sensor.end(), is_known);
    if (2 * known < std::ssize(info.T_world_sensor)) {
        throw InputError(
            info.pose_source.empty() ? info.root : info.pose_source, "",
            fmt::format("its poses are near in time to {} of {} scans only; a rig needs poses at "
                        "least as often as scans, of the same clock",
                        known, info.T_world_sensor.size()));
    }
}

void add_named(std::vector<std::string>& all, const std::vector<std::string>& more,
               const std::string& name) {
    for (const std::string& text : more) all.push_back(fmt::format("{}: {}", name, text));
}

/// Files, stamps, notes and ground truth of all scans.
void gather(Info& info, const Rig& rig, const std::vector<std::vector<double>>& stamps) {
    bool has_truth = false, repeats = false;
    for (std::size_t s = 0; s < rig.recordings.size(); ++s) {
        const Info& own = rig.recordings[s].info();
        add_named(info.notes, own.notes, rig.file.sensors[s].name);
        add_named(info.losses, own.losses, rig.file.sensors[s].name);
        has_truth |= !own.label_files.empty();
        repeats |= !own.repeats.empty();
    }
    for (const auto& [sensor, scan] : rig.scans) {
        const Info& own = rig.recordings[sensor].info();
        info.scan_files.push_back(own.scan_files[scan]);
        info.stamps.push_back(stamps[sensor][scan]);
        if (has_truth) {
            info.label_files.push_back(own.label_files.empty() ? "" : own.label_files[scan]);
        }
        if (repeats) info.repeats.push_back(own.repeats.empty() ? 0 : own.repeats[scan]);
    }
    info.measured_stamps = true;
}

/// Labels are named by the scans.
void refuse_equal_names(const RecordingParts& parts) {
    std::set<std::string> names;
    for (std::size_t i = 0; i < parts.sensors.size(); ++i) {
        const std::string name = name_of_scan(parts, i);
        if (names.insert(name).second) continue;
        throw InputError(parts.info.root, "",
                         fmt::format("two scans would have the name {}; choose other names for the "
                                     "sensors",
                                     name));
    }
}

}  // namespace

RecordingParts open_rig(const std::filesystem::path& file, const OpenOptions& options) {
    refuse_other_options(file, options);
    const auto rig = std::make_shared<Rig>();
    rig->file = read_rig_file(file);
    const auto pose_file = options.poses ? options.poses : rig->file.poses;
    const bool with_own_poses = !options.without_poses && !pose_file;
    std::vector<std::vector<double>> stamps;
    RecordingParts parts;
    for (const RigEntry& entry : rig->file.sensors) {
        rig->recordings.push_back(open_sensor(entry, options, with_own_poses));
        stamps.push_back(stamps_of(entry, rig->recordings.back()));
        parts.rig.push_back({.name = entry.name,
                             .T_vehicle_sensor = entry.T_vehicle_sensor,
                             .clock = entry.clock,
                             .recording = entry.recording});
    }
    refuse_apart(rig->file.sensors, stamps);
    rig->scans = in_order(stamps);
    Info& info = parts.info;
    info.layout = "rig";
    info.root = file;
    gather(info, *rig, stamps);
    rig->fields = fields_of(*rig, info.notes);
    std::optional<Trajectory> vehicle;
    if (pose_file && !options.without_poses) {
        vehicle = read_vehicle_poses(*pose_file, options.pose_fix, info.stamps, info.notes);
        info.pose_source = *pose_file;
    }
    assign_poses(parts, *rig, stamps, std::move(vehicle));
    std::map<std::filesystem::path, std::size_t> at;  // which sensor made the file
    for (std::size_t i = 0; i < rig->scans.size(); ++i) {
        parts.sensors.push_back(rig->scans[i].sensor);
        at.emplace(info.scan_files[i], rig->scans[i].sensor);
    }
    refuse_equal_names(parts);
    if (!options.own_body.empty()) require_places(rig->file, file);
    parts.read_cloud = [rig, unit = options.point_unit](std::size_t i) {
        return read_cloud_of(*rig, rig->scans.at(i), unit);
    };
    parts.read_truth = [rig](std::size_t i, const Cloud& cloud) {
        return read_truth_of(*rig, rig->scans.at(i), cloud);
    };
    parts.refuse_bad_size = [rig, at = std::move(at)](const std::filesystem::path& scan) {
        const Recording& recording = rig->recordings[at.at(scan)];
        const bool is_file =
            recording.info().layout != "bag" && !std::filesystem::is_directory(scan);
        if (is_file && recording.parts().refuse_bad_size) recording.parts().refuse_bad_size(scan);
    };
    return parts;
}

}  // namespace dynamic_filter::io
