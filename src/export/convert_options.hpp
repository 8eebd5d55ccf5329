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
    std::string to;      ///< layout of a folder: kitti, benchmark, autoware, 3dtiles or las; empty:
                         ///< by the output's name
    std::string origin;  ///< of 3dtiles: LAT,LON[,HEIGHT]; may be empty
    bool overwrite = false;
    bool keep_unknown = true;  ///< map.keep_unknown of the result whose labels are written
};

}  // namespace dynamic_filter::app
