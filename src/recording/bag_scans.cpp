// SPDX-License-Identifier: MIT
#include "recording/bag_scans.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <functional>
#include <map>

#include "dynamic_filter/error.hpp"
#include "dynamic_filter/poses.hpp"
#include "formats/byte_reader.hpp"
#include "formats/messages/messages.hpp"
#include "formats/messages/packets.hpp"
#include "formats/poses/rigid.hpp"
#include "recording/bag_contents.hpp"
#include "recording/matching.hpp"
#include "recording/pose_source.hpp"
#include "recording/poses_at_scans.hpp"

namespace dynamic_filter::io {
namespace {

template <class Topics>
std::string topic_names(const Topics& topics) {
    std::string names;
    for (const auto& [name, topic] : topics) names += (names.empty() ? "" : ", ") + name;
    return names;
}

/// True for output topics of `convert`, which repeat the scans of another topic or of all topics.
bool is_part_of_another(const std::string& name, const std::map<std::string, CloudTopic>& clouds) {
    if (name == "/static_map" && clouds.size() > 1) return true;
    for (const std::string_view part : {"_static", "_dynamic"}) {
        if (name.ends_with(part) && clouds.contains(name.substr(0, name.size() - part.size()))) {
            return true;
        }
    }
    return false;
}

/// Text such as "; /velodyne_packets is velodyne_msgs/VelodyneScan..." for topics with raw packets
/// that a driver must decode first, and with clouds of types that are not read.
std::string tell_packets(const BagContents& contents) {
    std::string told;
    for (const auto& [name, type] : contents.packets) {
        told += fmt::format(
            "; {} holds raw packets ({}): play the bag to the driver's node {} and record the "
            "sensor_msgs/PointCloud2 that it publishes",
            name, type, driver_of(type));
    }
    for (const auto& [name, type] : contents.other_clouds)
        told +=
            fmt::format("; {} holds {}, which is not read: {}", name, type, advice_on_cloud(type));
    return told;
}

const CloudTopic& choose_clouds(const BagContents& contents, const std::filesystem::path& data,
                                const OpenOptions& options) {
    const auto& clouds = contents.clouds;
    if (!options.topic.empty()) {
        const auto found = clouds.find(options.topic);
        if (found != clouds.end()) return found->second;
        throw ConfigError(fmt::format("no point clouds on topic {}; there are: {}{}", options.topic,
                                      clouds.empty() ? "none" : topic_names(clouds),
                                      tell_packets(contents)));
    }
    if (clouds.empty()) {
        const auto& known = contents.losses.empty() ? contents.notes : contents.losses;
        const std::string why = known.empty() ? "" : " (" + known.front() + ")";
        throw InputError(data, "",
                         "holds no point clouds (sensor_msgs/PointCloud2 or Livox's CustomMsg)" +
                             why + tell_packets(contents));
    }
    std::vector<const CloudTopic*> whole;
    for (const auto& [name, topic] : clouds) {
        if (!is_part_of_another(name, clouds)) whole.push_back(&topic);
    }
    if (whole.size() > 1) {
        std::string names;
        for (const auto& [name, topic] : clouds) {
            names +=
                fmt::format("{}{} ({} scans)", names.empty() ? "" : ", ", name, topic.scans.size());
        }
        throw ConfigError("point clouds on several topics: " + names + "; choose one with --topic");
    }
    return *whole.front();
}

/// Orders scans by the stamps of their headers, or by the time of recording if the driver left the
/// stamps at zero.
std::vector<FoundScan> in_order(CloudTopic topic, std::vector<std::string>& notes) {
    const bool unset = std::all_of(topic.scans.begin(), topic.scans.end(),
                                   [](const FoundScan& s) { return s.stamp == 0.0; });
    if (unset) {
        for (FoundScan& scan : topic.scans)
            scan.stamp = 1e-9 * static_cast<double>(scan.recorded_ns);
        notes.push_back("headers have no stamps; the times of recording are used");
    }
    std::stable_sort(topic.scans.begin(), topic.scans.end(),
                     [](const FoundScan& a, const FoundScan& b) { return a.stamp < b.stamp; });
    return std::move(topic.scans);
}

/// Chooses the source of the poses. If there are none, returns nothing, and a note says why.
std::optional<PoseSource> choose_poses(const BagContents& contents, const CloudTopic& clouds,
                                       const OpenOptions& options, const LinkLookup& lookup,
                                       std::vector<std::string>& notes) {
    if (options.without_poses) return std::nullopt;
    const FrameTree& frames = contents.frames;
    const bool by_frames = frames.moves(clouds.frame);
    const auto named = contents.poses.find(options.pose_topic);
    const auto source = [&](const auto& topic) {
        return from_topic(topic.first, topic.second, frames, clouds.frame, lookup);
    };
    if (!options.pose_topic.empty()) {
        if (options.pose_topic == "/tf" && by_frames) {
            return from_frames(frames, clouds.frame, {}, lookup);
        }
        if (named != contents.poses.end()) return source(*named);
        std::string known = topic_names(contents.poses);
        if (by_frames) known += (known.empty() ? "" : ", ") + std::string("/tf");
        throw ConfigError(fmt::format("no poses on topic {}; there are: {}", options.pose_topic,
                                      known.empty() ? "none" : known));
    }
    if (by_frames) return from_frames(frames, clouds.frame, {}, lookup);
    if (contents.poses.empty()) {
        notes.push_back(
            fmt::format("no poses of the frame '{}' found; looked for /tf that leads to it, "
                        "nav_msgs/Odometry, geometry_msgs/PoseStamped",
                        clouds.frame));
        return std::nullopt;
    }
    PoseSource first = source(*contents.poses.begin());
    if (contents.poses.size() > 1) {
        first.note +=
            fmt::format(" (of {}; choose with --pose-topic)", topic_names(contents.poses));
    }
    return first;
}

void assign_at_scans(Info& info, const std::function<std::optional<Pose>(double)>& known) {
    PosesAtScans found = poses_at_scans(info.stamps, info.trajectory, known);
    info.T_world_sensor = std::move(found.T_world_sensor);
    info.sparse_poses = found.are_sparse;
    if (found.are_sparse) info.notes.push_back(found.note);
}

/// Assigns poses from a file: interpolated if it has stamps, otherwise one row per scan.
void assign_file_poses(Info& info, const std::filesystem::path& file) {
    PoseFile poses = read_poses(file);
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

void assign_poses(Info& info, const PoseSource& source) {
    info.trajectory = trajectory_of(source);
    assign_at_scans(info, source.T_world_sensor);
    info.notes.push_back(source.note);
}

/// True for the names that drivers give to the frames of their LiDARs.
bool names_lidar(std::string frame) {
    std::transform(frame.begin(), frame.end(), frame.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    constexpr std::array<std::string_view, 9> kNames = {"lidar",  "laser",     "velodyne",
                                                        "ouster", "os_sensor", "hesai",
                                                        "pandar", "livox",     "robosense"};
    return std::any_of(kNames.begin(), kNames.end(), [&](std::string_view name) {
        return frame.find(name) != std::string::npos;
    });
}

/// Clouds in the frame of a vehicle are seen from its LiDAR, if /tf_static has a single one. A
/// frame that has another one of these names below it is a housing.
void find_sensor(Info& info, const FrameTree& frames, const std::string& of_clouds) {
    if (names_lidar(of_clouds)) return;
    std::vector<std::string> lidars = frames.fixed_below(of_clouds);
    std::erase_if(lidars, [](const std::string& frame) { return !names_lidar(frame); });
    const std::vector<std::string> named = lidars;
    std::erase_if(lidars, [&](const std::string& frame) {
        return std::any_of(named.begin(), named.end(), [&](const std::string& other) {
            const auto chain = frames.above(other);
            return other != frame && std::find(chain.begin(), chain.end(), frame) != chain.end();
        });
    });
    if (lidars.size() != 1) return;
    const auto pose = frames.pose(lidars.front(), of_clouds, info.stamps.front());
    if (!pose) return;
    info.sensor_at = pose->translation();
    info.notes.push_back(fmt::format(
        "points in the frame '{}' are seen from '{}', which is at ({:.2f}, {:.2f}, {:.2f}) m by "
        "/tf_static; --sensor-at 0,0,0 takes its origin",
        of_clouds, lidars.front(), info.sensor_at->x(), info.sensor_at->y(), info.sensor_at->z()));
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

}  // namespace

RecordingParts open_bag(const std::filesystem::path& data, const OpenOptions& options) {
    auto scans = std::make_shared<BagScans>(BagScans{Bag(data), {}, {}});
    const BagContents contents = contents_of(scans->bag);
    const CloudTopic& clouds = choose_clouds(contents, data, options);
    Info info;
    info.layout = "bag";
    info.root = data;
    info.notes = contents.notes;
    info.losses = contents.losses;
    if (scans->bag.files().size() > 1) {
        info.notes.push_back(fmt::format(
            "{} bags are read as parts of one recording; if they are not, give one of them",
            scans->bag.files().size()));
    }
    info.notes.push_back("scans from " + clouds.topic.name);
    for (const FoundScan& scan : in_order(clouds, info.notes)) {
        info.stamps.push_back(scan.stamp);
        scans->messages.push_back(scan.ref);
    }
    info.measured_stamps = true;
    scans->topic = clouds.topic;
    const LinkLookup lookup{.gap = limits_for(info.stamps).apart, .holds = true};
    if (options.poses) {
        assign_file_poses(info, *options.poses);
    } else if (const auto source = choose_poses(contents, clouds, options, lookup, info.notes)) {
        assign_poses(info, *source);
        info.points_in_world = source->points_in_world;
    }
    if (!options.sensor_at) find_sensor(info, contents.frames, clouds.frame);
    info.has_poses = !info.T_world_sensor.empty();
    if (info.has_poses) refuse_if_all_lost(info, data);
    const std::size_t digits =
        std::max<std::size_t>(6, fmt::format("{}", scans->messages.size()).size());
    for (std::size_t i = 0; i < scans->messages.size(); ++i) {
        info.scan_files.push_back(data / fmt::format("{:0{}}", i, digits));
    }
    return {.info = std::move(info),
            .read_cloud = [scans](std::size_t i) { return read_bag_cloud(*scans, i); }};
}

Cloud read_bag_cloud(const BagScans& scans, std::size_t i) {
    const MessageRef& message = scans.messages.at(i);
    const auto data = scans.bag.read(message);
    try {
        return read_cloud_message(data, scans.topic).cloud;
    } catch (const Malformed& error) {
        throw InputError(scans.bag.files().at(message.file),
                         fmt::format("scan {} of {}", i, scans.topic.name), error.what());
    }
}

}  // namespace dynamic_filter::io
