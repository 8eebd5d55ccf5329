// SPDX-License-Identifier: MIT
#include "page/thinned_cloud.hpp"

#include <algorithm>
#include <utility>

namespace dynamic_filter::app {

void ThinnedCloud::add(std::span<const ShownPoint> points) {
    constexpr std::size_t kTogether = 4096;
    for (std::size_t begin = 0; begin < points.size(); begin += kTogether) {
        keep_first_in_cubes(points.subspan(begin, std::min(kTogether, points.size() - begin)));
        if (points_.size() > most_) thin();
    }
}

void ThinnedCloud::keep_first_in_cubes(std::span<const ShownPoint> points) {
    if (spacing_ == 0.0F) {
        points_.insert(points_.end(), points.begin(), points.end());
        return;
    }
    std::vector<bool> is_first(points.size());
    std::vector<VoxelKey> keys;
    std::vector<std::size_t> at;  // of the keys, among the points
    for (std::uint8_t verdict = 0; verdict < taken_.size(); ++verdict) {
        keys.clear();
        at.clear();
        for (std::size_t i = 0; i < points.size(); ++i) {
            if ((points[i].verdict & 3U) != verdict) continue;
            const auto cell = cell_of(points[i].position, 1.0F / spacing_);
            if (!cell) continue;
            keys.push_back(pack(*cell));
            at.push_back(i);
        }
        std::size_t known = taken_[verdict].size();
        std::vector<std::uint32_t> cubes(keys.size());
        taken_[verdict].insert(keys, cubes);
        for (std::size_t k = 0; k < cubes.size(); ++k) {
            if (cubes[k] < known) continue;
            is_first[at[k]] = true;
            ++known;
        }
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (is_first[i]) points_.push_back(points[i]);
    }
}

/// To well below the bound, so that it is rarely done.
void ThinnedCloud::thin() {
    constexpr float kFinest = 0.02F, kGrowth = 1.4F;
    while (points_.size() > most_ - most_ / 4) {
        spacing_ = spacing_ > 0.0F ? kGrowth * spacing_ : kFinest;
        taken_ = {};
        keep_first_in_cubes(std::exchange(points_, {}));
    }
}

}  // namespace dynamic_filter::app
