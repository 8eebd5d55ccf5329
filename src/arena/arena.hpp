// SPDX-License-Identifier: MIT
/// Public benchmarks: where their data lie, how they score, and what others reached. docs/arenas.md
/// has the rules in words.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "dynamic_filter/recording.hpp"
#include "recording/data_options.hpp"

namespace dynamic_filter::app {

/// A recording of an arena, as it is filtered and scored.
struct Trial {
    std::string entry;                 ///< its name in tables: "00"
    DataOptions data{};                ///< how the program reads it
    std::vector<std::string> notes{};  ///< what a reader of the table must know, such as the poses
    /// The scans with ground truth, by index; empty: all of them.
    std::vector<std::size_t> scored{};
    /// Those of them that are the published split; empty: all of them.
    std::vector<std::size_t> split{};
    /// Ground truth of scan i in place of the recording's own; or empty. Throws InputError.
    std::function<Labels(const io::Recording&, std::size_t i, const io::FullScan&)> truth{};
    /// From the pose of a scan to that in the map frame in which the arena scores; or empty.
    std::function<Pose(const Pose& T_world_sensor)> T_map_sensor{};
};

/// What is scored: the labels of scans, or a clean map in the world frame.
struct Estimate {
    std::optional<std::filesystem::path> labels, map;
};

/// 0..1, parallel to the columns of the arena; empty where undefined.
using ArenaScores = std::vector<std::optional<double>>;

struct ArenaColumn {
    std::string name;
    bool is_percent = true;
};

/// A figure that others published, by the rule of the arena.
struct PublishedFigure {
    std::string entry, method;
    ArenaScores scores;  ///< parallel to the columns
    std::string how;     ///< "online", "offline", "trained"
    std::string source;
};

struct Arena {
    std::string name;                  ///< "erasor"
    std::string title;                 ///< "SemanticKITTI by ERASOR's rule"
    std::vector<std::string> entries;  ///< those that are usually published
    std::vector<ArenaColumn> columns;
    std::string layout;    ///< where the data lie below the folder that the user gives
    std::string download;  ///< where to get them
    /// Nothing if the entry is not there. Throws InputError for one that is not whole.
    std::optional<Trial> (*find)(const std::filesystem::path& root, const std::string& entry);
    /// Throws InputError if the truth or the estimate does not fit the scans.
    ArenaScores (*score)(const Trial&, const io::Recording&, const Estimate&);
    /// Writes a small simulated recording in the layout of the data set.
    void (*write_twin)(const std::filesystem::path& root, const std::string& entry);
    /// The entries that lie there, if they are not always the same; or nullptr.
    std::vector<std::string> (*entries_in)(const std::filesystem::path& root) = nullptr;
};

/// All of them, in the order of the help.
const std::vector<Arena>& arenas();
std::vector<std::string> arena_names();
/// Throws ConfigError if there is none of that name.
const Arena& arena_of(const std::string& name);

/// "station" for "station/sequence_1".
std::string group_of_entry(const std::string& entry);

/// What others published for the entry, or for the group of entries of which it is one.
std::vector<PublishedFigure> published_figures(const std::string& arena, const std::string& entry);

}  // namespace dynamic_filter::app
