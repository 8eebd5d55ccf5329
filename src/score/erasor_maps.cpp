// SPDX-License-Identifier: MIT
#include "score/erasor_maps.hpp"

#include <algorithm>
#include <cmath>

#include "dynamic_filter/parallel.hpp"
#include "geometry/neighbor_grid.hpp"
#include "geometry/voxel.hpp"
#include "score/for_each_scan.hpp"

namespace dynamic_filter::eval {

namespace {

/// The points that have a voxel, voxel by voxel.
struct ByVoxel {
    std::vector<VoxelKey> keys;         ///< of all points
    std::vector<std::uint32_t> sorted;  ///< points by key, then by index
};

ByVoxel by_voxel(const Points& points, double voxel_size) {
    const float per_metre = 1.0F / static_cast<float>(voxel_size);
    ByVoxel found;
    found.keys.resize(points.size());
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        const auto cell = cell_of(points[i], per_metre);
        if (!cell) continue;
        found.keys[i] = pack(*cell);
        found.sorted.push_back(i);
    }
    std::sort(found.sorted.begin(), found.sorted.end(), [&](std::uint32_t a, std::uint32_t b) {
        return found.keys[a] != found.keys[b] ? found.keys[a] < found.keys[b] : a < b;
    });
    return found;
}

/// The mean of the points of each voxel.
Points centroids(const Points& points, double voxel_size) {
    const ByVoxel found = by_voxel(points, voxel_size);
    Points out;
    for (std::size_t begin = 0, end = 0; begin < found.sorted.size(); begin = end) {
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        const VoxelKey key = found.keys[found.sorted[begin]];
        for (; end < found.sorted.size() && found.keys[found.sorted[end]] == key; ++end) {
            sum += points[found.sorted[end]].cast<double>();
        }
        out.push_back((sum / static_cast<double>(end - begin)).cast<float>());
    }
    return out;
}

/// For each query, the label of the nearest point of the map within `radius`; unknown if there is
/// none.
Labels nearest_labels(const LabelledMap& map, const Points& queries, float radius) {
    const NeighborGrid grid(map.points, radius);
    Labels labels(queries.size(), Label::unknown);
    parallel_for(queries.size(), 4096, [&](std::size_t begin, std::size_t end) {
        std::vector<Neighbor> nearest;
        for (std::size_t i = begin; i < end; ++i) {
            grid.nearest(queries[i], 1, nearest);
            if (!nearest.empty()) labels[i] = map.labels[nearest.front().index];
        }
    });
    return labels;
}

void append(LabelledMap& map, const LabelledMap& more) {
    map.points.insert(map.points.end(), more.points.begin(), more.points.end());
    map.labels.insert(map.labels.end(), more.labels.begin(), more.labels.end());
}

/// The points of a scan whose truth is known; without those that are labelled dynamic, if
/// `is_clean`.
LabelledMap chosen_points(const LabelledScan& scan, bool is_clean) {
    LabelledMap map;
    for (std::size_t i = 0; i < scan.points.size(); ++i) {
        if (scan.truth[i] == Label::unknown) continue;
        if (is_clean && scan.verdict[i] == Label::dynamic) continue;
        map.points.push_back(scan.points[i]);
        map.labels.push_back(scan.truth[i]);
    }
    return map;
}

/// The thinned scans together.
struct SumOfScans {
    LabelledMap all, clean;
};

SumOfScans sum_of(std::size_t scans, const ScanSource& source, double voxel_size) {
    SumOfScans sum;
    for_each_scan(scans, source, [&](std::size_t, const LabelledScan& scan) {
        append(sum.all, thinned(chosen_points(scan, false), voxel_size));
        if (scan.verdict.empty()) return;
        append(sum.clean, thinned(chosen_points(scan, true), voxel_size));
    });
    return sum;
}

/// The scores of a clean map against the true one; both are thinned.
VoxelTotals compare(const LabelledMap& truth, const LabelledMap& clean, double voxel_size) {
    // The radius is the first distance that is too far.
    const auto radius = std::nextafter(static_cast<float>(voxel_size * std::sqrt(3.0) / 2.0), 0.0F);
    const Labels nearest = nearest_labels(clean, truth.points, radius);
    VoxelTotals totals;
    for (std::size_t i = 0; i < nearest.size(); ++i) {
        const bool is_kept = nearest[i] == truth.labels[i];
        const bool is_dynamic = truth.labels[i] == Label::dynamic;
        (is_dynamic ? totals.dynamic_total : totals.static_total) += 1;
        if (is_kept) (is_dynamic ? totals.dynamic_kept : totals.static_kept) += 1;
    }
    return totals;
}

}  // namespace

LabelledMap thinned(const LabelledMap& map, double voxel_size) {
    LabelledMap out{centroids(map.points, voxel_size), {}};
    // No point of a voxel is farther from its centroid than the voxel's diagonal.
    const auto diagonal = static_cast<float>(voxel_size * std::sqrt(3.0)) * 1.001F;
    out.labels = nearest_labels(map, out.points, diagonal);
    return out;
}

VoxelTotals score_erasor(std::size_t scans, const ScanSource& source, double voxel_size) {
    const SumOfScans sum = sum_of(scans, source, voxel_size);
    return compare(thinned(sum.all, voxel_size), thinned(sum.clean, voxel_size), voxel_size);
}

VoxelTotals score_erasor(std::size_t scans, const ScanSource& source, const Points& map,
                         double voxel_size) {
    const ScanSource without_verdict = [&](std::size_t i) {
        auto scan = source(i);
        if (scan) scan->verdict.clear();
        return scan;
    };
    const LabelledMap all = sum_of(scans, without_verdict, voxel_size).all;
    LabelledMap clean{map,
                      nearest_labels(all, map, 1.0F)};  // what is farther is near no true point
    return compare(thinned(all, voxel_size), thinned(clean, voxel_size), voxel_size);
}

}  // namespace dynamic_filter::eval
