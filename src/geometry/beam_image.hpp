// SPDX-License-Identifier: MIT
/// The beams of a scan as an image. In addition to the range, each pixel stores the exact direction
/// of its beam.
#pragma once

#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

#include "dynamic_filter/range_image.hpp"
#include "dynamic_filter/types.hpp"

namespace dynamic_filter {

/// Directions [rad] and ranges [m] of points; all three arrays are parallel to the points. The
/// azimuth lies in [-pi, pi].
struct Directions {
    std::vector<float> azimuth, elevation, range;
};

/// Computes the spherical coordinates of T_image_points * p for every point. The results are
/// bit-identical at every instruction-set level; the angles are wrong by less than 2e-5 rad. `out`
/// is resized. Thread-safe.
void to_spherical(std::span<const Point> points, const Eigen::Isometry3f& T_image_points,
                  Directions& out);

/// A beam that returned: its direction [rad] and the range [m] of its return.
struct Beam {
    float azimuth = 0.0F, elevation = 0.0F, range = 0.0F;
};

/// Holds one beam per pixel, namely the one with the nearest return. A pixel is as wide as the
/// angle between neighboring beams of the sensor. Each pixel in the field of view takes six bytes:
/// the range in steps of 1 cm, and the direction in steps of 1/256 pixel. Immutable; thread-safe.
class BeamImage {
public:
    BeamImage() = default;
    /// `points` are in the sensor frame. Points that are not measured or that lie beyond 655 m are
    /// left out.
    BeamImage(std::span<const Point> points, const BeamPattern& spacing);

    [[nodiscard]] const ImageGrid& grid() const { return grid_; }
    /// False if no beam in a window of pixels is at least `range` [m] long. The answer is
    /// conservative: true may be wrong, because only tiles of pixels are compared. All rows must
    /// exist; columns may wrap around the circle, but at most once.
    [[nodiscard]] bool reaches(float range, int first_row, int last_row, int first_column,
                               int last_column) const;
    /// Share of the pixels in the field of view that hold a beam; 0 if there are no pixels.
    [[nodiscard]] float coverage() const {
        const int pixels = grid_.rows * stored_columns_;
        return pixels == 0 ? 0.0F : static_cast<float>(beams_) / static_cast<float>(pixels);
    }
    [[nodiscard]] bool empty() const { return stored_columns_ == 0; }
    [[nodiscard]] std::size_t bytes() const {
        return pixels_.size() * sizeof(std::uint32_t) +
               (farthest_of_nine_cm_.size() + farthest_cm_.size()) * sizeof(std::uint16_t);
    }
    /// False if no beam returned in this pixel.
    [[nodiscard]] bool has_beam(int row, int column) const {
        return is_stored(column) && (pixels_[pixel(row, column)] & 0xFFFFU) != 0;
    }
    /// Returns the beam of a pixel. Call it only if has_beam() is true.
    [[nodiscard]] Beam beam(int row, int column) const {
        const std::uint32_t p = pixels_[pixel(row, column)];
        constexpr float kFraction = 1.0F / 256.0F;
        const auto part = [&](int shift) { return static_cast<float>(p >> shift & 0xFFU) + 0.5F; };
        return {-kPi + (static_cast<float>(column) + part(16) * kFraction) * grid_.azimuth_step,
                grid_.elevation_min +
                    (static_cast<float>(row) + part(24) * kFraction) * grid_.elevation_step,
                0.01F * static_cast<float>(p & 0xFFFFU)};
    }
    /// The pixels of the field of view, row by row. The low 16 bits of a pixel hold the range [cm]
    /// (0: no return); the bits above them hold the fractions of the column and of the row in
    /// 1/256. Columns count from `first_column` and wrap around. Pixels outside the field of view
    /// have no return and are not stored. Each row has kMargin extra pixels before and after it,
    /// which repeat the pixels that follow on the circle. After the last row there are kMargin + 1
    /// empty pixels. So kMargin + 1 pixels can be read at once from any position. `farthest_cm` has
    /// no margins; it holds the farthest range of each pixel and of the eight pixels around it. The
    /// view is valid as long as the image.
    struct View {
        const std::uint32_t* pixels;  // first stored pixel, which lies in the margin
        const std::uint16_t* farthest_cm;
        int first_column, stored_columns;
    };
    [[nodiscard]] View view() const {
        return {pixels_.data(), farthest_of_nine_cm_.data(), first_column_, stored_columns_};
    }
    static constexpr int kMargin = 3;

private:
    static constexpr float kPi = std::numbers::pi_v<float>;
    /// Returns the column counted from the first column of the field of view.
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

    static constexpr int kTile = 8;  // pixels, in both directions
    [[nodiscard]] int tile_columns() const { return grid_.columns / kTile + 1; }

    ImageGrid grid_;
    // The field of view: the circle without its widest gap.
    int first_column_ = 0, stored_columns_ = 0;
    std::size_t beams_ = 0;
    std::vector<std::uint32_t> pixels_;
    std::vector<std::uint16_t> farthest_of_nine_cm_;
    std::vector<std::uint16_t> farthest_cm_;  // one per tile; tiles cover the whole circle
};

}  // namespace dynamic_filter
