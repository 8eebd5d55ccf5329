// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "base/text.hpp"
#include "dynamic_filter/error.hpp"
#include "formats/poses/rigid.hpp"
#include "recording/folders.hpp"
#include "recording/layouts/beside.hpp"
#include "recording/layouts/nuscenes_tables.hpp"
#include "recording/layouts/nuscenes_truth.hpp"

namespace dynamic_filter::io {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// The folder of the data set, if `data` is one of the folders in it that hold tables or scans.
fs::path nuscenes_root(const fs::path& data) {
    const fs::path whole = whole_path(data);
    const std::string name = whole.filename().string();
    if (name == "LIDAR_TOP") return whole.parent_path().parent_path();
    const bool is_inside = name.starts_with("v1.0-") || name == "samples" || name == "sweeps";
    return is_inside ? whole.parent_path() : data;
}

std::optional<fs::path> tables_of(const fs::path& data) {
    std::optional<fs::path> tables;
    for (const fs::path& folder : list_folders(data)) {
        if (!folder.filename().string().starts_with("v1.0-")) continue;
        if (!present(folder / "sample_data.json")) continue;
        if (tables) {
            throw InputError(data, "",
                             "holds the tables " + tables->filename().string() + " and " +
                                 folder.filename().string() + "; keep one of them here");
        }
        tables = folder;
    }
    return tables;
}

/// The token of the scene with that name, or of the only scene.
std::string scene_token(const fs::path& tables, const std::string& wanted) {
    std::string names, token;
    std::size_t count = 0;
    nuscenes::each_entry(tables / "scene.json", [&](const Json& scene) {
        const std::string name = nuscenes::text_of(scene, "name");
        if (wanted.empty() || name == wanted) token = nuscenes::text_of(scene, "token");
        names += (count++ == 0 ? "" : ", ") + name;
    });
    if (token.empty() || (wanted.empty() && count > 1)) {
        throw InputError(
            tables, "",
            (wanted.empty() ? "" : "has no " + wanted + "; ") +
                fmt::format("choose a scene by appending its name to the folder, such as "
                            "{}; there are: {}",
                            (tables.parent_path() / "scene-0061").string(), names));
    }
    return token;
}

struct SweepEntry {
    double stamp = 0.0;
    fs::path file;
    std::string ego, sensor, sample;  ///< tokens
    bool is_key_frame = false;        ///< the scan of its sample, not one between two samples
};

std::vector<SweepEntry> sweeps_of(const fs::path& data, const fs::path& tables,
                                  const std::string& scene) {
    std::map<std::string, bool> in_scene;
    nuscenes::each_entry(tables / "sample.json", [&](const Json& sample) {
        in_scene[nuscenes::text_of(sample, "token")] =
            nuscenes::text_of(sample, "scene_token") == scene;
    });
    std::vector<SweepEntry> sweeps;
    nuscenes::each_entry(tables / "sample_data.json", [&](const Json& entry) {
        const std::string file = nuscenes::text_of(entry, "filename");
        if (file.find("/LIDAR_TOP/") == std::string::npos) return;
        if (file.find("..") != std::string::npos || fs::path(file).is_absolute()) {
            throw InputError(tables / "sample_data.json", "", quote(file) + " leads elsewhere");
        }
        if (!in_scene[nuscenes::text_of(entry, "sample_token")]) return;
        sweeps.push_back({entry.at("timestamp").get<double>() * 1e-6, data / file,
                          nuscenes::text_of(entry, "ego_pose_token"),
                          nuscenes::text_of(entry, "calibrated_sensor_token"),
                          nuscenes::text_of(entry, "sample_token"), file.starts_with("samples/")});
    });
    std::sort(sweeps.begin(), sweeps.end(),
              [](const SweepEntry& a, const SweepEntry& b) { return a.stamp < b.stamp; });
    return sweeps;
}

/// Reads only the required poses, because the table of the whole data set has millions.
std::map<std::string, Pose> poses_of(const fs::path& file, const std::vector<SweepEntry>& sweeps,
                                     std::string SweepEntry::*token) {
    std::map<std::string, Pose> poses;
    for (const SweepEntry& sweep : sweeps) poses.emplace(sweep.*token, lost_pose());
    std::size_t found = 0;
    nuscenes::each_entry(file, [&](const Json& entry) {
        const auto pose = poses.find(nuscenes::text_of(entry, "token"));
        if (pose == poses.end()) return;
        pose->second = nuscenes::pose_of(entry, file);
        ++found;
    });
    if (found != poses.size()) {
        throw InputError(file, "",
                         fmt::format("has {} of the {} entries that sample_data.json refers to",
                                     found, poses.size()));
    }
    return poses;
}

/// Leaves out the scans between key frames that are not on the disk, since the parts of the data
/// set are downloaded one by one. A key frame that is missing is a fault, so it stays.
void drop_missing(std::vector<SweepEntry>& sweeps, Layout& layout) {
    const auto between = std::count_if(sweeps.begin(), sweeps.end(),
                                       [](const SweepEntry& s) { return !s.is_key_frame; });
    const auto missing = std::erase_if(
        sweeps, [](const SweepEntry& s) { return !s.is_key_frame && !present(s.file); });
    if (missing == 0) return;
    const std::string folder = (layout.scan_folder / "sweeps/LIDAR_TOP").string();
    layout.notes.push_back(
        std::cmp_equal(missing, between)
            ? fmt::format("none of the {} scans between key frames is in {}; only the key frames "
                          "are read, and the result is better with all scans",
                          between, folder)
            : fmt::format("{} of the {} scans between key frames are not in {}; they are left out",
                          missing, between, folder));
}

std::vector<Pose> sensor_poses(const fs::path& tables, const std::vector<SweepEntry>& sweeps) {
    const auto ego = poses_of(tables / "ego_pose.json", sweeps, &SweepEntry::ego);
    const auto sensor = poses_of(tables / "calibrated_sensor.json", sweeps, &SweepEntry::sensor);
    std::vector<Pose> poses;
    for (const SweepEntry& sweep : sweeps) {
        poses.push_back(ego.at(sweep.ego) * sensor.at(sweep.sensor));
    }
    return poses;
}

using BoxesOfScans = std::vector<std::vector<nuscenes::MovingBox>>;

/// Boxes are known at the times of the key frames, so these have ground truth.
void find_truth(Layout& layout, const fs::path& tables, const std::vector<SweepEntry>& sweeps,
                const std::vector<Pose>& poses) {
    std::set<std::string> samples;
    for (const SweepEntry& sweep : sweeps) {
        if (sweep.is_key_frame) samples.insert(sweep.sample);
    }
    const auto of_samples = nuscenes::moving_boxes(tables, samples);
    if (of_samples.empty()) return;
    BoxesOfScans boxes(sweeps.size());
    layout.truth_files.resize(sweeps.size());
    for (std::size_t i = 0; i < sweeps.size(); ++i) {
        if (!sweeps[i].is_key_frame) continue;
        boxes[i] = of_samples.at(sweeps[i].sample);
        layout.truth_files[i] = nuscenes::annotations_of(tables);
    }
    layout.read_truth = [boxes = std::move(boxes), poses](std::size_t i, const Cloud& cloud) {
        return nuscenes::truth_by(boxes[i], positions(cloud), poses[i]);
    };
    layout.notes.push_back(
        fmt::format("ground truth of {} key frames by the boxes of {}: what moves at one of them "
                    "is dynamic",
                    samples.size(), nuscenes::annotations_of(tables).string()));
}

}  // namespace

