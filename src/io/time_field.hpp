// SPDX-License-Identifier: MIT
#pragma once

#include "dynamic_filter/io/cloud.hpp"

namespace dynamic_filter::io {

/// The field that says when each point was measured, under any of its usual names; nullptr if there
/// is none.
const Field* time_field(const Cloud& cloud);

}  // namespace dynamic_filter::io
