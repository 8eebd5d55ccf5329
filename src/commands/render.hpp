// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "recording/data_options.hpp"
#include "settings/config_file.hpp"

namespace dynamic_filter::app {

struct RenderOptions {
    DataOptions data;  ///< output folder of a run, cloud, or recording to animate
    std::filesystem::path output;
    bool from_above = false, clean = false;
    int width = 1600, height = 1000;
    double azimuth_deg = 60.0, elevation_deg = 35.0, point_size = 1.5;
    int pictures = 60;  ///< of an animation
    std::string box;    ///< two corners in the world, as box_of() reads them; may be empty
    ConfigOptions config;
};

/// Draws a map, or how a recording is cleaned. Returns the exit code; throws an Error.
int render(const RenderOptions& options);

}  // namespace dynamic_filter::app
