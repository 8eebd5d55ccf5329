// SPDX-License-Identifier: MIT
/// @file
/// Scores per point: those of DynamicMap_Benchmark, and the moving IoU.
///
/// - Units: fractions 0..1.
/// - Ownership: values.
/// - Threads: plain data and pure functions.
/// - Errors: none; what cannot be said is empty.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "dynamic_filter/types.hpp"

namespace dynamic_filter::eval {

/// Fractions; empty where the ground truth holds nothing of that kind (or no labels were given).
struct PointScore {
    std::optional<double> sa;   ///< 0..1: static points within 0.05 m of the clean map
    std::optional<double> da;   ///< 0..1: dynamic points farther than that
    std::optional<double> aa;   ///< 0..1: sqrt(sa * da)
    std::optional<double> ha;   ///< 0..1: harmonic mean of sa and da
    std::optional<double> iou;  ///< 0..1: of the dynamic class: TP / (TP + FP + FN)
};

/// Ground-truth points of each kind, and how many of them lie within the distance of the clean map.
struct CoverCount {
    std::size_t still = 0;            ///< points of static things
    std::size_t dynamic = 0;          ///< points of moving things
    std::size_t covered_still = 0;    ///< of the static ones, near the clean map
    std::size_t covered_dynamic = 0;  ///< of the moving ones, near the clean map
    /// One point more, whose truth is known.
    void add(Label truth, bool covered);
};

/// The scores of such counts, without IoU.
PointScore point_score(const CoverCount& count);

/// Points of the dynamic class: said to be, and being so.
struct Confusion {
    std::size_t true_positive = 0;   ///< said, and are
    std::size_t false_positive = 0;  ///< said, and are not
    std::size_t false_negative = 0;  ///< not said, and are
    /// One point more. Points of unknown truth must be left out by the caller: unknown counts as
    /// not dynamic.
    void add(Label truth, Label verdict);
    /// TP / (TP + FP + FN), 0..1; empty if nothing is or was said to be dynamic.
    [[nodiscard]] std::optional<double> iou() const;
};

}  // namespace dynamic_filter::eval
