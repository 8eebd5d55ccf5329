// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
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
    bool quiet = false;      ///< neither progress nor what was written is told
    std::string box;         ///< two corners in the world, as box_of() reads them; may be empty
    double max_range = 0.0;  ///< [m] from the sensor; 0: any
    std::string only;        ///< "static" or "dynamic"; empty: all points
    double thin = 0.0;       ///< [m] of clouds: one point for each cell that wide; 0: all points
    bool normals = false;    ///< of clouds: the surface's normal at each point
    bool ground = false;     ///< of clouds: class of LAS for what lies on the ground
    std::optional<int> moving_class;  ///< of clouds: class of LAS for what moves; 22
    double cell = 0.0;  ///< [m] of nav2 and OctoMap: width of a cell; 0: that of the output
    // Of nav2:
    double robot_height = 1.5;  ///< [m] what hangs higher above the floor is no obstacle
    double step = 0.1;          ///< [m] what the robot may climb
    int storey = 0;             ///< which floor, 1 is the lowest of the path; 0: the only one
    // Known when the recording is open:
    Eigen::Vector3d sensor =
        Eigen::Vector3d::Zero();  ///< [m] in the frame of the scans that are written
    bool keep_unknown = true;     ///< map.keep_unknown of the result whose labels are written
};

/// A number of ConvertOptions, for the command and for Python.
struct NumberOption {
    const char*
        name;  ///< as a word of Python; the command's option is "--max-range" for "max_range"
    double low, high;  ///< if it is given
    const char* help;
};

/// Calls `visit(row, member)` for each number.
template <class Visit>
void visit_numbers(ConvertOptions& options, const Visit& visit) {
    visit(NumberOption{"max_range", 0.1, 1e6,
                       "of a recording: what lies farther from the sensor counts as not measured "
                       "[m]"},
          options.max_range);
    visit(NumberOption{"thin", 0.001, 100.0,
                       "of a cloud: one point for each cell of this width [m], the one nearest to "
                       "the sensor"},
          options.thin);
    visit(NumberOption{"cell", 0.02, 2.0,
                       "width of a cell [m]: of OctoMap (default 0.1), and with --to nav2 (default "
                       "0.05)"},
          options.cell);
    visit(NumberOption{"robot_height", 0.05, 10.0,
                       "with --to nav2: what hangs higher above the floor is no obstacle [m]"},
          options.robot_height);
    visit(NumberOption{"step", 0.01, 0.5, "with --to nav2: what the robot may climb [m]"},
          options.step);
}

}  // namespace dynamic_filter::app
