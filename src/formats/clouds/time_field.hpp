// SPDX-License-Identifier: MIT
#pragma once

#include "dynamic_filter/cloud.hpp"

namespace dynamic_filter::io {

/// The field with the time of each point, under any of its usual names; nullptr if there is none.
const Field* time_field(const Cloud& cloud);

}  // namespace dynamic_filter::io
