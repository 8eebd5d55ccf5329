// SPDX-License-Identifier: MIT
/// What `convert` makes of scans.
#pragma once

#include <string>

#include "export/convert_options.hpp"

namespace dynamic_filter::app {

/// Prints what a format could not hold, or what was wrong with its source; nothing if it is empty.
void tell_note(const std::string& note);

/// Writes a recording. Returns the exit code; throws an Error, and leaves no file then.
int convert_recording(const ConvertOptions& options);

/// Whether the output is made of the scans of all drives of a map, with their labels.
bool is_of_drives(const ConvertOptions& options);
/// Writes the drives of the map `options.data.data` as one output. The recordings are read where
/// the run found them. Returns and throws as convert_recording().
int convert_drives(const ConvertOptions& options);

}  // namespace dynamic_filter::app
