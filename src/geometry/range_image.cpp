// SPDX-License-Identifier: MIT
#include "dynamic_filter/range_image.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/best_kernel.hpp"
#include "base/numbers.hpp"
#include "geometry/angle.hpp"
#include "geometry/project_kernel.hpp"

namespace dynamic_filter {

namespace {

constexpr float kTwoPi = 2.0F * std::numbers::pi_v<float>;

struct Direction {
    float slice;  ///< the angle by which points are grouped
    float angle;  ///< the angle whose gaps are measured
};

/// Median gap of `angle` between neighbors within slices of `width` of the other angle.
float spacing(std::vector<Direction>& directions, float width) {
    // Returns of one ring (or column) have the same angle except for jitter, which is no gap.
    constexpr float kJitter = 0.0012F;  // 0.07 deg: below the spacing of any sensor in use
    for (auto& d : directions) d.slice = std::floor(d.slice / width);
    std::sort(directions.begin(), directions.end(), [](const Direction& a, const Direction& b) {
        return a.slice != b.slice ? a.slice < b.slice : a.angle < b.angle;
    });
    std::vector<float> gaps;
    for (std::size_t i = 1; i < directions.size(); ++i) {
        const float gap = directions[i].angle - directions[i - 1].angle;
        if (directions[i].slice == directions[i - 1].slice && gap > kJitter) gaps.push_back(gap);
    }
    return median(std::move(gaps));
}

}  // namespace

ImageGrid make_grid(float azimuth_step, float elevation_step, float elevation_min,
                    float elevation_max) {
    ImageGrid grid;
    grid.columns = std::max(1, static_cast<int>(kTwoPi / azimuth_step));
    grid.azimuth_step = kTwoPi / static_cast<float>(grid.columns);
    grid.elevation_step = elevation_step;
    // A margin of half a step, so that the outermost beams lie inside their rows and not on an
    // edge.
    grid.elevation_min = elevation_min - 0.5F * elevation_step;
    grid.rows = 1 + static_cast<int>((elevation_max - grid.elevation_min) / elevation_step);
    return grid;
}

void project(std::span<const Point> points, const Eigen::Isometry3f& T_image_points,
             const ImageGrid& grid, Projection& out) {
    static const auto kernel = DYNAMIC_FILTER_BEST_KERNEL(project);
    static_assert(sizeof(Point) == 3 * sizeof(float));
    out.pixel.resize(points.size());
    out.range.resize(points.size());
    const Eigen::Matrix<float, 3, 4, Eigen::RowMajor> matrix = T_image_points.matrix().topRows<3>();
    kernel({.xyz = points.empty() ? nullptr : points.front().data(),
            .count = points.size(),
            .matrix = matrix.data(),
            .elevation_min = grid.elevation_min,
            .inverse_azimuth_step = 1.0F / grid.azimuth_step,
            .inverse_elevation_step = 1.0F / grid.elevation_step,
            .columns = grid.columns,
            .rows = grid.rows,
            .pixel = out.pixel.data(),
            .range = out.range.data()});
}

RangeImage nearest_range_image(std::span<const Point> points, const ImageGrid& grid) {
    Projection projection;
    project(points, Eigen::Isometry3f::Identity(), grid, projection);
    RangeImage image{grid, std::vector<float>(grid.size(), std::numeric_limits<float>::infinity())};
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (projection.pixel[i] < 0) continue;
        float& nearest = image.range[static_cast<std::size_t>(projection.pixel[i])];
        nearest = std::min(nearest, projection.range[i]);
    }
    return image;
}

RangeImage halve_rows(const RangeImage& image) {
    RangeImage halved{image.grid, {}};
    halved.grid.rows *= 2;
    halved.grid.elevation_step *= 0.5F;
    halved.range.reserve(halved.grid.size());
    const auto columns = static_cast<std::size_t>(image.grid.columns);
    const auto rows = static_cast<std::size_t>(image.grid.rows);
    for (std::size_t half = 0; half < 2 * rows; ++half) {
        const std::size_t row = half / 2;
        const bool lower = half % 2 == 0;
        const bool outermost = lower ? row == 0 : row + 1 == rows;
        const float* const own = image.range.data() + row * columns;
        const float* const next = outermost ? own : lower ? own - columns : own + columns;
        for (std::size_t c = 0; c < columns; ++c) {
            const bool empty = own[c] == std::numeric_limits<float>::infinity();
            halved.range.push_back(empty ? own[c] : std::min(own[c], next[c]));
        }
    }
    return halved;
}

BeamPattern estimate_beam_pattern(std::span<const Scan> scans) {
    std::vector<float> azimuth_spacings, elevation_spacings;
    for (const Scan& scan : scans) {
        std::vector<Direction> along_elevation, along_azimuth;
        for (const Point& p : scan.points) {
            if (!is_measured(p)) continue;
            const float azimuth = angle_of(p.y(), p.x());
            const float elevation = angle_of(p.z(), std::hypot(p.x(), p.y()));
            along_elevation.push_back({azimuth, elevation});
            along_azimuth.push_back({elevation, azimuth});
        }
        constexpr float kColumn = 0.0087F, kRing = 0.0035F;  // 0.5 and 0.2 deg
        elevation_spacings.push_back(spacing(along_elevation, kColumn));
        azimuth_spacings.push_back(spacing(along_azimuth, kRing));
    }
    std::erase(elevation_spacings, 0.0F);
    std::erase(azimuth_spacings, 0.0F);
    return {median(std::move(azimuth_spacings)), median(std::move(elevation_spacings))};
}

ElevationRange elevation_range(std::span<const Point> points) {
    float lowest = std::numeric_limits<float>::infinity(), highest = -lowest;
    for (const Point& p : points) {
        if (!is_measured(p)) continue;
        // Infinite at the poles, which atan handles.
        const float tangent = p.z() / std::hypot(p.x(), p.y());
        lowest = std::min(lowest, tangent);
        highest = std::max(highest, tangent);
    }
    if (lowest > highest) return {};
    return {angle_of_tangent(lowest), angle_of_tangent(highest)};
}

}  // namespace dynamic_filter
