// SPDX-License-Identifier: MIT
#include "dynamic_filter/geometry/beam_image.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "project_kernel.hpp"

namespace dynamic_filter {

namespace {

auto best_kernel() {
#ifdef DYNAMIC_FILTER_X86_LEVELS
    if (__builtin_cpu_supports("avx512f")) return kernel::avx512::to_spherical;
    if (__builtin_cpu_supports("avx2")) return kernel::avx2::to_spherical;
#endif
    return kernel::baseline::to_spherical;
}

/// Finer pixels would only cost memory: beams of one ring jitter by as much.
constexpr float kLeastStep = 0.1F * std::numbers::pi_v<float> / 180.0F;
/// For a scan whose spacing could not be read off it.
constexpr float kUnknownStep = 1.0F * std::numbers::pi_v<float> / 180.0F;

/// No sensor's beams are farther apart; an estimate that says so had too few points.
constexpr float kMostStep = 3.0F * std::numbers::pi_v<float> / 180.0F;
constexpr float kFarthest = 655.0F;  // [m] that 16 bits of centimetres can hold

float step_of(float spacing) {
    return spacing > 0.0F ? std::clamp(spacing, kLeastStep, kMostStep) : kUnknownStep;
}

/// How much of its span [rad] an angle really covers, by parts of five degrees.
float covered(const std::vector<float>& angles, const std::vector<float>& ranges) {
    constexpr int kParts = 72;
    constexpr float kPart = 2.0F * std::numbers::pi_v<float> / kParts;
    std::array<bool, kParts> hit{};
    for (std::size_t i = 0; i < angles.size(); ++i) {
        if (!(ranges[i] > 0.0F && ranges[i] < kFarthest)) continue;
        const int part = static_cast<int>((angles[i] + std::numbers::pi_v<float>) / kPart);
        hit[static_cast<std::size_t>(std::clamp(part, 0, kParts - 1))] = true;
    }
    return kPart * static_cast<float>(std::count(hit.begin(), hit.end(), true));
}

/// Growth of the pixels for a sensor whose beams follow no raster (a rosette): the gaps between
/// neighbours say little there. Three pixels per point in what the scan covers, but none beyond a
/// degree: places between far beams are not known.
float coarsening(const Directions& seen, const ImageGrid& grid) {
    constexpr float kRaster = 3.0F;  // pixels per point that missing returns of a raster explain
    const auto points = std::count_if(seen.range.begin(), seen.range.end(),
                                      [](float r) { return r > 0.0F && r < kFarthest; });
    const float pixels = covered(seen.azimuth, seen.range) * covered(seen.elevation, seen.range) /
                         (grid.azimuth_step * grid.elevation_step);
    const float per_point = pixels / std::max(1.0F, static_cast<float>(points));
    if (per_point <= kRaster) return 1.0F;
    const float largest = std::max(grid.azimuth_step, grid.elevation_step);
    return std::clamp(kUnknownStep / largest, 1.0F, std::sqrt(per_point / kRaster));
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
    static const auto kernel = best_kernel();
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
    const float across = step_of(spacing.azimuth_spacing), up = step_of(spacing.elevation_spacing);
    grid_ = make_grid(across, up, span.min, span.max);
    Directions seen;
    to_spherical(points, Eigen::Isometry3f::Identity(), seen);
    if (const float growth = coarsening(seen, grid_); growth > 1.0F) {
        grid_ = make_grid(growth * across, growth * up, span.min, span.max);
    }
    pixels_.resize(grid_.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        const float range_cm = std::round(100.0F * seen.range[i]);
        if (!(range_cm >= 1.0F && range_cm <= 65535.0F)) continue;  // NaN too
        const Position row =
            split((seen.elevation[i] - grid_.elevation_min) / grid_.elevation_step, grid_.rows);
        const Position column = split((seen.azimuth[i] + kPi) / grid_.azimuth_step, grid_.columns);
        Pixel& p = pixels_[pixel(row.index, column.index)];
        if (p.range_cm != 0 && static_cast<float>(p.range_cm) <= range_cm) continue;
        p = {static_cast<std::uint16_t>(range_cm), column.part, row.part};
    }
}

}  // namespace dynamic_filter
