// SPDX-License-Identifier: MIT
/// Finds the files of a recording.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "dynamic_filter/recording.hpp"
#include "formats/clouds/cloud_size.hpp"
#include "recording/recording_parts.hpp"

namespace dynamic_filter::io {

using Paths = std::vector<std::filesystem::path>;

struct Layout {
    std::string name;  ///< of the row of layouts/registry.cpp that found it
    std::filesystem::path scan_folder;
    Paths scans;  ///< in natural order; never empty
    /// Poses of the scans if the layout defines them; otherwise empty.
    std::vector<Pose> T_world_sensor;
    /// True: each scan file holds its pose, which T_world_sensor may have as well.
    bool poses_in_scans = false;
    bool points_in_world = false;       ///< true: points are in the frame of the poses
    bool truth_in_intensity = false;    ///< true: intensity may be ground truth
    std::vector<double> stamps;         ///< [s] stamps of the scans if the layout defines them
    std::filesystem::path pose_source;  ///< file of T_world_sensor
    std::optional<std::filesystem::path> poses, times, calib, labels, truth_map;
    /// Ground truth that is not in files of labels: where that of each scan is from (empty: it has
    /// none), and what makes it, one label per point of the scan's cloud.
    Paths truth_files;
    TruthReader read_truth;
    std::function<Cloud(const std::filesystem::path& scan)> read = read_cloud;
    /// Throws InputError if the size of a scan's file alone shows that it is damaged.
    std::function<void(const std::filesystem::path& scan)> refuse_bad_size =
        [](const std::filesystem::path& scan) { io::refuse_bad_size(scan); };
    std::vector<std::string> notes;
};

/// Finds the layout. Throws InputError if there is nothing usable; the message lists what was
/// looked for.
Layout find_layout(const std::filesystem::path& data, const OpenOptions& options);

/// True if a folder contains scan files, directly or in one of the usual subfolders.
bool has_scans(const std::filesystem::path& data);

/// The label file of each scan, with an empty path for scans without one. Empty if no scan has a
/// label file. Missing files and files without a scan are reported in `notes` only, because a run
/// does not need ground truth.
Paths find_labels(const Layout& layout, std::vector<std::string>& notes);

}  // namespace dynamic_filter::io
