// SPDX-License-Identifier: MIT
/// Scores as others publish them, so that a row of a table can be repeated.
#pragma once

#include <string>
#include <vector>

#include "dynamic_filter/scores.hpp"

namespace dynamic_filter::app {

/// The values of `eval --protocol`.
std::vector<std::string> protocol_names();

/// The scores of one protocol with its rule in words, or of "all" as a run prints them. Those of
/// ERASOR must be among the scores, as the reading "erasor" of voxels.
/// `voxel_size` [m] is what the scores were counted with.
std::string protocol_table(const std::string& protocol, const eval::Scores& scores,
                           double voxel_size);

}  // namespace dynamic_filter::app
