// SPDX-License-Identifier: MIT
/// Scores as JSON and as text.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "dynamic_filter/scores.hpp"
#include "dynamic_filter/stage_times.hpp"

namespace dynamic_filter::app {

/// null if it is not defined.
nlohmann::ordered_json share_or_null(const std::optional<double>& share);

/// {"voxel": {reading: {pr, rr, f1}}, "point": {sa, da, aa, ha, iou}}; null where undefined. With
/// scores on the shifted grid also "voxel_shifted", which is as "voxel".
nlohmann::ordered_json to_json(const eval::Scores& scores);

/// {stage: {count, mean, p50, p95, p99, max}} in milliseconds.
nlohmann::ordered_json to_json(const StageTimes& times);

/// Indented; names of files that are not UTF-8 get replacement characters.
std::string text_of(const nlohmann::ordered_json& json);

/// "95.63", or "-" where undefined.
std::string percent(const std::optional<double>& fraction);
std::string three_digits(const std::optional<double>& value);

/// A few lines: PR, RR, F1 by reading of mixed voxels and by grid, then the point scores.
std::string table(const eval::Scores& scores);

}  // namespace dynamic_filter::app
