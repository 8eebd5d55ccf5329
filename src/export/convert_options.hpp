// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "recording/data_options.hpp"

namespace dynamic_filter::app {

/// What `convert` writes, and how.
struct ConvertOptions {
    DataOptions data;
    std::filesystem::path output;
    std::optional<std::filesystem::path> labels;
    std::string to;      ///< layout of a folder, a name of outputs(); empty: by the output's name
    std::string origin;  ///< of 3dtiles: LAT,LON[,HEIGHT]; may be empty
    bool overwrite = false;
    // Of nav2:
    double cell = 0.05;         ///< [m] width of a cell
    double robot_height = 1.5;  ///< [m] what hangs higher above the floor is no obstacle
    double step = 0.1;          ///< [m] what the robot may climb
    int storey = 0;             ///< which floor, 1 is the lowest of the path; 0: the only one
    bool keep_unknown = true;   ///< map.keep_unknown of the result whose labels are written
};

}  // namespace dynamic_filter::app
