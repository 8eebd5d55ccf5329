// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "base/text.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/file.hpp"
#include "formats/poses/rigid.hpp"
#include "recording/folders.hpp"
#include "recording/layouts/beside.hpp"

namespace dynamic_filter::io {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// Calls `f` with each entry of a table; throws if an entry lacks a required value.
template <class F>
void each_entry(const fs::path& file, const F& f) {
    try {
        for (const Json& entry : Json::parse(read_file(file))) f(entry);
    } catch (const Json::exception& error) {
        throw InputError(file, "", std::string("is no table of nuScenes: ") + error.what());
    }
}

std::string text_of(const Json& entry, const char* key) { return entry.at(key).get<std::string>(); }

Pose pose_of(const Json& entry, const fs::path& file) {
    const Lines where("", file);
    const Json& t = entry.at("translation");
    const Json& q = entry.at("rotation");
    const auto number = [](const Json& list, std::size_t i) { return list.at(i).get<double>(); };
    return pose_from_quaternion(
        {number(t, 0), number(t, 1), number(t, 2)},
        Eigen::Quaterniond(number(q, 0), number(q, 1), number(q, 2), number(q, 3)), "wxyz", where);
}

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
    each_entry(tables / "scene.json", [&](const Json& scene) {
        const std::string name = text_of(scene, "name");
        if (wanted.empty() || name == wanted) token = text_of(scene, "token");
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
    std::string ego, sensor;  ///< tokens
};

std::vector<SweepEntry> sweeps_of(const fs::path& data, const fs::path& tables,
                                  const std::string& scene) {
    std::map<std::string, bool> in_scene;
    each_entry(tables / "sample.json", [&](const Json& sample) {
        in_scene[text_of(sample, "token")] = text_of(sample, "scene_token") == scene;
    });
    std::vector<SweepEntry> sweeps;
    each_entry(tables / "sample_data.json", [&](const Json& entry) {
        const std::string file = text_of(entry, "filename");
        if (file.find("/LIDAR_TOP/") == std::string::npos) return;
        if (file.find("..") != std::string::npos || fs::path(file).is_absolute()) {
            throw InputError(tables / "sample_data.json", "", quote(file) + " leads elsewhere");
        }
        if (!in_scene[text_of(entry, "sample_token")]) return;
        sweeps.push_back({entry.at("timestamp").get<double>() * 1e-6, data / file,
                          text_of(entry, "ego_pose_token"),
                          text_of(entry, "calibrated_sensor_token")});
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
    each_entry(file, [&](const Json& entry) {
        const auto pose = poses.find(text_of(entry, "token"));
        if (pose == poses.end()) return;
        pose->second = pose_of(entry, file);
        ++found;
    });
    if (found != poses.size()) {
        throw InputError(file, "",
                         fmt::format("has {} of the {} entries that sample_data.json refers to",
                                     found, poses.size()));
    }
    return poses;
}

}  // namespace

std::optional<Layout> find_nuscenes(const Place& place) {
    if (prefers_other_poses(place)) return std::nullopt;
    const fs::path data = without_slash(place.data);
    const bool names_scene = !present(data);
    const fs::path root = names_scene ? data.parent_path() : nuscenes_root(data);
    const auto tables = tables_of(root);
    if (!tables) return std::nullopt;
    const std::string scene =
        scene_token(*tables, names_scene ? data.filename().string() : std::string());
    const std::vector<SweepEntry> sweeps = sweeps_of(root, *tables, scene);
    if (sweeps.empty()) throw InputError(*tables, "", "the scene has no scan of LIDAR_TOP");
    Layout layout;
    layout.scan_folder = root;
    for (const SweepEntry& sweep : sweeps) {
        layout.scans.push_back(sweep.file);
        layout.stamps.push_back(sweep.stamp);
    }
    layout.notes.push_back("scans and poses of LIDAR_TOP from " + tables->string());
    if (has_given_poses(layout, place)) return layout;
    const auto ego = poses_of(*tables / "ego_pose.json", sweeps, &SweepEntry::ego);
    const auto sensor = poses_of(*tables / "calibrated_sensor.json", sweeps, &SweepEntry::sensor);
    for (const SweepEntry& sweep : sweeps) {
        layout.T_world_sensor.push_back(ego.at(sweep.ego) * sensor.at(sweep.sensor));
    }
    return layout;
}

}  // namespace dynamic_filter::io
