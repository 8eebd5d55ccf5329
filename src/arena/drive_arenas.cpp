// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>

#include "arena/find.hpp"
#include "arena/rows.hpp"
#include "arena/score_trial.hpp"
#include "arena/tracklets.hpp"
#include "arena/twin.hpp"
#include "base/text.hpp"
#include "dynamic_filter/error.hpp"
#include "formats/poses/rigid.hpp"
#include "recording/folders.hpp"
#include "recording/layouts/nuscenes_tables.hpp"
#include "recording/scans.hpp"
#include "recording/truth.hpp"

namespace dynamic_filter::app {

namespace {

namespace fs = std::filesystem;

std::optional<Trial> find_scene(const fs::path& root, const std::string& scene) {
    const fs::path tables = root / "v1.0-mini";
    if (!io::is_folder(tables)) return std::nullopt;
    Trial trial{.entry = scene, .data = {.data = root / scene, .format = "nuscenes"}};
    trial.scored = io::scans_with_truth(open(trial.data).info());
    if (trial.scored.empty()) throw InputError(tables, "", "has no boxes of " + scene);
    trial.notes.push_back(fmt::format(
        "{} key frames; a box moves if its object moves at any of them", trial.scored.size()));
    return trial;
}

std::vector<std::string> scenes_in(const fs::path& root) {
    const fs::path file = root / "v1.0-mini" / "scene.json";
    std::vector<std::string> names;
    if (!io::present(file)) return names;
    io::nuscenes::each_entry(file, [&](const nlohmann::json& scene) {
        names.push_back(io::nuscenes::text_of(scene, "name"));
    });
    return names;
}

// KITTI's raw drives.

/// Folders of drives that have scans and tracklets, in the root or in folders of days below it.
std::vector<fs::path> labelled_drives(const fs::path& root) {
    std::vector<fs::path> days{root}, drives;
    for (const fs::path& day : io::list_folders(root)) days.push_back(day);
    for (const fs::path& day : days) {
        for (const fs::path& drive : io::list_folders(day)) {
            const bool is_whole = io::present(drive / "tracklet_labels.xml") &&
                                  io::is_folder(drive / "velodyne_points");
            if (is_whole) drives.push_back(drive);
        }
    }
    return drives;
}

/// "0005" of 2011_09_26_drive_0005_sync; the whole name of another folder.
std::string number_of_drive(const fs::path& drive) {
    const std::string name = drive.filename().string();
    const std::size_t at = name.find("_drive_");
    return at == std::string::npos ? name : name.substr(at + 7, 4);
}

/// By number, or by the whole name where two days have a drive of that number.
std::map<std::string, fs::path> drives_by_name(const fs::path& root) {
    const std::vector<fs::path> drives = labelled_drives(root);
    std::map<std::string, fs::path> named;
    for (const fs::path& drive : drives) {
        const auto same = std::count_if(drives.begin(), drives.end(), [&](const fs::path& other) {
            return number_of_drive(other) == number_of_drive(drive);
        });
        named[same == 1 ? number_of_drive(drive) : drive.filename().string()] = drive;
    }
    return named;
}

std::vector<std::string> drives_in(const fs::path& root) {
    std::vector<std::string> names;
    for (const auto& [name, drive] : drives_by_name(root)) names.push_back(name);
    return names;
}

/// What is known of a drive beside its scans.
struct LabelledDrive {
    std::vector<Tracklet> tracks;
    Labels motions;
};

/// The number of a scan is that in its name, because some drives lack scans.
std::size_t number_of_scan(const io::Recording& recording, std::size_t i) {
    const auto number = io::parse_real(io::stem(recording, i));
    return number ? static_cast<std::size_t>(*number) : i;
}

LabelledDrive labelled_drive(const fs::path& file, const io::Recording& recording) {
    LabelledDrive drive{read_tracklets(file), {}};
    std::vector<Pose> by_number;
    for (std::size_t i = 0; i < recording.size(); ++i) {
        const std::size_t number = number_of_scan(recording, i);
        by_number.resize(std::max(by_number.size(), number + 1), io::lost_pose());
        by_number[number] = recording.info().T_world_sensor[i];
    }
    for (const Tracklet& track : drive.tracks) {
        drive.motions.push_back(motion_of(track, by_number));
    }
    return drive;
}

std::optional<Trial> find_raw_drive(const fs::path& root, const std::string& name) {
    const auto drives = drives_by_name(root);
    const auto found = drives.find(name);
    if (found == drives.end()) return std::nullopt;
    const fs::path& folder = found->second;
    Trial trial{.entry = name, .data = {.data = folder, .format = "kitti-raw"}};
    const io::Recording recording = open(trial.data);
    if (!recording.info().has_poses) {
        throw InputError(folder, "", "has no oxts/data, from which the poses are");
    }
    const auto drive = std::make_shared<const LabelledDrive>(
        labelled_drive(folder / "tracklet_labels.xml", recording));
    trial.truth = [drive](const io::Recording& of, std::size_t i, const io::FullScan& scan) {
        return truth_by_tracklets(drive->tracks, drive->motions, number_of_scan(of, i),
                                  scan.points);
    };
    const auto moving = std::count(drive->motions.begin(), drive->motions.end(), Label::dynamic);
    trial.notes.push_back(fmt::format("{} scans, {} of {} tracks move", recording.size(), moving,
                                      drive->tracks.size()));
    return trial;
}

}  // namespace

Arena nuscenes_arena() {
    return {.name = "nuscenes",
            .title = "nuScenes mini, key frames",
            .entries = {"scene-0061", "scene-0103", "scene-0553", "scene-0655", "scene-0757",
                        "scene-0796", "scene-0916", "scene-1077", "scene-1094", "scene-1100"},
            .columns = {{"IoU"}},
            .layout = "v1.0-mini/*.json, samples/LIDAR_TOP and sweeps/LIDAR_TOP",
            .download = "nuScenes, full data set, mini (nuscenes.org; needs an account)",
            .find = find_scene,
            .score = by_moving_to_50_m,
            .write_twin = write_nuscenes_twin,
            .entries_in = scenes_in};
}

Arena kitti_raw_arena() {
    return {.name = "kitti-raw",
            .title = "KITTI's raw drives, by their tracklets",
            .entries = {"0001", "0005"},
            .columns = {{"PR"}, {"RR"}, {"F1", false}, {"AA"}, {"IoU"}},
            .layout =
                "2011_09_26/2011_09_26_drive_NNNN_sync/velodyne_points, oxts, "
                "tracklet_labels.xml, and calib_imu_to_velo.txt of the day",
            .download =
                "KITTI's raw data (cvlibs.net): of each drive \"synced+rectified data\" and "
                "\"tracklets\", and \"calibration\" of the day",
            .find = find_raw_drive,
            .score = by_voxels,
            .write_twin = write_raw_twin,
            .entries_in = drives_in};
}

}  // namespace dynamic_filter::app
