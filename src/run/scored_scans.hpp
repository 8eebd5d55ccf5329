// SPDX-License-Identifier: MIT
/// The scans of a recording as the scores take them.
#pragma once

#include <functional>
#include <optional>

#include "dynamic_filter/recording.hpp"
#include "dynamic_filter/scores.hpp"
#include "score/scored_part.hpp"

namespace dynamic_filter::app {

/// A scan with ground truth as the scores take it, without a verdict. Points outside of `part`
/// get an unknown truth, so that every score leaves them out.
eval::LabelledScan labelled(const io::FullScan& scan, const Eigen::Vector3d& origin,
                            const ScoredPart& part = {});

/// For the scores: scans with ground truth, verdicts from `labels_of` (may be empty).
/// Rejected scans (unreadable, or without labels) give nothing.
eval::ScanSource scan_source(const io::Recording& recording, const Eigen::Vector3d& origin,
                             std::function<std::optional<Labels>(std::size_t)> labels_of,
                             const ScoredPart& part = {});

}  // namespace dynamic_filter::app
