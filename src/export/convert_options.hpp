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
    std::string origin;  ///< of the world: LAT,LON[,HEIGHT], or EAST,NORTH[,HEIGHT]; may be empty
    std::string crs;     ///< of clouds: coordinate system, such as EPSG:32633; may be empty
    bool overwrite = false;
    std::string box;         ///< two corners in the world, as box_of() reads them; may be empty
    double max_range = 0.0;  ///< [m] from the sensor; 0: any
    std::string only;        ///< "static" or "dynamic"; empty: all points
    double thin = 0.0;       ///< [m] of clouds: one point for each cell that wide; 0: all points
    double cell = 0.0;       ///< [m] of nav2 and OctoMap: width of a cell; 0: that of the output
    // Of nav2:
    double robot_height = 1.5;  ///< [m] what hangs higher above the floor is no obstacle
    double step = 0.1;          ///< [m] what the robot may climb
    int storey = 0;             ///< which floor, 1 is the lowest of the path; 0: the only one
    bool keep_unknown = true;   ///< map.keep_unknown of the result whose labels are written
};

}  // namespace dynamic_filter::app
