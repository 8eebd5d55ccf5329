// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>

#include "base/degree.hpp"
#include "base/text.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/poses.hpp"
#include "formats/poses/rigid.hpp"
#include "recording/folders.hpp"
#include "recording/layouts/beside.hpp"

namespace dynamic_filter::io {
namespace {

namespace fs = std::filesystem;

/// Pose of the sensor on the vehicle, from the calibration of the data set.
Pose T_vehicle_sensor() {
    Pose pose = Pose::Identity();
    pose.linear() = (Eigen::AngleAxisd(179.6654 * kDegree, Eigen::Vector3d::UnitZ()) *
                     Eigen::AngleAxisd(0.0003 * kDegree, Eigen::Vector3d::UnitY()) *
                     Eigen::AngleAxisd(0.0001 * kDegree, Eigen::Vector3d::UnitX()))
                        .toRotationMatrix();
    pose.translation() = Eigen::Vector3d(1.7042, -0.021, 1.8047);
    return pose;
}

std::optional<fs::path> mulran_scan_folder(const fs::path& data) {
    for (const fs::path& folder : {data / "Ouster", data / "sensor_data" / "Ouster"}) {
        if (is_folder(folder)) return folder;
    }
    return std::nullopt;
}

/// The folder of the recording, if `data` is its folder Ouster.
fs::path mulran_root(const fs::path& data) {
    const fs::path whole = whole_path(data);
    if (whole.filename() != "Ouster") return data;
    const fs::path above = whole.parent_path();
    return above.filename() == "sensor_data" ? above.parent_path() : above;
}

double stamp_of(const fs::path& scan) {
    const auto nanoseconds = parse_count(scan.stem().string());
    if (!nanoseconds) {
        throw InputError(scan, "", "its name is no time; MulRan's are whole nanoseconds");
    }
    return static_cast<double>(*nanoseconds) * 1e-9;
}

}  // namespace

std::optional<Layout> find_mulran(const Place& place) {
    const fs::path root = mulran_root(place.data), poses = root / "global_pose.csv";
    const auto folder = mulran_scan_folder(root);
    if (!folder || !present(poses)) return std::nullopt;
    std::error_code ignored;
    const auto& given = place.options.poses;
    const bool is_own = !given || fs::equivalent(*given, poses, ignored);
    if (!is_own && prefers_other_poses(place)) return std::nullopt;
    Layout layout;
    layout.scan_folder = *folder;
    layout.scans = list_files(*folder, {".bin"});
    if (layout.scans.empty()) throw InputError(*folder, "", "no *.bin found");
    for (const fs::path& scan : layout.scans) layout.stamps.push_back(stamp_of(scan));
    if (!is_own && has_given_poses(layout, place)) return layout;
    PoseFile file = read_poses(poses);
    if (file.stamps.empty()) throw InputError(poses, "", "has no stamps; expected MulRan's file");
    Trajectory trajectory{std::move(file.stamps), std::move(file.poses)};
    put_in_order(trajectory);
    std::size_t lost = 0;
    for (const double stamp : layout.stamps) {
        const auto pose = pose_at(trajectory, stamp);
        if (!pose) ++lost;
        layout.T_world_sensor.push_back(pose ? *pose * T_vehicle_sensor() : lost_pose());
    }
    if (lost == layout.scans.size()) {
        throw InputError(poses, "", "has no pose at the time of any scan in " + folder->string());
    }
    layout.notes.push_back("vehicle poses from " + poses.string() +
                           ", interpolated at the scans' times, converted with MulRan's "
                           "calibration of the Ouster");
    if (lost != 0)
        layout.notes.push_back(
            fmt::format("{} scans have no poses before and after them, and are rejected", lost));
    return layout;
}

}  // namespace dynamic_filter::io
