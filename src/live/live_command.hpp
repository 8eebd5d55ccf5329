// SPDX-License-Identifier: MIT
#pragma once

#include "live/live.hpp"

namespace dynamic_filter::live {

/// `dynamicfilter live`: on ROS 2 by DDS. Returns the exit code.
int live_on_dds(const LiveOptions& options);

}  // namespace dynamic_filter::live
