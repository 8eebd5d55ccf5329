// SPDX-License-Identifier: MIT
/// From recordings to a result.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "recording/data_options.hpp"
#include "run/summary.hpp"
#include "settings/config_file.hpp"

namespace dynamic_filter::app {

inline constexpr std::size_t kFewestTileVoxels = 1000;  ///< smaller tiles are mostly halo

struct RunOptions {
    std::vector<std::filesystem::path> recordings;  ///< one or several, or lists of them
    DataOptions data;                               ///< how to read them; with the only recording
    std::optional<std::filesystem::path> output;
    ConfigOptions config;
    int threads = 0;
    std::string refine = "auto";  ///< auto, on or off
    bool online = false;
    double speed = 1.0;  ///< of online: times the sensor's rate; 0: as fast as it can
    bool overwrite = false, resume = false;
    std::optional<std::filesystem::path> edits;  ///< empty: those in the output folder, if any
    bool maps = true, report = true;             ///< left beside the labels
    bool view = false;
    std::uint16_t port = 0;  ///< of the view; 0: any
    // Several recordings of one world, or one that is larger than memory; see docs/city.md.
    std::string part;                           ///< "I/N", or empty: all tiles, and the merge
    std::string memory;                         ///< "1.5G", or empty
    std::optional<std::filesystem::path> plan;  ///< left by `plan -o`
    std::size_t tile_voxels = 1'500'000;        ///< most in a tile
    bool mpi = false;                           ///< shares the tiles with other processes
    // A map that is kept up to date; see docs/upkeep.md.
    std::optional<std::filesystem::path> update;  ///< output of an earlier run: goes on with it
    bool trusts_poses = false;    ///< of an update: goes on if drives seem not to fit
    bool keeps_evidence = false;  ///< in the output, for the next update

    bool quiet = false;   ///< says only what is wrong
    bool catches = true;  ///< interrupts; otherwise the caller does
    std::string after;    ///< stage of timing.json for what the process did before; may be empty
};

struct MergeOptions {
    std::vector<std::filesystem::path> parts;  ///< output folders of `run --part`
    std::filesystem::path output;
    int threads = 0;
    bool overwrite = false, quiet = false;
};

/// What a run leaves in the process.
struct RunResult {
    int exit_code = 0;
    std::vector<RunSummary> recordings;  ///< empty if the run is not complete
};

/// Filters one recording or several. Throws an Error.
RunResult run(const RunOptions& options);
/// Puts the parts of a run together. Returns the exit code; throws an Error.
int merge(const MergeOptions& options);

}  // namespace dynamic_filter::app
