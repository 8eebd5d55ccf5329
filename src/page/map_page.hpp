// SPDX-License-Identifier: MIT
/// The page of the map of several drives: an overview of the tiles, and a page for each of them.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace dynamic_filter::app {

/// Where a drive went.
struct DrivePath {
    std::string name;
    std::vector<Eigen::Vector3d> positions;  ///< [m] in the world frame; thinned further if need be
};

/// Writes OUT/report.html and OUT/report/NAME.html from OUT/map, a tile at a time. The pages share
/// OUT/report/viewer.js and viewer.css, and need no server. `metrics` and `timing` are shown as
/// they are, and may be null. The same input gives the same bytes. Throws InputError, OutputError,
/// and Error if the command was built without the viewer.
void write_map_page(const std::filesystem::path& out, const nlohmann::ordered_json& metrics,
                    const nlohmann::ordered_json& timing, const std::vector<DrivePath>& paths);

}  // namespace dynamic_filter::app
