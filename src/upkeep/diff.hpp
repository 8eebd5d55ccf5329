// SPDX-License-Identifier: MIT
/// What changed between two dates: came, went, and what nobody can tell.
#pragma once

#include <filesystem>

#include "run/run.hpp"

namespace dynamic_filter::app {

struct DiffOptions {
    std::filesystem::path old_run, new_run;  ///< output folders of runs
    std::filesystem::path output;
    int threads = 0;
    std::string memory;  ///< as RunOptions::memory
    bool overwrite = false, quiet = false;
};

/// Filters the drives of both runs together, and compares with the labels that each run has alone:
/// what rested at one date and is seen through at the other came or went. Returns the exit code.
/// Throws an Error; then nothing is left. If it was killed or interrupted, or the disk was full,
/// the filtered tiles stay beside the output (OUT.together), and the next call goes on with them.
/// The caller catches interrupts. Memory: the filter keeps to `memory`; afterwards the voxels of
/// both dates and the points that changed are held.
int diff(const DiffOptions& options);

}  // namespace dynamic_filter::app
