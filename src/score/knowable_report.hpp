// SPDX-License-Identifier: MIT
/// How much was removed of what could be known, as JSON and as text.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "score/knowable_scores.hpp"

namespace dynamic_filter::app {

/// {"groups": {name: {points, points_removed, voxels, rr}}, "bins": [{from, to, points, ...}]}:
/// numbers and shares, null where undefined; `to` of the last bin is null.
nlohmann::ordered_json to_json(const eval::KnowableScores& scores);

/// A row for each group.
std::string table(const eval::KnowableScores& scores);

}  // namespace dynamic_filter::app
