// SPDX-License-Identifier: MIT
#include "paper/removert.hpp"

#include <limits>

#include "dynamic_filter/parallel.hpp"
#include "geometry/voxel_index.hpp"
#include "paper/submap.hpp"

namespace dynamic_filter {

namespace {

constexpr float kNone = std::numeric_limits<float>::infinity();

/// The first point of every cell, and the cell of every point of the window.
struct ThinMap {
    Points points;                                     ///< map frame
    std::vector<std::vector<std::uint32_t>> of_point;  ///< per scan and point; UINT32_MAX: no cell
};

ThinMap thin(const Window& window, const std::vector<Labels>& labels, Label kept,
             float voxel_size) {
    ThinMap map;
    VoxelIndex cells;
    Points points;
    for (std::size_t s = 0; s < window.scans.size(); ++s) {
        to_map(window.scans[s], points);
        map.of_point.emplace_back(points.size(), UINT32_MAX);
        for (std::size_t i = 0; i < points.size(); ++i) {
            const auto cell = cell_of(points[i], 2.0F / voxel_size);
            if (labels[s][i] != kept || !cell) continue;
            const std::uint32_t id = cells.insert(pack(*cell));
            if (id == map.points.size()) map.points.push_back(points[i]);
            map.of_point[s][i] = id;
        }
    }
    return map;
}

/// The candidates that are the nearest of their pixel, and through which the image sees.
std::vector<std::uint32_t> seen_through(const Points& map, const std::vector<char>& candidate,
                                        const Pose& T_map_keyframe, const RangeImage& image,
                                        const RemovalMargin& margin) {
    std::vector<float> range(image.grid.size(), kNone);
    std::vector<std::uint32_t> nearest(image.grid.size(), 0);
    Projection seen;
    project(map, T_map_keyframe.inverse().cast<float>(), image.grid, seen);
    for (std::uint32_t i = 0; i < map.size(); ++i) {
        if (seen.pixel[i] < 0 || candidate[i] == 0) continue;
        const auto pixel = static_cast<std::size_t>(seen.pixel[i]);
        if (seen.range[i] >= range[pixel]) continue;
        range[pixel] = seen.range[i];
        nearest[pixel] = i;
    }
    std::vector<std::uint32_t> found;
    for (std::size_t pixel = 0; pixel < range.size(); ++pixel) {
        const bool both = range[pixel] < kNone && image.range[pixel] < kNone;
        if (both && image.range[pixel] - range[pixel] > margin.at(range[pixel])) {
            found.push_back(nearest[pixel]);
        }
    }
    return found;
}

/// The union of these candidates over all keyframes.
std::vector<char> seen_through(const Window& window, const Points& map,
                               const std::vector<char>& candidate, const KeyframeImages& images,
                               const RemovalMargin& margin) {
    std::vector<std::vector<std::uint32_t>> found(images.size());
    parallel_for(images.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            found[k] =
                seen_through(map, candidate, window.scans[window.keyframes[k]].T_world_sensor,
                             images[k], margin);
        }
    });
    std::vector<char> marked(map.size(), 0);
    for (const auto& points : found) {
        for (const std::uint32_t i : points) marked[i] = 1;
    }
    return marked;
}

/// Gives every point the verdict on its cell of the map.
void apply(const ThinMap& map, const std::vector<char>& removed, std::vector<Labels>& labels) {
    for (std::size_t s = 0; s < labels.size(); ++s) {
        for (std::size_t i = 0; i < labels[s].size(); ++i) {
            const std::uint32_t cell = map.of_point[s][i];
            if (cell != UINT32_MAX)
                labels[s][i] = removed[cell] != 0 ? Label::dynamic : Label::static_;
        }
    }
}

}  // namespace

std::vector<Labels> removert(const Window& window, std::span<const KeyframeImages> fine,
                             const KeyframeImages& coarse, const RemovalMargin& margin,
                             float voxel_size) {
    std::vector<Labels> labels = label_measured(window);
    const ThinMap map = thin(window, labels, Label::static_, voxel_size);
    std::vector<char> kept(map.points.size(), 1), removed(map.points.size(), 0);
    for (const KeyframeImages& images : fine) {
        const auto marked = seen_through(window, map.points, kept, images, margin);
        for (std::size_t i = 0; i < marked.size(); ++i) {
            if (marked[i] != 0) kept[i] = 0, removed[i] = 1;
        }
    }
    apply(map, seen_through(window, map.points, removed, coarse, margin), labels);
    return labels;
}

void revert_by_visibility(const Window& window, const KeyframeImages& coarse,
                          const RemovalMargin& margin, float voxel_size,
                          std::vector<Labels>& labels) {
    const ThinMap map = thin(window, labels, Label::dynamic, voxel_size);
    const std::vector<char> all(map.points.size(), 1);
    apply(map, seen_through(window, map.points, all, coarse, margin), labels);
}

}  // namespace dynamic_filter
