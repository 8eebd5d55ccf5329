// SPDX-License-Identifier: MIT
/// @file
/// Spherical range images (Sec. III-B1): azimuth wraps, elevation covers what the data covers.
///
/// - Units: [m], [rad].
/// - Frames: the image's own: x ahead, z up, azimuth from x to y; points come in it or with a
///   transform into it.
/// - Shapes: a value per pixel, row by row; arrays of points are parallel.
/// - Ownership: points are borrowed for the call, results are the caller's.
/// - Threads: pure functions; thread-safe.
/// - Errors: none; what is no measurement falls outside.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "dynamic_filter/types.hpp"

namespace dynamic_filter {

/// Layout of an image: pixel = row * columns + column; row 0 is the lowest elevation.
struct ImageGrid {
    float azimuth_step = 0.0F;    ///< [rad]; columns * azimuth_step = 2 pi
    float elevation_step = 0.0F;  ///< [rad]
    float elevation_min = 0.0F;   ///< [rad] lower edge of row 0
    int columns = 0;              ///< around the circle
    int rows = 0;                 ///< from below to above

    /// How many pixels it has.
    [[nodiscard]] std::size_t size() const {
        return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
    }
};

/// A grid that covers [elevation_min, elevation_max] with steps of at least the ones asked for
/// [rad], which are greater than 0; the azimuth step is rounded up so that whole columns fill the
/// circle.
ImageGrid make_grid(float azimuth_step, float elevation_step, float elevation_min,
                    float elevation_max);

/// Where points fall. Parallel to the points projected.
struct Projection {
    std::vector<std::int32_t> pixel;  ///< -1: outside the grid, not finite, or at the origin
    std::vector<float> range;         ///< [m]
};

/// Projects T_image_points * p for every point. Bit-identical at every instruction-set level.
/// Thread-safe; `out` is resized.
void project(std::span<const Point> points, const Eigen::Isometry3f& T_image_points,
             const ImageGrid& grid, Projection& out);

/// Range per pixel [m]; infinity where nothing returned.
struct RangeImage {
    ImageGrid grid;            ///< where the pixels look
    std::vector<float> range;  ///< [m] grid.size() of them
};

/// The nearest range per pixel of points given in the image's own frame.
RangeImage nearest_range_image(std::span<const Point> points, const ImageGrid& grid);

/// The image with rows halved, each half holding the nearer range of its row and of the row it
/// borders: what lies between two beams counts as seen through only if both passed it. Ground at
/// grazing angles, where the next ring is metres away, is kept by that. A bordering row that
/// returned nothing does not count; an empty pixel stays empty.
RangeImage halve_rows(const RangeImage& image);

/// How densely the sensor looks, read off its scans rather than off its name.
struct BeamPattern {
    float azimuth_spacing = 0.0F;    ///< [rad] typical angle between neighbouring beams
    float elevation_spacing = 0.0F;  ///< [rad] the same between its rows
};

/// Median angular gap between neighbouring returns, along azimuth and along elevation.
/// Scans without two measured points leave 0. Costs one sort of the points.
BeamPattern estimate_beam_pattern(std::span<const Scan> scans);

/// What a sensor looks at, upwards.
struct ElevationRange {
    float min = 0.0F;  ///< [rad]
    float max = 0.0F;  ///< [rad]
};
/// Lowest and highest elevation of the measured points [rad]; {0, 0} if there are none.
ElevationRange elevation_range(std::span<const Point> points);

}  // namespace dynamic_filter
