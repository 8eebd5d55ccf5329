// SPDX-License-Identifier: MIT
/// Point clouds drawn without a browser or a graphics card.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "draw/png.hpp"
#include "dynamic_filter/types.hpp"

namespace dynamic_filter::app {

/// Looks along `forward`; `right` and `up` span the picture. Orthographic if `field_of_view` is 0.
struct Camera {
    Point eye = Point::Zero();
    Point forward = -Point::UnitZ(), right = Point::UnitX(), up = Point::UnitY();
    float field_of_view = 0.0F;  ///< [rad] over the picture's height
    float height = 1.0F;         ///< [m] over the picture's height, if orthographic
};

/// Looks down from straight above, x to the right.
Camera from_above(const Eigen::AlignedBox3f& box, float aspect);
/// Looks at the box's middle along a direction: azimuth from x, elevation below the horizon [rad].
Camera from_aside(const Eigen::AlignedBox3f& box, float aspect, float azimuth, float elevation);

/// The box of the points without the outermost ones of each axis (`share` at either end).
Eigen::AlignedBox3f box_of(const Points& points, float share);

/// Draws twice as fine, and shades edges by the depth around them, so that shapes can be told.
class Canvas {
public:
    Canvas(int width, int height, const Camera& camera);

    /// Each point as a square of about `size` [pixels]; the nearest wins.
    void draw(const Points& points, float size,
              const std::function<io::Color(std::size_t point)>& color);

    [[nodiscard]] io::Image picture(const io::Color& background) const;

private:
    [[nodiscard]] float shade(int x, int y) const;
    int width_, height_;  // of the fine picture
    Camera camera_;
    std::vector<float> depth_;  // [m]
    std::vector<io::Color> colors_;
};

/// Dark blue at the ground to light grey-green above; none of it near red.
io::Color height_color(float share);
/// Colours a point by its height between the bottom and the top of the box.
io::Color height_color(const Point& point, const Eigen::AlignedBox3f& box);
constexpr io::Color kRemovedColor{214, 39, 40}, kUnknownColor{148, 64, 150};

}  // namespace dynamic_filter::app