bool names_scene(const fs::path& data) {
    return !present(data) && tables_of(without_slash(data).parent_path()).has_value();
}

std::optional<Layout> find_nuscenes(const Place& place) {
    if (prefers_other_poses(place)) return std::nullopt;
    const fs::path data = without_slash(place.data);
    const bool names_scene = !present(data);
    const fs::path root = names_scene ? data.parent_path() : nuscenes_root(data);
    const auto tables = tables_of(root);
    if (!tables) return std::nullopt;
    const std::string scene =
        scene_token(*tables, names_scene ? data.filename().string() : std::string());
    std::vector<SweepEntry> sweeps = sweeps_of(root, *tables, scene);
    Layout layout;
    layout.scan_folder = root;
    drop_missing(sweeps, layout);
    if (sweeps.empty()) throw InputError(*tables, "", "the scene has no scan of LIDAR_TOP");
    for (const SweepEntry& sweep : sweeps) {
        layout.scans.push_back(sweep.file);
        layout.stamps.push_back(sweep.stamp);
    }
    layout.notes.push_back("scans and poses of LIDAR_TOP from " + tables->string());
    const std::vector<Pose> poses = sensor_poses(*tables, sweeps);
    find_truth(layout, *tables, sweeps, poses);
    if (!has_given_poses(layout, place)) layout.T_world_sensor = poses;
    return layout;
}

}  // namespace dynamic_filter::io
