// SPDX-License-Identifier: MIT
/// What benchmarks ask of a program that is to be listed.
#pragma once

#include "arena/arena.hpp"

namespace dynamic_filter::app {

/// Throws ConfigError if the arena asks for nothing.
void refuse_without_submission(const Arena& arena);

/// Writes the result of a trial below `folder`, in the layout that the arena asks for, and checks
/// it by the rules that its programs do not check themselves: a value for each point of each scan
/// with ground truth, and no map without points or with points that are not finite. `labels`: of
/// the run. Throws an Error.
void write_submission(const Arena& arena, const Trial& trial, const io::Recording& recording,
                      const std::filesystem::path& labels, const std::filesystem::path& folder);

}  // namespace dynamic_filter::app
