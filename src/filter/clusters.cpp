// SPDX-License-Identifier: MIT
#include "filter/clusters.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

namespace dynamic_filter {

namespace {

/// A square raster around the sensor, seen from above.
struct Raster {
    float reach, cell;  // [m]
    int side;           // cells per side

    Raster(float reach_m, float cell_m)
        : reach(reach_m), cell(cell_m), side(static_cast<int>(2.0F * reach_m / cell_m) + 1) {}
    [[nodiscard]] bool contains(const Point& p) const {
        return std::abs(p.x()) < reach && std::abs(p.y()) < reach;
    }
    [[nodiscard]] std::size_t at(const Point& p) const {
        const auto x = static_cast<std::size_t>((p.x() + reach) / cell);
        const auto y = static_cast<std::size_t>((p.y() + reach) / cell);
        return y * static_cast<std::size_t>(side) + x;
    }
    [[nodiscard]] std::size_t cells() const { return static_cast<std::size_t>(side * side); }
    /// Calls use(cell) for a cell and for the cells around it.
    template <class Use>
    void each_around(std::size_t center, const Use& use) const {
        const int x = static_cast<int>(center) % side, y = static_cast<int>(center) / side;
        for (int v = std::max(y - 1, 0); v <= std::min(y + 1, side - 1); ++v) {
            for (int u = std::max(x - 1, 0); u <= std::min(x + 1, side - 1); ++u) {
                use(static_cast<std::size_t>(v * side + u));
            }
        }
    }
};

/// For each point, its cell; kNoCluster if it has none.
std::vector<std::uint32_t> cells_of(const Raster& raster, const Points& points,
                                    const PointVoxels& voxels) {
    std::vector<std::uint32_t> cells(points.size(), kNoCluster);
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (voxels[i] == kNoVoxel || !raster.contains(points[i])) continue;
        cells[i] = static_cast<std::uint32_t>(raster.at(points[i]));
    }
    return cells;
}

/// Height of the ground in each cell: the lowest point in the cell and in the cells around it.
std::vector<float> ground_of(const Raster& raster, const Points& points,
                             std::span<const std::uint32_t> cells) {
    std::vector<float> lowest(raster.cells(), std::numeric_limits<float>::infinity());
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (cells[i] == kNoCluster) continue;
        lowest[cells[i]] = std::min(lowest[cells[i]], points[i].z());
    }
    std::vector<float> ground(lowest);
    for (std::size_t cell = 0; cell < lowest.size(); ++cell) {
        if (std::isinf(lowest[cell])) continue;
        raster.each_around(
            cell, [&](std::size_t other) { ground[cell] = std::min(ground[cell], lowest[other]); });
    }
    return ground;
}

constexpr std::uint32_t kEmpty = kNoCluster - 1, kWaiting = kNoCluster - 2;

/// Numbers connected cells; groups that are too long get no number.
class Flood {
public:
    Flood(const Raster& raster, int longest) : raster_(raster), longest_(longest) {}

    void number(std::size_t seed, std::vector<std::uint32_t>& cluster_of, std::uint32_t& count) {
        reached_.assign(1, seed);
        cluster_of[seed] = count;
        int left = raster_.side, right = 0, top = raster_.side, bottom = 0;
        for (std::size_t next = 0; next < reached_.size(); ++next) {
            const int x = static_cast<int>(reached_[next]) % raster_.side;
            const int y = static_cast<int>(reached_[next]) / raster_.side;
            left = std::min(left, x), right = std::max(right, x);
            top = std::min(top, y), bottom = std::max(bottom, y);
            raster_.each_around(reached_[next], [&](std::size_t cell) {
                if (cluster_of[cell] != kWaiting) return;
                cluster_of[cell] = count;
                reached_.push_back(cell);
            });
        }
        if (std::max(right - left, bottom - top) < longest_) {
            ++count;
        } else {
            for (const std::size_t cell : reached_) cluster_of[cell] = kNoCluster;
        }
    }

private:
    const Raster& raster_;
    int longest_;  // cells
    std::vector<std::size_t> reached_;
};

}  // namespace

Clusters find_clusters(const Points& points, const PointVoxels& voxels,
                       const ScansConfig::Instances& config) {
    const auto reach = static_cast<float>(config.reach), cell = static_cast<float>(config.cell);
    const Raster raster(reach, cell), coarse(reach, static_cast<float>(config.ground_cell));
    // Of the points: first their coarse cells, then their cells, then their clusters.
    Clusters clusters{cells_of(coarse, points, voxels), 0};
    const std::vector<float> ground = ground_of(coarse, points, clusters.of_points);
    std::vector<std::uint32_t> cluster_of(raster.cells(), kEmpty);
    std::vector<std::size_t> filled;
    for (std::size_t i = 0; i < points.size(); ++i) {
        std::uint32_t& of_point = clusters.of_points[i];
        if (of_point == kNoCluster) continue;
        const float height = points[i].z() - ground[of_point];
        of_point = kNoCluster;
        if (height < static_cast<float>(config.ground) || height > static_cast<float>(config.top)) {
            continue;
        }
        const std::size_t at = raster.at(points[i]);
        of_point = static_cast<std::uint32_t>(at);
        if (cluster_of[at] == kWaiting) continue;
        cluster_of[at] = kWaiting;
        filled.push_back(at);
    }
    Flood flood(raster, static_cast<int>(std::lround(config.largest / config.cell)));
    for (const std::size_t at : filled) {
        if (cluster_of[at] == kWaiting) flood.number(at, cluster_of, clusters.count);
    }
    for (std::uint32_t& cluster : clusters.of_points) {
        if (cluster != kNoCluster) cluster = cluster_of[cluster];
    }
    return clusters;
}

}  // namespace dynamic_filter
