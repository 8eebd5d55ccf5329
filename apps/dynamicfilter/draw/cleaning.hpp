// SPDX-License-Identifier: MIT
#pragma once

#include "commands.hpp"
#include "dynamic_filter/config.hpp"

namespace dynamic_filter::app {

/// The front-end and the back-end at work, as an animated WebP: above, the newest scan with its
/// instant verdict; below, the map so far by the evidence so far.
void animate_cleaning(const io::Sequence& sequence, const Config& config,
                      const RenderOptions& options);

}  // namespace dynamic_filter::app
