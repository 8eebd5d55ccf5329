// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/degree.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/file.hpp"
#include "formats/poses/rigid.hpp"
#include "recording/folders.hpp"
#include "recording/layouts/drive.hpp"
#include "recording/layouts/layouts.hpp"
#include "recording/layouts/numbers.hpp"
#include "recording/layouts/pose_notes.hpp"

namespace dynamic_filter::io {
namespace {

namespace fs = std::filesystem;

/// Pose of the inertial unit: degrees, metres, radians.
struct Oxts {
    double latitude, longitude, altitude, roll, pitch, yaw;
};

Oxts read_oxts(const fs::path& file) {
    const std::string text = read_file(file);
    Lines lines(text, file);
    lines.next();
    const std::vector<double> row = read_numbers(lines.line(), lines);
    if (row.size() < 6) {
        lines.fail(fmt::format("{} numbers; expected lat lon alt roll pitch yaw, and more behind",
                               row.size()));
    }
    const bool finite =
        std::all_of(row.begin(), row.begin() + 6, [](double v) { return std::isfinite(v); });
    if (!finite || std::abs(row[0]) >= 90.0) lines.fail("is no place on Earth");
    return {row[0], row[1], row[2], row[3], row[4], row[5]};
}

/// Mercator projection, scaled to be correct at the latitude whose cosine is `scale`. x points
/// east, y north, z up, as in the development kit of the data set.
Pose T_world_imu(const Oxts& at, double scale) {
    constexpr double earth = 6378137.0;  // [m] radius at the equator
    Pose pose = Pose::Identity();
    pose.translation() =
        Eigen::Vector3d(scale * earth * at.longitude * kDegree,
                        scale * earth * std::asinh(std::tan(at.latitude * kDegree)), at.altitude);
    pose.linear() = (Eigen::AngleAxisd(at.yaw, Eigen::Vector3d::UnitZ()) *
                     Eigen::AngleAxisd(at.pitch, Eigen::Vector3d::UnitY()) *
                     Eigen::AngleAxisd(at.roll, Eigen::Vector3d::UnitX()))
                        .toRotationMatrix();
    return pose;
}

Pose read_T_velo_imu(const fs::path& file) {
    const std::string text = read_file(file);
    Lines lines(text, file);
    std::vector<double> R, T;
    Rows34 rows = Rows34::Zero();
    while (lines.next()) {
        std::string_view rest = lines.line();
        const std::string_view key = next_token(rest);
        if (key != "R:" && key != "T:") continue;
        std::vector<double>& numbers = key == "R:" ? R : T;
        numbers = read_numbers(rest, lines);
        const std::size_t wanted = key == "R:" ? 9 : 3;
        if (numbers.size() != wanted) {
            lines.fail(
                fmt::format("{} numbers behind {}; expected {}", numbers.size(), key, wanted));
        }
    }
    if (R.empty() || T.empty()) throw InputError(file, "", "has no lines 'R:' and 'T:'");
    rows.leftCols<3>() = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(R.data());
    rows.col(3) = Eigen::Map<const Eigen::Vector3d>(T.data());
    if (!rows.allFinite()) throw InputError(file, "", "has numbers that are not finite");
    return pose_from_rows(rows, lines);
}

/// Pose of the sensor relative to the inertial unit, from the file in the folder of the same day.
Pose find_T_imu_velo(const fs::path& drive, std::vector<std::string>& notes) {
    const char* name = "calib_imu_to_velo.txt";
    for (const fs::path& folder : {drive, whole_path(drive).parent_path()}) {
        if (!present(folder / name)) continue;
        notes.push_back("the sensor's place on the vehicle from " + (folder / name).string());
        return read_T_velo_imu(folder / name).inverse();
    }
    notes.push_back(fmt::format(
        "no {} in {} or above; the sensor is assumed to be 0.81 m in front of, 0.32 m right of and "
        "0.80 m above the inertial unit, as on KITTI's car, and to have the same orientation",
        name, drive.string()));
    return Pose(Eigen::Translation3d(0.81, -0.32, 0.80));
}

/// Moves the origin of the world to the first known pose, because projected degrees give large
/// coordinates.
void put_first_at_origin(std::vector<Pose>& poses) {
    const auto known = [](const Pose& pose) { return pose.matrix().allFinite(); };
    const auto first = std::find_if(poses.begin(), poses.end(), known);
    if (first == poses.end()) return;
    const Eigen::Vector3d origin = first->translation();
    for (Pose& pose : poses) pose.translation() -= origin;
}

/// The pose of each scan comes from the file with the same name; if it is missing, the pose is
/// lost.
std::vector<Pose> poses_of(const Layout& layout, const fs::path& folder, const Pose& T_imu_velo) {
    std::vector<Pose> poses;
    std::optional<double> scale;
    for (const fs::path& scan : layout.scans) {
        const fs::path file = folder / (scan.stem().string() + ".txt");
        poses.push_back(lost_pose());
        if (!present(file)) continue;
        const Oxts at = read_oxts(file);
        if (!scale) scale = std::cos(at.latitude * kDegree);
        poses.back() = T_world_imu(at, *scale) * T_imu_velo;
    }
    if (!scale) {
        throw InputError(folder, "",
                         "has no file of the name of any scan in " + layout.scan_folder.string());
    }
    put_first_at_origin(poses);
    return poses;
}

}  // namespace

std::optional<Layout> find_kitti_raw(const Place& place) {
    const auto drive = drive_of(place.data);
    if (!drive) return std::nullopt;
    Layout layout = scans_of_drive(*drive);
    if (needs_no_poses(layout, place.options)) return layout;
    const fs::path oxts = *drive / "oxts" / "data";
    if (!is_folder(oxts)) {
        layout.notes.push_back("no poses found; looked for the files of " + oxts.string() +
                               offer_poses(layout.scans.size(), {*drive}));
        return layout;
    }
    layout.T_world_sensor = poses_of(layout, oxts, find_T_imu_velo(*drive, layout.notes));
    layout.pose_source = oxts;
    layout.notes.push_back("poses from " + oxts.string() +
                           ", by Mercator's projection: east, north, up from the first scan");
    note_lost(layout);
    return layout;
}

}  // namespace dynamic_filter::io
