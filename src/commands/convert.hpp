// SPDX-License-Identifier: MIT
#pragma once

#include "export/convert_options.hpp"

namespace dynamic_filter::app {

/// Writes a recording, a cloud or the map of several drives in another format. Returns the exit
/// code; throws an Error.
int convert(const ConvertOptions& options);

}  // namespace dynamic_filter::app
