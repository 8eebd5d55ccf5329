// SPDX-License-Identifier: MIT
/// Common parts of the raw drives of KITTI and of those of KITTI-360: velodyne_points/data/*.bin
/// with velodyne_points/timestamps.txt.
#pragma once

#include <filesystem>
#include <optional>

#include "recording/layout.hpp"

namespace dynamic_filter::io {

/// True if a folder contains velodyne_points/data.
bool is_drive(const std::filesystem::path& folder);

/// The drive to which `data` belongs, if any; `data` may be its velodyne_points or the data folder
/// in it.
std::optional<std::filesystem::path> drive_of(const std::filesystem::path& data);

/// The scans of a drive, and their stamps if there are any. The stamp of a scan is in the row of
/// timestamps.txt with the number of the scan, because some drives have missing scans. Throws
/// InputError.
Layout scans_of_drive(const std::filesystem::path& drive);

/// True if poses are given by the user or not wanted; the layout is then complete.
bool needs_no_poses(Layout& layout, const OpenOptions& options);

}  // namespace dynamic_filter::io
