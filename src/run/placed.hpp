// SPDX-License-Identifier: MIT
/// The file recording.json of a result: how the run read the recording, and where it placed the
/// points. With it, a command that takes the result places the points as the run did.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "dynamic_filter/recording.hpp"
#include "recording/data_options.hpp"

namespace dynamic_filter::app {

inline constexpr const char* kPlacedFile = "recording.json";

struct Placed {
    DataOptions how;          ///< options of the run
    std::string fingerprint;  ///< of the recording as it was opened with them
    bool has_times = false;   ///< true: scans had the times of their points
    bool deskewed = false;    ///< true: see io::deskewed()
    std::optional<Sweep> sweep{};
    std::optional<Eigen::Vector3d> sensor_at{};  ///< [m] see io::Info
    /// Poses that were found or refined, and velocities; empty: those of the recording stayed.
    std::vector<std::optional<Tracked>> tracked{};

    /// True if the motion within scans was undone.
    [[nodiscard]] bool undoes_motion() const { return deskewed || has_times; }
};

/// By this a recording is known again wherever it lies: its scans, poses and stamps, and how far
/// the points of its first scan reach.
std::string fingerprint_of(const io::Recording& recording);

/// `recording`: as it was filtered; the other two as in Placed.
Placed placed_of(const io::Recording& recording, const DataOptions& how,
                 const std::string& fingerprint);

void write_placed(const std::filesystem::path& folder, const Placed& placed);
/// Empty if the folder holds no such file. Throws InputError if the file is damaged.
std::optional<Placed> read_placed(const std::filesystem::path& folder);

/// A recording that was opened with `placed.how`, with poses and points as the run had them.
io::Recording placed_again(io::Recording recording, const Placed& placed);

}  // namespace dynamic_filter::app
