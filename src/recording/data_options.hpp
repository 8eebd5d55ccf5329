// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "dynamic_filter/recording.hpp"

namespace dynamic_filter::app {

/// A recording, and how to read it.
struct DataOptions {
    std::filesystem::path data;
    std::string format;  ///< empty: recognised
    std::string pose_fix = "none", time_unit = "s";
    std::string deskew = "auto";  ///< auto, on or off
    io::OpenOptions open;
};

}  // namespace dynamic_filter::app
