// SPDX-License-Identifier: MIT
#include "dynamic_filter/scores.hpp"

#include <cmath>

namespace dynamic_filter::eval {

PointScore point_score(const CoverCount& c) {
    PointScore score;
    if (c.still > 0) {
        score.sa = static_cast<double>(c.covered_still) / static_cast<double>(c.still);
    }
    if (c.dynamic > 0) {
        score.da = 1.0 - static_cast<double>(c.covered_dynamic) / static_cast<double>(c.dynamic);
    }
    if (score.sa && score.da) {
        const double sum = *score.sa + *score.da;
        score.aa = std::sqrt(*score.sa * *score.da);
        score.ha = sum > 0 ? 2.0 * *score.sa * *score.da / sum : 0.0;
    }
    return score;
}

void CoverCount::add(Label truth, bool covered) {
    const bool is_dynamic = truth == Label::dynamic;
    (is_dynamic ? dynamic : still) += 1;
    if (covered) (is_dynamic ? covered_dynamic : covered_still) += 1;
}

void CoverCount::add(const CoverCount& other) {
    still += other.still;
    dynamic += other.dynamic;
    covered_still += other.covered_still;
    covered_dynamic += other.covered_dynamic;
}

void Confusion::add(const Confusion& other) {
    true_positive += other.true_positive;
    false_positive += other.false_positive;
    false_negative += other.false_negative;
}

void Confusion::add(Label truth, Label verdict) {
    const bool is = truth == Label::dynamic, said = verdict == Label::dynamic;
    if (is && said) ++true_positive;
    if (!is && said) ++false_positive;
    if (is && !said) ++false_negative;
}

std::optional<double> Confusion::iou() const {
    const std::size_t all = true_positive + false_positive + false_negative;
    if (all == 0) return std::nullopt;
    return static_cast<double>(true_positive) / static_cast<double>(all);
}

}  // namespace dynamic_filter::eval
