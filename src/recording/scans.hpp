// SPDX-License-Identifier: MIT
/// Reading a recording with read-ahead, and putting its scans into a frame that floats can hold.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "dynamic_filter/error.hpp"
#include "dynamic_filter/recording.hpp"
#include "dynamic_filter/types.hpp"
#include "recording/data_options.hpp"

namespace dynamic_filter::app {

/// Throws ConfigError if the file to be written has another extension, because it may then be a
/// file of the user's recording.
void require_extension(const std::filesystem::path& output, const std::string& extension);

io::Recording open(const DataOptions& options);

/// A scan, or why it cannot be used.
struct MaybeScan {
    std::optional<io::FullScan> scan;
    std::string error;
};

/// The indices of all scans, in order.
std::vector<std::size_t> all_scans(const io::Recording& recording);

/// What to throw if a scan that could be used before is another one now, or gone.
InputError changed_in_use(const io::Recording& recording, std::size_t i, const std::string& why);

/// Reads `scans` (indices) a few at a time, in parallel, and the next few meanwhile; `prepare` runs
/// on each in parallel, then `use` on each in order, in the caller's thread. Stops early when `use`
/// returns false.
void for_each_scan(const io::Recording& recording, const std::vector<std::size_t>& scans,
                   const std::function<void(std::size_t, MaybeScan&)>& prepare,
                   const std::function<bool(std::size_t, MaybeScan&)>& use);

/// The filter's view of a scan; its points and times are moved out of it.
Scan moved_scan(io::FullScan& scan, std::size_t index);

/// Points of the sensor in the world, shifted by `-origin`. Near the origin floats are exact
/// enough.
Points shifted_world(const Points& points, const Pose& T_world_sensor,
                     const Eigen::Vector3d& origin);
/// The scan's points, shifted by `-origin` from the world. Near the origin floats are exact enough.
Points shifted_world(const io::FullScan& scan, const Eigen::Vector3d& origin);

/// x y z of a cloud in the world, less the origin; in double until then.
Points positions_from(const io::Cloud& cloud, const Eigen::Vector3d& origin);

/// Whole metres near the first finite point; zero if there is none.
Eigen::Vector3d origin_of(const io::Cloud& cloud);

/// A whole number of voxels near the first usable pose; the world's origin if there is none.
Eigen::Vector3d scoring_origin(const io::Recording& recording, double voxel_size);

}  // namespace dynamic_filter::app
