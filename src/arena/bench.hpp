// SPDX-License-Identifier: MIT
/// Filters and scores the recordings of an arena.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace dynamic_filter::app {

struct BenchOptions {
    std::string arena;
    std::filesystem::path data;     ///< the folder of the data set
    std::filesystem::path output;   ///< of the runs, table.md and table.json
    std::vector<std::string> only;  ///< entries; empty: all that are there
    std::vector<std::string> presets{"default", "paper"};
    /// "NAME=PATH": results of other programs, PATH/ENTRY/*.label or PATH/ENTRY.pcd.
    std::vector<std::string> peers;
    std::string poses;        ///< name of a file in the folder of an entry, "none", or empty
    bool no_run = false;      ///< score peers only
    bool submission = false;  ///< also leave what the arena asks for, in OUTPUT/submission
    int threads = 0;
    bool quiet = false;
};

/// Returns the exit code. Runs that are complete are not repeated, and those that were killed go
/// on. Throws an Error.
int bench(const BenchOptions& options);

/// Prints what the arena needs, and what others published.
void tell_arena(const std::string& arena);

/// Writes simulated recordings of the entries in the layout of the arena into the folder, which
/// must not exist or be empty.
void write_twins(const BenchOptions& options);

}  // namespace dynamic_filter::app
