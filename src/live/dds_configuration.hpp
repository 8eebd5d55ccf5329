// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace dynamic_filter::live {

/// The configuration of Cyclone DDS for DdsOptions::network. Throws ConfigError if that is no name.
std::string dds_configuration(const std::string& network, int domain);

}  // namespace dynamic_filter::live
