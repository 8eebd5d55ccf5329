// SPDX-License-Identifier: MIT
#include "paper/normals.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

#include "dynamic_filter/parallel.hpp"
#include "geometry/map_points.hpp"
#include "geometry/principal_axes.hpp"
#include "geometry/voxel_index.hpp"

namespace dynamic_filter {

namespace {

/// The points of a submap ordered by voxel. Voxels are in ascending order of their keys, so that
/// neighbors along z are next to each other.
struct VoxelTable {
    std::vector<VoxelKey> keys;
    std::vector<Moments> moments;
    /// Index into keys; kNoVoxel: too far away for a key.
    std::vector<std::uint32_t> voxel_of_point;
};

VoxelTable tabulate(std::span<const Point> points, float voxel_size) {
    MapPoints in_map;
    to_voxels(points, voxel_size, in_map);
    VoxelIndex index;  // in the order of the first points, not sorted
    std::vector<Moments> moments;
    std::vector<std::uint32_t> id_of_point(points.size(), kNoVoxel);
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (in_map.keys[i] == kNoKey) continue;
        const std::uint32_t id = id_of_point[i] = index.insert(in_map.keys[i]);
        if (id == moments.size()) moments.emplace_back();
        moments[id].add(points[i]);
    }
    std::vector<std::uint32_t> order(index.size()), place(index.size());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t a, std::uint32_t b) { return index.key(a) < index.key(b); });
    VoxelTable table;
    for (const std::uint32_t id : order) {
        place[id] = static_cast<std::uint32_t>(table.keys.size());
        table.keys.push_back(index.key(id));
        table.moments.push_back(moments[id]);
    }
    for (const std::uint32_t id : id_of_point) {
        table.voxel_of_point.push_back(id == kNoVoxel ? kNoVoxel : place[id]);
    }
    return table;
}

/// Nine cursors, one per neighboring column along z. While the voxels are visited in order, each
/// cursor only moves forward, so neighbors are found without a search.
class NeighborColumns {
public:
    NeighborColumns(const VoxelTable& table, VoxelKey first) : table_(table) {
        for (std::size_t c = 0; c < 9; ++c) {
            const auto low = below(first, c);
            cursors_[c] = std::lower_bound(table.keys.begin(), table.keys.end(), low);
        }
    }
    /// Sums over the 27 voxels around `key`; keys must come in ascending order.
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
    /// Key of the voxel one step below (in z) in column c. Keys have an offset, so the sums of
    /// their fields stay positive.
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
        const std::uint32_t voxel = table.voxel_of_point[i];
        if (voxel != kNoVoxel) normals[i] = normal_of_voxel[voxel];
    }
    return normals;
}

}  // namespace dynamic_filter
