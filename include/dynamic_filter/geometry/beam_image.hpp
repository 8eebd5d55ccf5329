// SPDX-License-Identifier: MIT
/// A scan as its beams: like a range image, but each pixel also keeps where exactly its beam went.
#pragma once

#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

#include "dynamic_filter/geometry/range_image.hpp"
#include "dynamic_filter/types.hpp"

namespace dynamic_filter {

/// Directions [rad] and ranges [m] of points, parallel to them. Azimuth in [-pi, pi].
struct Directions {
    std::vector<float> azimuth, elevation, range;
};

/// Of T_image_points * p for every point. Bit-identical at every instruction-set level; errors of
/// the angles stay below 2e-5 rad. Thread-safe; `out` is resized.
void to_spherical(std::span<const Point> points, const Eigen::Isometry3f& T_image_points,
                  Directions& out);

/// A return: where the beam went [rad] and where it ended [m].
struct Beam {
    float azimuth = 0.0F, elevation = 0.0F, range = 0.0F;
};

/// One beam per pixel, the nearest; pixels are as wide as the sensor's beams are apart. Immutable;
/// thread-safe. Six bytes for each pixel in the field of view: range in steps of 1 cm, direction
/// in 1/256 of the pixel.
class BeamImage {
public:
    BeamImage() = default;
    /// Points in the sensor frame; what is not measured, or beyond 655 m, is left out.
    BeamImage(std::span<const Point> points, const BeamPattern& spacing);

    [[nodiscard]] const ImageGrid& grid() const { return grid_; }
    /// False if no beam in a window of pixels goes as far as `range` [m]; cautious, because it asks
    /// tiles of pixels. Rows must exist, columns may wrap around, no farther than once.
    [[nodiscard]] bool reaches(float range, int first_row, int last_row, int first_column,
                               int last_column) const;
    /// The share of the pixels in the field of view that hold a beam; 0 if there are none.
    [[nodiscard]] float coverage() const {
        const int pixels = grid_.rows * stored_columns_;
        return pixels == 0 ? 0.0F : static_cast<float>(beams_) / static_cast<float>(pixels);
    }
    [[nodiscard]] bool empty() const { return stored_columns_ == 0; }
    [[nodiscard]] std::size_t bytes() const {
        return pixels_.size() * sizeof(std::uint32_t) +
               (farthest_of_nine_cm_.size() + farthest_cm_.size()) * sizeof(std::uint16_t);
    }
    /// False where nothing returned.
    [[nodiscard]] bool has_beam(int row, int column) const {
        return is_stored(column) && (pixels_[pixel(row, column)] & 0xFFFFU) != 0;
    }
    /// Only where has_beam().
    [[nodiscard]] Beam beam(int row, int column) const {
        const std::uint32_t p = pixels_[pixel(row, column)];
        constexpr float kFraction = 1.0F / 256.0F;
        const auto part = [&](int shift) { return static_cast<float>(p >> shift & 0xFFU) + 0.5F; };
        return {-kPi + (static_cast<float>(column) + part(16) * kFraction) * grid_.azimuth_step,
                grid_.elevation_min +
                    (static_cast<float>(row) + part(24) * kFraction) * grid_.elevation_step,
                0.01F * static_cast<float>(p & 0xFFFFU)};
    }
    /// The pixels of the field of view, row by row: range [cm] in the low 16 bits (0: nothing
    /// returned), then the parts of the column and of the row in 1/256. Columns count from
    /// `first_column` and wrap around. Nothing returned beside it. Before and after each row there
    /// are kMargin pixels more, what follows on the circle; after the last, kMargin + 1 empty ones:
    /// so as many pixels as that can be read at once, wherever they begin. `farthest_cm`, without
    /// margins: the farthest range of each pixel and the eight around it. Valid as long as the
    /// image.
    struct View {
        const std::uint32_t* pixels;  // the first of all, in the margin
        const std::uint16_t* farthest_cm;
        int first_column, stored_columns;
    };
    [[nodiscard]] View view() const {
        return {pixels_.data(), farthest_of_nine_cm_.data(), first_column_, stored_columns_};
    }
    static constexpr int kMargin = 3;

private:
    static constexpr float kPi = std::numbers::pi_v<float>;
    /// Counted from the first column of the field of view.
    [[nodiscard]] int stored_column(int column) const {
        return column - first_column_ + (column < first_column_ ? grid_.columns : 0);
    }
    [[nodiscard]] bool is_stored(int column) const {
        return stored_column(column) < stored_columns_;
    }
    [[nodiscard]] std::size_t pixel(int row, int column) const {
        return static_cast<std::size_t>(row) * row_length() +
               static_cast<std::size_t>(kMargin + stored_column(column));
    }
    [[nodiscard]] std::size_t row_length() const {
        return static_cast<std::size_t>(stored_columns_ + 2 * kMargin);
    }
    void find_view(const std::vector<bool>& hit);
    void fill_margins();
    void pool();

    static constexpr int kTile = 8;  // pixels, both ways
    [[nodiscard]] int tile_columns() const { return grid_.columns / kTile + 1; }

    ImageGrid grid_;
    int first_column_ = 0, stored_columns_ = 0;  // the view: all but the widest gap
    std::size_t beams_ = 0;
    std::vector<std::uint32_t> pixels_;
    std::vector<std::uint16_t> farthest_of_nine_cm_;
    std::vector<std::uint16_t> farthest_cm_;  // of each tile; tiles cover the whole circle
};

}  // namespace dynamic_filter
