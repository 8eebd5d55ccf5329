// SPDX-License-Identifier: MIT
/// @file
/// Scores per point: the accuracies of DynamicMap_Benchmark, and the moving IoU.
///
/// - Units: fractions 0..1.
/// - Ownership: values.
/// - Threads: plain data and pure functions.
/// - Errors: none; a score that is not defined is empty.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "dynamic_filter/types.hpp"

namespace dynamic_filter::eval {

/// Scores per point. A score is empty if the ground truth has no point of that kind, or if no
/// labels were given.
struct PointScore {
    /// Static accuracy, 0..1: share of static points within 0.05 m of the clean map.
    std::optional<double> sa;
    /// Dynamic accuracy, 0..1: share of dynamic points farther than that from it.
    std::optional<double> da;
    std::optional<double> aa;   ///< associated accuracy, 0..1: sqrt(sa * da)
    std::optional<double> ha;   ///< harmonic accuracy, 0..1: harmonic mean of sa and da
    std::optional<double> iou;  ///< moving IoU, 0..1: TP / (TP + FP + FN) of the dynamic class
};

/// Counts the ground-truth points of each kind, and those of them that are covered: they lie within
/// the distance (0.05 m) of the clean map.
struct CoverCount {
    std::size_t still = 0;            ///< static points
    std::size_t dynamic = 0;          ///< dynamic points
    std::size_t covered_still = 0;    ///< covered static points
    std::size_t covered_dynamic = 0;  ///< covered dynamic points
    /// Adds one point whose ground truth is known.
    void add(Label truth, bool covered);
    /// Adds the points of another count.
    void add(const CoverCount& other);
};

/// Computes the scores from the counts; the IoU stays empty.
PointScore point_score(const CoverCount& count);

/// Counts of the dynamic class, from which its IoU is computed.
struct Confusion {
    std::size_t true_positive = 0;   ///< labelled dynamic, and dynamic
    std::size_t false_positive = 0;  ///< labelled dynamic, but not dynamic
    std::size_t false_negative = 0;  ///< not labelled dynamic, but dynamic
    /// Adds one point. The caller must leave out points of unknown ground truth, because unknown
    /// counts as not dynamic.
    void add(Label truth, Label verdict);
    /// Adds the points of another count.
    void add(const Confusion& other);
    /// TP / (TP + FP + FN), 0..1; empty if no point is dynamic or labelled dynamic.
    [[nodiscard]] std::optional<double> iou() const;
};

}  // namespace dynamic_filter::eval
