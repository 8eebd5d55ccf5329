// SPDX-License-Identifier: MIT
/// The arguments by which ROS 2 starts a node, `--ros-args ...`, and its files of parameters.
#pragma once

#include <string>
#include <vector>

#include "settings/config_file.hpp"

namespace dynamic_filter::live {

/// The settings that stand in the words after `--ros-args`, in the order in which they take effect:
/// the node's name and namespace as output.prefix, `--params-file FILE`, and `-p NAME:=VALUE`.
/// Logging and security options of ROS 2 are accepted without effect, as is the parameter
/// use_sim_time, because the stamps of the scans are the only clock. Throws ConfigError for an
/// option that ROS 2 has not got, for a remapped topic, for which a setting is named, and for a
/// file that cannot be read or is none of parameters.
std::vector<app::Assignment> ros2_parameters(const std::vector<std::string>& words);

}  // namespace dynamic_filter::live
