// SPDX-License-Identifier: MIT
#include "geometry/beam_image.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/best_kernel.hpp"
#include "geometry/project_kernel.hpp"

namespace dynamic_filter {

namespace {

/// Smaller pixels would only need more memory, because the beams of one ring scatter by this much.
constexpr float kLeastStep = 0.1F * std::numbers::pi_v<float> / 180.0F;
/// Pixel size for a scan whose beam spacing could not be measured.
constexpr float kUnknownStep = 1.0F * std::numbers::pi_v<float> / 180.0F;

/// The beams of all sensors are closer than this; a larger estimate comes from too few points.
constexpr float kMostStep = 3.0F * std::numbers::pi_v<float> / 180.0F;

float step_of(float spacing) {
    return spacing > 0.0F ? std::clamp(spacing, kLeastStep, kMostStep) : kUnknownStep;
}

/// The position of each point in the image, in 1/256 of a pixel, and its range [cm].
struct Pixels {
    std::vector<std::int32_t> column, row, range_cm;
};
/// A `range_cm` of 0 means: not in the image, or NaN.
Pixels pixels_of(const Directions& seen, const ImageGrid& grid) {
    const std::size_t count = seen.range.size();
    Pixels out{std::vector<std::int32_t>(count), std::vector<std::int32_t>(count),
               std::vector<std::int32_t>(count)};
    constexpr float kFine = 256.0F;
    const auto most_columns = static_cast<float>(grid.columns * 256 - 1);
    const auto most_rows = static_cast<float>(grid.rows * 256 - 1);
    const auto within = [](float x, float most) { return x > 0.0F ? (x < most ? x : most) : 0.0F; };
    for (std::size_t i = 0; i < count; ++i) {
        const float column = (seen.azimuth[i] + std::numbers::pi_v<float>) / grid.azimuth_step;
        const float row = (seen.elevation[i] - grid.elevation_min) / grid.elevation_step;
        const float range = 100.0F * seen.range[i] + 0.5F;
        const bool fits = range >= 1.0F && range < 65536.0F;
        out.column[i] = static_cast<std::int32_t>(within(column * kFine, most_columns));
        out.row[i] = static_cast<std::int32_t>(within(row * kFine, most_rows));
        out.range_cm[i] = static_cast<std::int32_t>(fits ? range : 0.0F);
    }
    return out;
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
    const Pixels at = pixels_of(seen, grid_);
    std::vector<bool> hit(static_cast<std::size_t>(grid_.columns));
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (at.range_cm[i] > 0) hit[static_cast<std::size_t>(at.column[i] >> 8)] = true;
    }
    find_view(hit);
    if (empty()) return;
    pixels_.resize(static_cast<std::size_t>(grid_.rows) * row_length() + kMargin + 1);
    farthest_cm_.resize(static_cast<std::size_t>(grid_.rows / kTile + 1) *
                        static_cast<std::size_t>(tile_columns()));
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (at.range_cm[i] == 0) continue;
        const auto range = static_cast<std::uint32_t>(at.range_cm[i]);
        const int row = at.row[i] >> 8, column = at.column[i] >> 8;
        std::uint32_t& p = pixels_[pixel(row, column)];
        if (p == 0) ++beams_;
        if (p != 0 && (p & 0xFFFFU) <= range) continue;
        p = range | static_cast<std::uint32_t>(at.column[i] & 0xFF) << 16 |
            static_cast<std::uint32_t>(at.row[i] & 0xFF) << 24;
        std::uint16_t& farthest =
            farthest_cm_[static_cast<std::size_t>(row / kTile * tile_columns() + column / kTile)];
        farthest = std::max(farthest, static_cast<std::uint16_t>(range));
    }
    fill_margins();
    pool();
}

void BeamImage::fill_margins() {
    // Columns of the circle outside the field of view.
    const int missing = grid_.columns - stored_columns_;
    for (int row = 0; row < grid_.rows; ++row) {
        std::uint32_t* const first =
            pixels_.data() + static_cast<std::size_t>(row) * row_length() + kMargin;
        for (int i = missing; i < kMargin; ++i) {
            first[stored_columns_ + i] = first[i - missing];
            first[-1 - i] = first[stored_columns_ - 1 - (i - missing)];
        }
    }
}

/// Maximum over neighbors: first along the rows, then across them.
void BeamImage::pool() {
    const auto width = static_cast<std::size_t>(stored_columns_);
    std::vector<std::uint16_t> along(static_cast<std::size_t>(grid_.rows) * width), row(width + 2);
    for (std::size_t r = 0; r < along.size() / width; ++r) {
        const std::uint32_t* const first = pixels_.data() + r * row_length() + kMargin;
        for (std::size_t c = 0; c < row.size(); ++c) {
            row[c] = static_cast<std::uint16_t>((first - 1)[c] & 0xFFFFU);
        }
        for (std::size_t c = 0; c < width; ++c) {
            along[r * width + c] = std::max({row[c], row[c + 1], row[c + 2]});
        }
    }
    farthest_of_nine_cm_ = along;
    const auto widen = [&](std::size_t to, std::size_t from) {
        for (std::size_t i = 0; i + width < along.size(); ++i) {
            std::uint16_t& farthest = farthest_of_nine_cm_[to + i];
            farthest = std::max(farthest, along[from + i]);
        }
    };
    widen(0, width);
    widen(width, 0);
}

bool BeamImage::reaches(float range, int first_row, int last_row, int first_column,
                        int last_column) const {
    // [cm] rounded down, so that the test is conservative.
    const auto least = static_cast<int>(100.0F * range);
    const auto look = [&](int first, int last) {
        for (int r = first_row / kTile; r <= last_row / kTile; ++r) {
            const auto row = farthest_cm_.begin() + r * tile_columns();
            for (int c = first / kTile; c <= last / kTile; ++c) {
                if (row[c] != 0 && row[c] >= least) return true;
            }
        }
        return false;
    };
    const int columns = grid_.columns;
    if (last_column - first_column >= columns) return look(0, columns - 1);
    return look(std::max(first_column, 0), std::min(last_column, columns - 1)) ||
           (first_column < 0 && look(first_column + columns, columns - 1)) ||
           (last_column >= columns && look(0, last_column - columns));
}

void BeamImage::find_view(const std::vector<bool>& hit) {
    const int columns = grid_.columns;
    const auto first_hit = std::find(hit.begin(), hit.end(), true);
    if (first_hit == hit.end()) return;
    const auto start = static_cast<int>(first_hit - hit.begin());
    int gap = 0, widest = 0;
    // Once around the circle, back to the first column with a return.
    for (int i = 1; i <= columns; ++i) {
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
    if (widest < 2) {
        stored_columns_ = columns;
        return;
    }
    first_column_ = (first_column_ + columns - 1) % columns;  // one more column on both sides
    stored_columns_ += 2;
}

}  // namespace dynamic_filter
