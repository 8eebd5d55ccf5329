// SPDX-License-Identifier: MIT
#include "thinned_cloud.hpp"

#include <algorithm>

namespace dynamic_filter::app {

void ThinnedCloud::add(const ShownPoint& point) {
    if (spacing_ > 0.0F && !is_first_in_cube(point)) return;
    points_.push_back(point);
    if (points_.size() > most_) thin();
}

bool ThinnedCloud::is_first_in_cube(const ShownPoint& point) {
    const auto cell = cell_of(point.position, 1.0F / spacing_);
    return cell && taken_[point.verdict & 3U].insert(pack(*cell)).second;
}

/// To well below the bound, so that it is rarely done.
void ThinnedCloud::thin() {
    constexpr float kFinest = 0.02F, kGrowth = 1.4F;
    while (points_.size() > most_ - most_ / 4) {
        spacing_ = spacing_ > 0.0F ? kGrowth * spacing_ : kFinest;
        for (auto& taken : taken_) taken.clear();
        std::erase_if(points_, [&](const ShownPoint& p) { return !is_first_in_cube(p); });
    }
}

}  // namespace dynamic_filter::app
