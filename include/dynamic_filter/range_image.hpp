// SPDX-License-Identifier: MIT
/// @file
/// Spherical range images (Sec. III-B1). Columns cover the whole circle of azimuth; rows cover the
/// elevations of the data.
///
/// - Units: [m], [rad].
/// - Frames: the frame of the image: x ahead, z up, azimuth from x to y. Points are given in this
///   frame, or together with a transform into it.
/// - Shapes: one value per pixel, row by row; arrays of points are parallel.
/// - Ownership: points are borrowed for the call; results belong to the caller.
/// - Threads: pure functions; thread-safe.
/// - Errors: none; points that are not measured count as outside the image.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "dynamic_filter/types.hpp"

namespace dynamic_filter {

/// Layout of an image: pixel = row * columns + column. Row 0 has the lowest elevation.
struct ImageGrid {
    float azimuth_step = 0.0F;    ///< [rad]; columns * azimuth_step = 2 pi
    float elevation_step = 0.0F;  ///< [rad]
    float elevation_min = 0.0F;   ///< [rad] lower edge of row 0
    int columns = 0;              ///< covers the whole circle
    int rows = 0;                 ///< from the lowest to the highest elevation

    /// Number of pixels.
    [[nodiscard]] std::size_t size() const {
        return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
    }
};

/// Makes a grid that covers [elevation_min, elevation_max] with steps of at least the given size
/// [rad], which must be greater than 0. The azimuth step is rounded up so that a whole number of
/// columns fills the circle.
ImageGrid make_grid(float azimuth_step, float elevation_step, float elevation_min,
                    float elevation_max);

/// The pixel and the range of each projected point; both arrays are parallel to the points.
struct Projection {
    std::vector<std::int32_t> pixel;  ///< -1: outside the grid, not finite, or at the origin
    std::vector<float> range;         ///< [m]
};

/// Projects T_image_points * p for every point (Sec. III-B1). The results are bit-identical at
/// every instruction-set level. `out` is resized. Thread-safe.
void project(std::span<const Point> points, const Eigen::Isometry3f& T_image_points,
             const ImageGrid& grid, Projection& out);

/// One range per pixel [m]; infinity where no beam returned.
struct RangeImage {
    ImageGrid grid;            ///< directions of the pixels
    std::vector<float> range;  ///< [m], grid.size() values
};

/// Makes an image of the nearest range per pixel. `points` are in the frame of the image.
RangeImage nearest_range_image(std::span<const Point> points, const ImageGrid& grid);

/// Splits each row into two halves. Each half holds the smaller of two ranges: that of its own row
/// and that of the row next to this half. So the space between two beams counts as seen through
/// only if both beams passed it. This keeps ground at large incidence angles, where the next ring
/// of returns is metres away. A neighboring row without a return is ignored; an empty pixel stays
/// empty.
RangeImage halve_rows(const RangeImage& image);

/// Angles between the beams of the sensor, measured on its scans, so that no sensor profile is
/// needed.
struct BeamPattern {
    float azimuth_spacing = 0.0F;    ///< [rad] typical angle between neighboring beams of a row
    float elevation_spacing = 0.0F;  ///< [rad] typical angle between neighboring rows
};

/// Median angle between neighboring returns, along azimuth and along elevation. It is 0 if no scan
/// has two measured points. Cost: one sort of the points.
BeamPattern estimate_beam_pattern(std::span<const Scan> scans);

/// Elevations that a sensor covers.
struct ElevationRange {
    float min = 0.0F;  ///< [rad]
    float max = 0.0F;  ///< [rad]
};
/// Lowest and highest elevation of the measured points [rad]; {0, 0} if there are none.
ElevationRange elevation_range(std::span<const Point> points);

}  // namespace dynamic_filter
