// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "dynamic_filter/scores.hpp"
#include "recording/data_options.hpp"
#include "score/knowable_scores.hpp"
#include "score/scored_part.hpp"

namespace dynamic_filter::app {

struct EvalOptions {
    DataOptions truth;
    std::optional<std::filesystem::path> labels, map, json;
    double voxel = eval::kVoxelSize;
    ScoredPart part;
    std::string protocol = "all";  ///< of protocol_names()
};

struct Evaluation {
    eval::Scores scores;
    std::size_t scans = 0;     ///< of the recording
    std::size_t to_score = 0;  ///< all, or those with ground truth if it is sparse on purpose
    /// Those of them that are unreadable, or without labels or ground truth.
    std::vector<std::string> left_out{};
    /// Of labels, if the recording has a folder `knowable`.
    std::optional<eval::KnowableScores> knowable{};
    ScoredPart part{};
    std::string note{};  ///< how the recording was read for the result; may be empty
};

/// Computes what `eval` prints, and throws the same errors.
Evaluation scores_of(const EvalOptions& options);

/// What `eval --json` writes.
nlohmann::ordered_json to_json(const Evaluation& evaluation);

}  // namespace dynamic_filter::app
