// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "base/exit_code.hpp"
#include "base/say.hpp"
#include "commands/all.hpp"
#include "commands/shared_options.hpp"
#include "dynamic_filter/bag.hpp"
#include "dynamic_filter/cloud.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/recording.hpp"
#include "formats/voxel_map/map_index.hpp"
#include "recording/rig_file.hpp"
#include "recording/scans.hpp"

namespace dynamic_filter::app {

namespace {

constexpr const char* kTypeNames[] = {"int8",   "uint8", "int16",  "uint16",  "int32",
                                      "uint32", "int64", "uint64", "float32", "float64"};

/// Four digits say how small values are spread. Of large ones, such as coordinates of a map or
/// stamps, they would say nothing.
std::string readable(double value) {
    constexpr double kLarge = 1e3, kEndless = 1e12;
    const double size = std::abs(value);
    if (size < kLarge || size > kEndless) return fmt::format("{:.4g}", value);
    return fmt::format("{:.{}f}", value, value == std::floor(value) ? 0 : 2);
}

void describe_cloud(const std::filesystem::path& name, const io::Cloud& cloud) {
    say("{}\n  points  {}\n", name.string(), cloud.size());
    for (const io::Field& field : cloud.fields) {
        double low = INFINITY, high = -INFINITY;
        std::size_t finite = 0;
        for (const double value : io::values(cloud, field)) {
            if (!std::isfinite(value)) continue;
            ++finite;
            low = std::min(low, value);
            high = std::max(high, value);
        }
        say("  {:<10} {:<8}", field.name, kTypeNames[static_cast<std::size_t>(field.type)]);
        if (field.count > 1) say(" x{}", field.count);
        if (finite > 0) say(" {} .. {}", readable(low), readable(high));
        if (finite < cloud.size()) say(" ({} not finite)", cloud.size() - finite);
        say("\n");
    }
    if (cloud.viewpoint) {
        const Eigen::Vector3d t = cloud.viewpoint->translation();
        say("  viewpoint {:.3f} {:.3f} {:.3f}\n", t.x(), t.y(), t.z());
    }
}

/// From one pose that is known to the next.
double path_of(const std::vector<Pose>& poses) {
    double length = 0.0;
    const Pose* last = nullptr;
    for (const Pose& pose : poses) {
        if (!pose.matrix().allFinite()) continue;
        if (last != nullptr) length += (pose.translation() - last->translation()).norm();
        last = &pose;
    }
    return length;
}

void describe_poses(const io::Recording& s) {
    if (!s.info().has_poses) {
        say("  poses   none: the odometry finds them\n");
        return;
    }
    const std::vector<Pose>& poses = s.info().T_world_sensor;
    if (poses.empty()) {
        say("  poses   in the scans' files (VIEWPOINT)\n");
        return;
    }
    const auto known = std::count_if(poses.begin(), poses.end(),
                                     [](const Pose& p) { return p.matrix().allFinite(); });
    say("  poses   of {} scans{}\n  path    {:.1f} m\n",
        static_cast<std::size_t>(known) == s.size() ? "all" : fmt::format("{} of the", known),
        s.info().pose_source.empty() ? "" : ", from " + s.info().pose_source.string(),
        path_of(poses));
}

/// What a run would use of it.
void describe_scans(const io::Recording& s) {
    say("  scans   {}\n", s.size());
    if (s.size() > 1) {
        say("  stamps  {:.3f} .. {:.3f} s{}\n", s.info().stamps.front(), s.info().stamps.back(),
            s.info().measured_stamps ? "" : " (made up at 10 Hz)");
    }
    describe_poses(s);
    say("  truth   {}\n", s.info().has_truth() ? "yes" : "none");
    for (const std::string& note : s.info().notes) say("  note    {}\n", note);
}

/// The first scan that can be read stands for all, whether it has a pose or not.
void describe_first(const io::Recording& recording) {
    constexpr std::size_t kTried = 5;
    const io::Recording s = io::without_poses(recording);
    for (std::size_t i = 0; i < std::min(s.size(), kTried); ++i) {
        try {
            describe_cloud(s.info().scan_files[i], s.read(i).cloud);
            return;
        } catch (const InputError& error) {
            say("  note    {}\n", error.what());
        }
    }
}

void describe_recording(const DataOptions& of) {
    const io::Recording s = open(of);
    say("{}\n  format  {}\n", of.data.string(), s.info().layout);
    describe_scans(s);
    describe_first(s);
}

/// Its topics are told before: several of clouds, or none, are no mistake here.
void describe_scans_of_bag(const DataOptions& of) {
    try {
        const io::Recording s = open(of);
        describe_scans(s);
        describe_first(s);
    } catch (const Error& error) {
        say("  note    {}\n", error.what());
    }
}

void describe_bag(const std::filesystem::path& path) {
    struct Count {
        io::Topic topic;
        std::size_t messages = 0;
    };
    std::map<std::string, Count> topics;
    std::int64_t first = INT64_MAX, last = INT64_MIN;
    const io::Bag bag(path);
    const auto defects = bag.for_each([&](const io::Message& message) {
        Count& count = topics[message.topic.name];
        count.topic = message.topic;
        ++count.messages;
        first = std::min(first, message.recorded_ns);
        last = std::max(last, message.recorded_ns);
    });
    say("{}\n  format  bag\n", path.string());
    if (!topics.empty()) {
        say("  length  {:.1f} s\n", 1e-9 * static_cast<double>(last - first));
    }
    for (const auto& [name, count] : topics) {
        say("  {:<28} {:<40} {:>7} messages\n", name, count.topic.type, count.messages);
    }
    for (const io::Defect& defect : defects) {
        say("  {}    {}\n", defect.lost ? "LOST" : "note", defect.what);
    }
}

/// The map of several drives.
void describe_map(const std::filesystem::path& path) {
    const MapIndex index = read_map_index(map_folder_of(path));
    std::map<int, std::size_t> levels;
    std::uint64_t voxels = 0;
    Eigen::AlignedBox3d box;
    for (const MapTile& tile : index.tiles) {
        ++levels[tile.level];
        voxels += tile.voxels;
        if (tile.voxels > 0) box.extend(tile.min).extend(tile.max);
    }
    say("{}\n  format  map of several drives, version {}\n  tiles   {}\n", path.string(),
        index.version, index.tiles.size());
    const bool is_whole = !index.tiles.empty() && index.tiles.front().is_whole;
    if (is_whole) levels.clear();  // it has no side
    for (const auto& [level, tiles] : levels)
        say("          {} with a side of {} m\n", tiles, side_of(index.voxel_size, level));
    say("  voxels  {} of {} m\n", voxels, index.voxel_size);
    if (!box.isEmpty()) {
        say("  from    {:.1f} {:.1f} {:.1f}\n  to      {:.1f} {:.1f} {:.1f}\n", box.min().x(),
            box.min().y(), box.min().z(), box.max().x(), box.max().y(), box.max().z());
    }
    say("  drives  {}\n", index.drives.size());
    for (const MapDrive& drive : index.drives)
        say("  {:<28} {:>7} scans\n", drive.name, drive.scans);
}

/// Throws if scans are chosen of a file that has none.
void refuse_selection(const DataOptions& of) {
    if (of.first == 0 && !of.last && of.stride == 1) return;
    throw ConfigError("--first, --last and --stride are for recordings; " + of.data.string() +
                      " is none");
}

}  // namespace

int info(const DataOptions& of) {
    const std::filesystem::path& file = of.data;
    if (of.format.empty() && is_tiled_map(file)) {
        refuse_selection(of);
        describe_map(file);
    } else if (of.format == "bag" || (of.format.empty() && io::Bag::recognises(file))) {
        describe_bag(file);
        describe_scans_of_bag(of);
    } else if (of.format.empty() && std::filesystem::is_regular_file(file) &&
               !io::is_rig_file(file)) {
        refuse_selection(of);
        describe_cloud(file, io::read_cloud(file));
    } else {
        describe_recording(of);  // also a scene that is named behind its folder
    }
    return kDone;
}

void add_info(Program& program) {
    Command c = program.command(
        "info", "Describe a point cloud file, a recording, or the map of several drives");
    const auto of = std::make_shared<DataOptions>();
    c.path("FILE", of->data, "point cloud file, bag or folder").required();
    c.choice("--format", of->format, io::layout_names(),
             "layout of a recording (default: recognised by its files)");
    add_selection_options(c, *of);
    c.action([of] { return info(*of); });
}

}  // namespace dynamic_filter::app
