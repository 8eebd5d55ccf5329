// SPDX-License-Identifier: MIT
/// One point for each cell of a grid: the best one, as it was measured.
#pragma once

#include <tsl/robin_map.h>

#include <optional>
#include <span>
#include <vector>

#include "geometry/voxel.hpp"

namespace dynamic_filter::app {

class ThinnedRecords {
public:
    /// `cell`: width of a cell [m].
    explicit ThinnedRecords(double cell) : cell_(cell) {}

    /// Keeps the record, as long as the others, if the cell of `place` [m] has none, or one of a
    /// greater rank. Cells of points that move are apart from those of points that stand. Throws
    /// ConfigError if points lie farther apart than a million cells.
    void add(const Eigen::Vector3d& place, float rank, bool moves,
             std::span<const std::byte> record);
    /// In the order in which their cells were first met.
    [[nodiscard]] const std::vector<std::byte>& records() const { return records_; }

    /// How far the place is from the middle of its cell [cells].
    [[nodiscard]] float distance_to_middle(const Eigen::Vector3d& place) const;

private:
    struct Best {
        std::size_t at;  // [bytes]
        float rank;
    };
    double cell_;
    std::optional<Eigen::Vector3d> first_;  // [cells]
    tsl::robin_map<VoxelKey, Best, VoxelHash> best_;
    std::vector<std::byte> records_;
};

}  // namespace dynamic_filter::app
