// SPDX-License-Identifier: MIT
#include "dynamic_filter/back_end/normals.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "dynamic_filter/front_end/submap.hpp"
#include "dynamic_filter/geometry/principal_axes.hpp"
#include "dynamic_filter/parallel.hpp"

namespace dynamic_filter {

namespace {

/// A submap's points by voxel, voxels in ascending order of their keys: along z they are
/// neighbours.
struct VoxelTable {
    std::vector<VoxelKey> keys;
    std::vector<Moments> moments;
    std::vector<std::uint32_t> voxel_of_point;  ///< into keys; UINT32_MAX beyond the keys' reach
};

VoxelTable tabulate(std::span<const Point> points, float voxel_size) {
    std::vector<std::pair<VoxelKey, std::uint32_t>> order;
    order.reserve(points.size());
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        if (const auto key = voxel_of(points[i], voxel_size)) order.emplace_back(*key, i);
    }
    std::sort(order.begin(), order.end());
    VoxelTable table;
    table.voxel_of_point.assign(points.size(), UINT32_MAX);
    for (const auto& [key, i] : order) {
        if (table.keys.empty() || table.keys.back() != key) {
            table.keys.push_back(key);
            table.moments.emplace_back();
        }
        table.moments.back().add(points[i]);
        table.voxel_of_point[i] = static_cast<std::uint32_t>(table.keys.size() - 1);
    }
    return table;
}

/// Nine cursors, one per neighbouring column along z. While the voxels go by in order, each cursor
/// only moves forward: neighbours without a search.
class NeighborColumns {
public:
    NeighborColumns(const VoxelTable& table, VoxelKey first) : table_(table) {
        for (std::size_t c = 0; c < 9; ++c) {
            const auto low = below(first, c);
            cursors_[c] = std::lower_bound(table.keys.begin(), table.keys.end(), low);
        }
    }
    /// Moments of the 27 voxels around `key`; keys must come in ascending order.
    Moments around(VoxelKey key) {
        Moments sum;
        for (std::size_t c = 0; c < 9; ++c) {
            const VoxelKey low = below(key, c);
            auto& cursor = cursors_[c];
            while (cursor != table_.keys.end() && *cursor < low) ++cursor;
            for (auto it = cursor; it != table_.keys.end() && *it <= low + 2; ++it) {
                sum += table_.moments[static_cast<std::size_t>(it - table_.keys.begin())];
            }
        }
        return sum;
    }

private:
    /// Key of the voxel one below (z) in column c. Keys are offset, so sums of fields stay
    /// positive.
    static VoxelKey below(VoxelKey key, std::size_t c) {
        const auto dx = static_cast<std::int64_t>(c / 3) - 1,
                   dy = static_cast<std::int64_t>(c % 3) - 1;
        return key + static_cast<VoxelKey>(dx * (std::int64_t{1} << 42) +
                                           dy * (std::int64_t{1} << 21) - 1);
    }
    const VoxelTable& table_;
    std::array<std::vector<VoxelKey>::const_iterator, 9> cursors_{};
};

}  // namespace

Points estimate_normals(std::span<const Point> points, float voxel_size) {
    const VoxelTable table = tabulate(points, voxel_size);
    Points normal_of_voxel(table.keys.size(), Point::Zero());
    parallel_for(table.keys.size(), 4096, [&](std::size_t begin, std::size_t end) {
        NeighborColumns columns(table, table.keys[begin]);
        for (std::size_t v = begin; v < end; ++v) {
            const auto axis = smallest_axis(columns.around(table.keys[v]));
            if (axis) normal_of_voxel[v] = axis->cast<float>();
        }
    });
    Points normals(points.size(), Point::Zero());
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (table.voxel_of_point[i] != UINT32_MAX)
            normals[i] = normal_of_voxel[table.voxel_of_point[i]];
    }
    return normals;
}

}  // namespace dynamic_filter
