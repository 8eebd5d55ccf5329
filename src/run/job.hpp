// SPDX-License-Identifier: MIT
/// What a run works on: recordings, settings, and the mark by which its files are known again.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "dynamic_filter/settings.hpp"
#include "recording/drives.hpp"
#include "run/part_file.hpp"
#include "run/plan.hpp"
#include "run/remarks.hpp"
#include "run/run.hpp"

namespace dynamic_filter::app {

/// What a run over tiles is begun with.
struct Begun {
    std::string tiles;                       ///< the version, and the size of the tiles
    std::vector<std::string> states, poses;  ///< by drive
    std::string reading;                     ///< how the recordings are read, and the settings

    /// As if there were only the first `drives` drives.
    [[nodiscard]] std::string mark(std::size_t drives) const;
};

/// The run with which an update goes on.
struct EarlierRun {
    std::filesystem::path folder;  ///< its output
    std::size_t drives = 0;        ///< so many of the drives are its own
};

struct Job {
    Config config;
    std::vector<DriveSource> sources;  ///< the recordings as they were given
    std::vector<Drive> drives;
    std::vector<std::string> fingerprints;  ///< of the drives as they were opened; placed.hpp
    /// Of the only recording of a job in memory, by scan, if its poses were found or refined.
    std::vector<std::optional<Tracked>> tracked;
    bool has_given_poses = false;  ///< of that recording: it came with poses
    Remarks remarks;               ///< on that recording, as far as it shows beforehand
    /// True: filtered tile by tile, which needs a plan. False: one recording, in memory.
    bool is_tiled = false;
    std::optional<PartNumber> part;  ///< empty: all tiles
    Plan plan;                       ///< of a tiled job; empty until it is made or read
    /// What the run was begun with: the mark of the files of its tiles. For one recording in
    /// memory it is known after choose_job_motion().
    std::string mark;
    Begun begun{};  ///< of a tiled job
    bool keeps_evidence = false;
    std::optional<EarlierRun> earlier{};  ///< of an update

    /// The first drive that the run labels: those of an earlier run have their labels there.
    [[nodiscard]] std::uint32_t first_new() const {
        return earlier ? static_cast<std::uint32_t>(earlier->drives) : 0;
    }
};

/// True if the options ask for several recordings, a part or a limit of memory.
bool is_tiled(const RunOptions& options);

/// Opens recordings and settings; writes nothing. Throws ConfigError if options contradict each
/// other.
Job open_job(const RunOptions& options);
/// The job of a run over tiles of these recordings.
Job open_tiled_job(const RunOptions& options, std::vector<DriveSource> sources);

/// The only recording of a job in memory: undoes its motion and refines its poses where that is
/// better, as the options say. What was chosen is among its notes afterwards.
void choose_job_motion(Job& job, const RunOptions& options);

/// What the folder of the result was begun with, for run_state.hpp.
std::string mark_of_output(const Job& job, const RunOptions& options);

/// Where the files of a drive go: a single drive has the folder of the result.
std::filesystem::path folder_of(const Job& job, std::size_t drive,
                                const std::filesystem::path& output);

/// Tells the user what is known of the recordings before they are filtered.
void tell_remarks(const Job& job, bool quiet);

}  // namespace dynamic_filter::app
