// SPDX-License-Identifier: MIT
/// Scores per point: those of DynamicMap_Benchmark, and the moving IoU.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "dynamic_filter/types.hpp"

namespace dynamic_filter::eval {

/// Fractions; empty where the ground truth holds nothing of that kind (or no labels were given).
struct PointScore {
    std::optional<double> sa;   ///< static points within 0.05 m of the clean map
    std::optional<double> da;   ///< dynamic points farther than that
    std::optional<double> aa;   ///< sqrt(sa * da)
    std::optional<double> ha;   ///< harmonic mean of sa and da
    std::optional<double> iou;  ///< of the dynamic class: TP / (TP + FP + FN)
};

/// Ground-truth points of each kind, and how many of them lie within the distance of the clean map.
struct CoverCount {
    std::size_t still = 0, dynamic = 0, covered_still = 0, covered_dynamic = 0;
};

PointScore point_score(const CoverCount& count);

/// TP / (TP + FP + FN) of the dynamic class; empty if nothing is or was said to be dynamic.
struct Confusion {
    std::size_t true_positive = 0, false_positive = 0, false_negative = 0;
    void add(Label truth, Label verdict);
    [[nodiscard]] std::optional<double> iou() const;
};

}  // namespace dynamic_filter::eval
