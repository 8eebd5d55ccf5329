// SPDX-License-Identifier: MIT
#include "geometry/neighbor_grid.hpp"

#include <algorithm>

namespace dynamic_filter {

namespace {

bool closer(const Neighbor& a, const Neighbor& b) {
    return a.distance_sq != b.distance_sq ? a.distance_sq < b.distance_sq : a.index < b.index;
}

/// Keeps `best` sorted and limited to the k nearest points so far. As k is small, insertion is
/// faster than a heap.
void offer(std::vector<Neighbor>& best, std::size_t k, const Neighbor& candidate) {
    if (best.size() == k) {
        if (!closer(candidate, best.back())) return;
        best.pop_back();
    }
    best.insert(std::upper_bound(best.begin(), best.end(), candidate, closer), candidate);
}

}  // namespace

NeighborGrid::NeighborGrid(std::span<const Point> points, float radius)
    : radius_(radius), inverse_cell_(1.0F / radius), points_(points.begin(), points.end()) {
    // Counting sort by cell: numbers the cells, counts their points, and places the points.
    std::vector<std::uint32_t> cell_of_point(points_.size(), UINT32_MAX), counts;
    for (std::size_t i = 0; i < points_.size(); ++i) {
        const auto cell = cell_of(points_[i], inverse_cell_);
        if (!cell) continue;
        const auto [it, fresh] =
            cells_.try_emplace(pack(*cell), Slice{static_cast<std::uint32_t>(counts.size()), 0});
        if (fresh) counts.push_back(0);
        cell_of_point[i] = it->second.begin;
        ++counts[it->second.begin];
    }
    std::vector<std::uint32_t> next(counts.size() + 1, 0);
    for (std::size_t c = 0; c < counts.size(); ++c) next[c + 1] = next[c] + counts[c];
    for (auto it = cells_.begin(); it != cells_.end(); ++it) {
        const std::uint32_t number = it->second.begin;
        it.value() = {next[number], next[number + 1]};
    }
    sorted_.resize(next.back());
    for (std::uint32_t i = 0; i < points_.size(); ++i) {
        if (cell_of_point[i] != UINT32_MAX) sorted_[next[cell_of_point[i]]++] = {points_[i], i};
    }
}

NeighborGrid::Slice NeighborGrid::slice(const Cell& cell) const {
    if (!fits(cell)) return {};
    const auto it = cells_.find(pack(cell));
    return it == cells_.end() ? Slice{} : it->second;
}

void NeighborGrid::nearest(const Point& query, std::size_t k, std::vector<Neighbor>& out) const {
    out.clear();
    const auto home = cell_of(query, inverse_cell_);
    if (!home || k == 0) return;
    const float radius_sq = radius_ * radius_;
    const auto visit = [&](const Cell& cell) {
        const Slice s = slice(cell);
        for (std::uint32_t i = s.begin; i < s.end; ++i) {
            const float distance_sq = (sorted_[i].point - query).squaredNorm();
            if (distance_sq <= radius_sq) offer(out, k, {distance_sq, sorted_[i].index});
        }
    };
    visit(*home);  // first, so that most later points fail the distance test at once
    const Point corner = home->cast<float>() * radius_;
    for (int dz = -1; dz <= 1; ++dz) {
        for (int dy = -1; dy <= 1; ++dy) {
            for (int dx = -1; dx <= 1; ++dx) {
                const Cell step(dx, dy, dz);
                if (step.isZero()) continue;
                // Skips cells that lie completely farther than the k-th neighbor.
                if (out.size() == k) {
                    const Point low = corner + step.cast<float>() * radius_;
                    const Point high = low.array() + radius_;
                    const float gap_sq = (query.cwiseMax(low).cwiseMin(high) - query).squaredNorm();
                    if (gap_sq > out.back().distance_sq * 1.0001F) continue;
                }
                visit(*home + step);
            }
        }
    }
}

bool NeighborGrid::any_within(const Point& query, float distance) const {
    // With distance <= radius / 2, the sphere touches at most two cells per axis.
    const auto low = cell_of(query.array() - distance, inverse_cell_);
    const auto high = cell_of(query.array() + distance, inverse_cell_);
    if (!low || !high) return false;
    for (int z = low->z(); z <= high->z(); ++z) {
        for (int y = low->y(); y <= high->y(); ++y) {
            for (int x = low->x(); x <= high->x(); ++x) {
                const Slice s = slice({x, y, z});
                for (std::uint32_t i = s.begin; i < s.end; ++i) {
                    if ((sorted_[i].point - query).squaredNorm() <= distance * distance)
                        return true;
                }
            }
        }
    }
    return false;
}

}  // namespace dynamic_filter
