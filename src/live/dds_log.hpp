// SPDX-License-Identifier: MIT
/// What Cyclone DDS complains of, for all domains of this process. Thread-safe.
#pragma once

#include <string>
#include <vector>

namespace dynamic_filter::live {

/// From now on, complaints are kept instead of printed. Faulty packets would fill the terminal.
void keep_dds_log();

/// The complaints since the last call; of those that begin alike, one, and a few altogether.
std::vector<std::string> pop_dds_log();

}  // namespace dynamic_filter::live
