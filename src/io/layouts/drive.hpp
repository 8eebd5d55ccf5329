// SPDX-License-Identifier: MIT
/// What the raw drives of KITTI and those of KITTI-360 have in common: velodyne_points/data/*.bin
/// with velodyne_points/timestamps.txt.
#pragma once

#include <filesystem>
#include <optional>

#include "io/layout.hpp"

namespace dynamic_filter::io {

/// Whether a folder holds velodyne_points/data.
bool is_drive(const std::filesystem::path& folder);

/// The drive that `data`, its velodyne_points or the data in there belongs to, if any.
std::optional<std::filesystem::path> drive_of(const std::filesystem::path& data);

/// Its scans, and their stamps if there are any. A scan's row of timestamps.txt is the one of its
/// number, as some scans of some drives are missing. Throws InputError.
Layout scans_of_drive(const std::filesystem::path& drive);

/// Poses are not looked for if they were given or are not wanted: then the layout is complete.
bool needs_no_poses(Layout& layout, const OpenOptions& options);

}  // namespace dynamic_filter::io
