// SPDX-License-Identifier: MIT
#pragma once

#include "commands/render.hpp"
#include "draw/canvas.hpp"
#include "dynamic_filter/settings.hpp"

namespace dynamic_filter::app {

/// As the options say: from above or from aside, so that the box fits a picture of that size.
Camera camera_for(const Eigen::AlignedBox3f& box, int width, int height,
                  const RenderOptions& options);

/// The front-end and the back-end at work, as an animated WebP: above, the newest scan with its
/// instant verdict; below, the map so far by the evidence so far.
void animate_cleaning(const io::Recording& recording, const Config& config,
                      const RenderOptions& options);

}  // namespace dynamic_filter::app
