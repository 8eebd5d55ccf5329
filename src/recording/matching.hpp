// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "dynamic_filter/poses.hpp"
#include "recording/layout.hpp"

namespace dynamic_filter::io {

/// read_poses(). Motions are joined to poses here, because that needs all rows; `fix` is none then.
PoseFile read_pose_file(const std::filesystem::path& file, PoseFix& fix);

/// The poses that are known, which rows of lost tracking are not, in the order of their stamps.
Trajectory without_lost(const std::vector<double>& stamps, const std::vector<Pose>& poses);

/// A pose for each scan.
struct Match {
    std::vector<Pose> poses;
    std::vector<double> stamps;  ///< [s] of the scans; empty if they are not known
    std::string note;            ///< how scans and poses were matched, for the user
    /// [s] of poses that were matched by order although both have stamps.
    std::vector<double> pose_stamps{};
    /// All poses, if they were matched by time.
    Trajectory trajectory{};
    bool are_sparse = false;  ///< see PosesAtScans
    std::string sparse_note{};
};

/// The factor that turns stamps of poses into those of scans, if they only differ by their unit:
/// 1e-3, 1e-6, 1e-9, 1e3, 1e6 or 1e9; otherwise 1.
double unit_between(const std::vector<double>& poses, const std::vector<double>& scans);

/// The row of each scan among `rows` rows, if the scans are named by the numbers of the rows and
/// some are missing, at the end or between others; empty if the names do not tell it.
std::vector<std::size_t> rows_in_names(const Paths& scans, std::size_t rows);

/// Where poses and scans have stamps of one clock, time decides; a scan that no pose is near to has
/// lost_pose(). Otherwise order decides, if the numbers agree, or the numbers in the names.
/// `times`: stamps [s] of the scans that their names do not tell; may be empty. `unit` [s]: of the
/// stamps in the pose file and in the names, if it is given. Throws InputError with both numbers,
/// or if no scan has a pose.
Match match_poses(const Layout& layout, const PoseFile& file, const std::vector<double>& times,
                  std::optional<double> unit = {});

}  // namespace dynamic_filter::io
