// SPDX-License-Identifier: MIT
/// What another process asks of a running filter, without ROS.
#pragma once

#include <string>

#include "live/dds_bus.hpp"

namespace dynamic_filter::live {

/// Calls the service of the filter with this prefix of outputs. `request` is "save", "save=NAME"
/// (a file beside that of --map), "reset", "pause" or "resume". The message of the answer is JSON
/// (see RequestTopics). Throws ConfigError for other requests, Error if no filter answers.
ServiceAnswer ask(DdsBus& bus, const std::string& prefix, const std::string& request);

}  // namespace dynamic_filter::live
