// SPDX-License-Identifier: MIT
#include "dynamic_filter/geometry/beam_image.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "best_kernel.hpp"
#include "project_kernel.hpp"

namespace dynamic_filter {

namespace {

/// Finer pixels would only cost memory: beams of one ring jitter by as much.
constexpr float kLeastStep = 0.1F * std::numbers::pi_v<float> / 180.0F;
/// For a scan whose spacing could not be read off it.
constexpr float kUnknownStep = 1.0F * std::numbers::pi_v<float> / 180.0F;

/// No sensor's beams are farther apart; an estimate that says so had too few points.
constexpr float kMostStep = 3.0F * std::numbers::pi_v<float> / 180.0F;

float step_of(float spacing) {
    return spacing > 0.0F ? std::clamp(spacing, kLeastStep, kMostStep) : kUnknownStep;
}

/// Index and 1/256 part of a position in steps.
struct Position {
    int index;
    std::uint8_t part;
};
Position split(float steps, int count) {
    const int fine = std::clamp(static_cast<int>(steps * 256.0F), 0, count * 256 - 1);
    return {fine / 256, static_cast<std::uint8_t>(fine % 256)};
}

}  // namespace

void to_spherical(std::span<const Point> points, const Eigen::Isometry3f& T_image_points,
                  Directions& out) {
    static const auto kernel = DYNAMIC_FILTER_BEST_KERNEL(to_spherical);
    static_assert(sizeof(Point) == 3 * sizeof(float));
    out.azimuth.resize(points.size());
    out.elevation.resize(points.size());
    out.range.resize(points.size());
    const Eigen::Matrix<float, 3, 4, Eigen::RowMajor> matrix = T_image_points.matrix().topRows<3>();
    kernel({.xyz = points.empty() ? nullptr : points.front().data(),
            .count = points.size(),
            .matrix = matrix.data(),
            .azimuth = out.azimuth.data(),
            .elevation = out.elevation.data(),
            .range = out.range.data()});
}

BeamImage::BeamImage(std::span<const Point> points, const BeamPattern& spacing) {
    const ElevationRange span = elevation_range(points);
    grid_ = make_grid(step_of(spacing.azimuth_spacing), step_of(spacing.elevation_spacing),
                      span.min, span.max);
    Directions seen;
    to_spherical(points, Eigen::Isometry3f::Identity(), seen);
    const auto column_of = [&](std::size_t i) {
        return split((seen.azimuth[i] + kPi) / grid_.azimuth_step, grid_.columns);
    };
    const auto range_of = [&](std::size_t i) { return std::round(100.0F * seen.range[i]); };
    const auto fits = [](float range_cm) { return range_cm >= 1.0F && range_cm <= 65535.0F; };
    std::vector<bool> hit(static_cast<std::size_t>(grid_.columns));
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (fits(range_of(i))) hit[static_cast<std::size_t>(column_of(i).index)] = true;
    }
    find_view(hit);
    pixels_.resize(static_cast<std::size_t>(grid_.rows) *
                   static_cast<std::size_t>(stored_columns_));
    farthest_cm_.resize(static_cast<std::size_t>(grid_.rows / kTile + 1) *
                        static_cast<std::size_t>(tile_columns()));
    for (std::size_t i = 0; i < points.size(); ++i) {
        const float range_cm = range_of(i);
        if (!fits(range_cm)) continue;  // NaN too
        const Position row =
            split((seen.elevation[i] - grid_.elevation_min) / grid_.elevation_step, grid_.rows);
        const Position column = column_of(i);
        const auto range = static_cast<std::uint16_t>(range_cm);
        std::uint32_t& p = pixels_[pixel(row.index, column.index)];
        if ((p & 0xFFFFU) != 0 && (p & 0xFFFFU) <= range) continue;
        p = range | std::uint32_t{column.part} << 16 | std::uint32_t{row.part} << 24;
        std::uint16_t& farthest = farthest_cm_[static_cast<std::size_t>(
            row.index / kTile * tile_columns() + column.index / kTile)];
        farthest = std::max(farthest, range);
    }
}

float BeamImage::farthest(int first_row, int last_row, int first_column, int last_column) const {
    std::uint16_t farthest = 0;
    const auto look = [&](int first, int last) {
        for (int r = first_row / kTile; r <= last_row / kTile; ++r) {
            const auto row = farthest_cm_.begin() + r * tile_columns();
            farthest =
                std::max(farthest, *std::max_element(row + first / kTile, row + last / kTile + 1));
        }
    };
    const int columns = grid_.columns;
    if (last_column - first_column >= columns) {
        look(0, columns - 1);
    } else {
        look(std::max(first_column, 0), std::min(last_column, columns - 1));
        if (first_column < 0) look(first_column + columns, columns - 1);
        if (last_column >= columns) look(0, last_column - columns);
    }
    return 0.01F * farthest;
}

void BeamImage::find_view(const std::vector<bool>& hit) {
    const int columns = grid_.columns;
    const auto first_hit = std::find(hit.begin(), hit.end(), true);
    if (first_hit == hit.end()) return;
    const auto start = static_cast<int>(first_hit - hit.begin());
    int gap = 0, widest = 0;
    for (int i = 1; i <= columns; ++i) {  // once around, back to a column that was hit
        const int column = (start + i) % columns;
        if (!hit[static_cast<std::size_t>(column)]) {
            ++gap;
            continue;
        }
        if (gap > widest || i == 1) {
            widest = gap;
            first_column_ = column;
        }
        gap = 0;
    }
    stored_columns_ = columns - widest;
}

}  // namespace dynamic_filter
