// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "dynamic_filter/error.hpp"
#include "dynamic_filter/file.hpp"
#include "dynamic_filter/poses.hpp"
#include "formats/poses/rigid.hpp"
#include "recording/folders.hpp"
#include "recording/layouts/drive.hpp"
#include "recording/layouts/layouts.hpp"
#include "recording/layouts/numbers.hpp"
#include "recording/layouts/pose_notes.hpp"

namespace dynamic_filter::io {
namespace {

namespace fs = std::filesystem;

constexpr const char* scans_name = "data_3d_raw";

/// The given drive, or the only one below data_3d_raw.
std::optional<fs::path> find_drive(const fs::path& data) {
    if (const auto drive = drive_of(data)) {
        const bool is_one = whole_path(*drive).parent_path().filename() == scans_name;
        return is_one ? std::optional(whole_path(*drive)) : std::nullopt;
    }
    const fs::path root = whole_path(data).filename() == scans_name ? data : data / scans_name;
    Paths drives;
    for (const fs::path& drive : list_folders(root)) {
        if (is_drive(drive)) drives.push_back(drive);
    }
    if (drives.empty()) return std::nullopt;
    if (drives.size() > 1) refuse_several(root, drives);
    return whole_path(drives[0]);
}

/// The pose in the row that begins with `name`; in a file without names, in the first row.
Pose read_calibration(const fs::path& file, std::string_view name) {
    const std::string text = read_file(file);
    Lines lines(text, file);
    while (lines.next()) {
        std::string_view rest = trim(lines.line());
        if (rest.empty() || (!name.empty() && next_token(rest) != name)) continue;
        const Pose pose = read_pose_row(rest, lines);
        if (!pose.matrix().allFinite()) lines.fail("has numbers that are not finite");
        return pose;
    }
    throw InputError(file, "",
                     name.empty() ? "holds no matrix" : fmt::format("has no line '{}'", name));
}

/// Pose of the sensor on the vehicle, computed via the left camera.
Pose read_T_pose_velo(const fs::path& calibration) {
    const Pose T_velo_cam = read_calibration(calibration / "calib_cam_to_velo.txt", "");
    const Pose T_pose_cam = read_calibration(calibration / "calib_cam_to_pose.txt", "image_00:");
    return T_pose_cam * T_velo_cam.inverse();
}

/// Poses with the number of the scan in place of the time, from rows of "number, 3x4 matrix".
Trajectory read_trajectory(const fs::path& file) {
    const std::string text = read_file(file);
    Lines lines(text, file);
    Trajectory trajectory;
    while (lines.next()) {
        std::string_view rest = lines.line();
        const std::string_view token = next_token(rest);
        if (token.empty()) continue;
        const auto number = parse_count(token);
        if (!number) lines.fail(quote(token) + " is no number of a scan");
        const auto at = static_cast<double>(*number);
        if (!trajectory.stamps.empty() && at <= trajectory.stamps.back()) {
            lines.fail(fmt::format("scan {} comes after scan {}; expected increasing numbers", at,
                                   trajectory.stamps.back()));
        }
        const Pose pose = read_pose_row(rest, lines);
        if (!pose.matrix().allFinite()) continue;
        trajectory.stamps.push_back(at);
        trajectory.poses.push_back(pose);
    }
    if (trajectory.stamps.empty()) throw InputError(file, "", "holds no pose");
    return trajectory;
}

void add_poses(Layout& layout, const fs::path& file, const Pose& T_pose_velo) {
    constexpr double longest_gap = 10.0;  // scans; the sensor turns ten times per second
    const Trajectory trajectory = read_trajectory(file);
    std::size_t found = 0;
    for (const fs::path& scan : layout.scans) {
        const auto number = index_of(scan);
        if (!number) throw InputError(scan, "", "its name is no number, as poses.txt refers to");
        const auto pose = pose_at(trajectory, static_cast<double>(*number), longest_gap);
        layout.T_world_sensor.push_back(pose ? *pose * T_pose_velo : lost_pose());
        found += pose ? 1 : 0;
    }
    if (found == 0) {
        throw InputError(file, "", "has no pose of any scan in " + layout.scan_folder.string());
    }
    layout.pose_source = file;
    layout.notes.push_back("vehicle poses from " + file.string() +
                           ", interpolated between the scans that have one, and the sensor's place "
                           "on the vehicle from calibration/");
    note_lost(layout);
}

/// The reason why there are no poses; empty if there are.
std::string what_is_missing(const fs::path& poses, const fs::path& calibration) {
    if (!present(poses)) return "no poses found; looked for " + poses.string();
    for (const char* name : {"calib_cam_to_velo.txt", "calib_cam_to_pose.txt"}) {
        if (present(calibration / name)) continue;
        return "no poses: " + poses.string() + " holds poses of the vehicle, and without " +
               (calibration / name).string() + " the place of the sensor on it is not known";
    }
    return "";
}

}  // namespace

std::optional<Layout> find_kitti_360(const Place& place) {
    const auto drive = find_drive(place.data);
    if (!drive) return std::nullopt;
    Layout layout = scans_of_drive(*drive);
    if (needs_no_poses(layout, place.options)) return layout;
    const fs::path root = drive->parent_path().parent_path();
    const fs::path poses = root / "data_poses" / drive->filename() / "poses.txt";
    if (const std::string missing = what_is_missing(poses, root / "calibration");
        !missing.empty()) {
        layout.notes.push_back(missing + offer_poses(layout.scans.size(), {*drive}));
        return layout;
    }
    add_poses(layout, poses, read_T_pose_velo(root / "calibration"));
    return layout;
}

}  // namespace dynamic_filter::io
