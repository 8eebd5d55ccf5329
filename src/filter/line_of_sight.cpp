// SPDX-License-Identifier: MIT
#include "filter/line_of_sight.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/best_kernel.hpp"
#include "filter/sight_kernel.hpp"

namespace dynamic_filter {

namespace {

/// Rounds down without a call to the C library, which std::floor needs on old machines.
int floor_of(float x) {
    const int cut = static_cast<int>(x);
    return cut - (static_cast<float>(cut) > x ? 1 : 0);
}

}  // namespace

SightMargins margins_of(const ScansConfig::Sight& config, double voxel_size) {
    const auto number = [](double value) { return static_cast<float>(value); };
    const float voxel = number(voxel_size);
    const auto at_least = [&](double length, double voxels) {
        return std::max(number(length), number(voxels) * voxel);
    };
    return {.beside = number(config.beside),
            .beyond = at_least(config.beyond, config.beyond_voxels),
            .touch = at_least(config.touch, config.touch_voxels),
            .surface = at_least(config.surface, config.surface_voxels),
            .per_metre = number(config.per_metre),
            .nearest = number(config.nearest),
            .farthest = number(config.farthest),
            .own_pixels = number(config.own_pixels),
            .close_pixels = number(config.close_pixels),
            .close_beside = number(config.close_beside),
            .same_spot = number(config.same_spot),
            .clear = at_least(config.clear, config.clear_voxels),
            .clear_unseen = number(config.clear_unseen)};
}

void check_lines_of_sight(const BeamImage& image, const Directions& places,
                          const SightMargins& margins, std::vector<Sight>& sights) {
    static const auto kernel = DYNAMIC_FILTER_BEST_KERNEL(check_lines_of_sight);
    static_assert(sizeof(Sight) == 1);
    sights.assign(places.range.size(), Sight::unknown);
    if (image.empty()) return;
    const BeamImage::View view = image.view();
    const ImageGrid& grid = image.grid();
    kernel({.pixels = view.pixels,
            .farthest_cm = view.farthest_cm,
            .columns = grid.columns,
            .rows = grid.rows,
            .first_column = view.first_column,
            .stored_columns = view.stored_columns,
            .azimuth_step = grid.azimuth_step,
            .elevation_step = grid.elevation_step,
            .elevation_min = grid.elevation_min,
            .beside = margins.beside,
            .beyond = margins.beyond,
            .touch = margins.touch,
            .surface = margins.surface,
            .per_metre = margins.per_metre,
            .nearest = margins.nearest,
            .farthest = margins.farthest,
            .own_pixels = margins.own_pixels,
            .close_pixels = margins.close_pixels,
            .close_beside = margins.close_beside,
            .same_spot = margins.same_spot,
            .clear = margins.clear,
            .clear_unseen = margins.clear_unseen,
            .apart = margins.apart,
            .azimuth = places.azimuth.data(),
            .elevation = places.elevation.data(),
            .range = places.range.data(),
            .count = places.range.size(),
            .sights = reinterpret_cast<std::uint8_t*>(sights.data())});
}

bool may_see(const BeamImage& image, const Beam& center, float radius,
             const SightMargins& margins) {
    const float nearest = center.range - radius;
    const bool in_range = nearest <= margins.farthest && center.range + radius >= margins.nearest;
    if (!in_range) return false;  // also for NaN
    const ImageGrid& grid = image.grid();
    // [rad] largest elevation within `radius`.
    const float slant = std::abs(center.elevation) + 0.5F;
    // The bounds below hold only for distant spheres.
    if (nearest < 2.0F * radius || slant > 1.3F) return true;
    // The angular radius is at least asin(radius / range).
    const float reach =
        1.1F * radius / center.range + std::max(margins.beside, margins.apart) / nearest;
    const float rows = reach / grid.elevation_step + 1.1F;
    const float columns = reach / (std::cos(slant) * grid.azimuth_step) + 1.1F;
    const float row = (center.elevation - grid.elevation_min) / grid.elevation_step;
    const float column = (center.azimuth + std::numbers::pi_v<float>) / grid.azimuth_step;
    const int first_row = std::max(0, floor_of(row - rows));
    const int last_row = std::min(grid.rows - 1, floor_of(row + rows));
    if (first_row > last_row) return false;
    return image.reaches(nearest - margins.touch - margins.per_metre * nearest, first_row, last_row,
                         floor_of(column - columns), floor_of(column + columns));
}

}  // namespace dynamic_filter
