// SPDX-License-Identifier: MIT
/// A picture of a run's maps or of a cloud.
#pragma once

#include "commands/render.hpp"
#include "draw/png.hpp"

namespace dynamic_filter::app {

/// Draws `options.data.data`, the output folder of a run or a cloud file, as `options` say: what
/// stays is colored by height, what was removed is red. Throws InputError.
io::Image picture_of(const RenderOptions& options);

}  // namespace dynamic_filter::app
