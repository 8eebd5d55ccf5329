// SPDX-License-Identifier: MIT
#pragma once

#include "commands/options.hpp"
#include "live/live.hpp"

namespace dynamic_filter::app {

/// The options that `dynamicfilter live` and the ROS 1 node share. `options` must outlive
/// `command`.
void add_live_options(Command& command, live::LiveOptions& options);

}  // namespace dynamic_filter::app
