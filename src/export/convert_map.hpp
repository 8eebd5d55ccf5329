// SPDX-License-Identifier: MIT
/// What `convert` makes of the map of many drives.
#pragma once

#include "export/convert_options.hpp"

namespace dynamic_filter::app {

/// Writes the output that --to names: 3dtiles, las or autoware. Returns the exit code. Throws
/// ConfigError, InputError and OutputError; then nothing is left in the output folder.
int convert_map(const ConvertOptions& options);

}  // namespace dynamic_filter::app
