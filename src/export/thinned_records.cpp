// SPDX-License-Identifier: MIT
#include "export/thinned_records.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "dynamic_filter/error.hpp"

namespace dynamic_filter::app {

void ThinnedRecords::add(const Eigen::Vector3d& place, float rank, bool moves,
                         std::span<const std::byte> record) {
    constexpr VoxelKey kMoves = VoxelKey{1} << 63U;  // a key has 63 bits
    const Eigen::Vector3d cell = (place / cell_).array().floor();
    if (!first_) first_ = cell;
    const Eigen::Vector3d from_first = cell - *first_;
    if (!(from_first.array().abs() < kCellLimit).all()) {
        throw ConfigError(
            fmt::format("--thin {}: points lie more than {:.0f} km apart, which is more cells than "
                        "there are numbers; use a larger one",
                        cell_, kCellLimit * cell_ / 1000.0));
    }
    const VoxelKey key = pack(from_first.cast<int>()) | (moves ? kMoves : 0);
    const auto [best, is_new] = best_.try_emplace(key, Best{records_.size(), rank});
    if (is_new) {
        records_.insert(records_.end(), record.begin(), record.end());
    } else if (rank < best->second.rank) {
        best.value().rank = rank;
        std::copy(record.begin(), record.end(),
                  records_.begin() + static_cast<std::ptrdiff_t>(best->second.at));
    }
}

float ThinnedRecords::distance_to_middle(const Eigen::Vector3d& place) const {
    const Eigen::Array3d in_cells = place.array() / cell_;
    return static_cast<float>((in_cells - in_cells.floor() - 0.5).matrix().norm());
}

}  // namespace dynamic_filter::app
