// SPDX-License-Identifier: MIT
#include "draw/canvas.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/numbers.hpp"

namespace dynamic_filter::app {

namespace {

constexpr int kFine = 2;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

}  // namespace

Camera from_above(const Eigen::AlignedBox3f& box, float aspect) {
    constexpr float kMargin = 1.04F;
    Camera camera;
    camera.eye = box.center();
    camera.eye.z() = box.max().z() + 1.0F;
    camera.height = kMargin * std::max(box.sizes().y(), box.sizes().x() / aspect);
    return camera;
}

Camera from_aside(const Eigen::AlignedBox3f& box, float aspect, float azimuth, float elevation) {
    Camera camera;
    camera.field_of_view = 0.6F;
    camera.forward = Point(std::cos(azimuth) * std::cos(elevation),
                           std::sin(azimuth) * std::cos(elevation), -std::sin(elevation));
    camera.right = camera.forward.cross(Point::UnitZ()).normalized();
    camera.up = camera.right.cross(camera.forward);
    // As near as all corners allow: each asks for a distance of its own.
    const float tangent = std::tan(0.5F * camera.field_of_view);
    float distance = 0.0F;
    for (int corner = 0; corner < 8; ++corner) {
        const Point to_corner =
            box.corner(static_cast<Eigen::AlignedBox3f::CornerType>(corner)) - box.center();
        const float along = to_corner.dot(camera.forward),
                    across = std::max(std::abs(to_corner.dot(camera.up)),
                                      std::abs(to_corner.dot(camera.right)) / aspect);
        distance = std::max(distance, across / tangent - along);
    }
    camera.eye = box.center() - distance * camera.forward;
    return camera;
}

Eigen::AlignedBox3f box_of(const Points& points, float share) {
    Eigen::AlignedBox3f box;
    if (points.empty()) return box.extend(Point::Zero().eval());
    std::vector<float> values(points.size());
    Point low, high;
    for (int axis = 0; axis < 3; ++axis) {
        std::transform(points.begin(), points.end(), values.begin(),
                       [&](const Point& p) { return p[axis]; });
        const auto at = [&](float rank) {
            return value_at_rank(
                values, static_cast<std::size_t>(rank * static_cast<float>(values.size() - 1)));
        };
        low[axis] = at(share);
        high[axis] = at(1.0F - share);
    }
    return {low, high};
}

Canvas::Canvas(int width, int height, const Camera& camera)
    : width_(kFine * width),
      height_(kFine * height),
      camera_(camera),
      depth_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), kInfinity),
      colors_(depth_.size()) {}

void Canvas::draw(const Points& points, float size,
                  const std::function<io::Color(std::size_t)>& color) {
    constexpr float kNearest = 0.1F;  // [m]
    const bool flat = camera_.field_of_view <= 0.0F;
    const float scale = 0.5F * static_cast<float>(height_) /
                        (flat ? 0.5F * camera_.height : std::tan(0.5F * camera_.field_of_view));
    const int edge = std::max(1, static_cast<int>(std::lround(size * kFine)));
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Point from_eye = points[i] - camera_.eye;
        const float depth = from_eye.dot(camera_.forward);
        if (!(depth > kNearest)) continue;
        const float zoom = flat ? scale : scale / depth;
        const float across = 0.5F * static_cast<float>(width_) + zoom * from_eye.dot(camera_.right),
                    down = 0.5F * static_cast<float>(height_) - zoom * from_eye.dot(camera_.up);
        if (!(std::abs(across) < 1e6F && std::abs(down) < 1e6F)) continue;
        const int left = static_cast<int>(across) - edge / 2,
                  top = static_cast<int>(down) - edge / 2;
        for (int y = std::max(0, top); y < std::min(height_, top + edge); ++y) {
            for (int x = std::max(0, left); x < std::min(width_, left + edge); ++x) {
                const auto at = static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                                static_cast<std::size_t>(x);
                if (depth >= depth_[at]) continue;
                depth_[at] = depth;
                colors_[at] = color(i);
            }
        }
    }
}

/// 0..1: darker where what lies around is nearer (eye-dome lighting).
float Canvas::shade(int x, int y) const {
    constexpr int kAround = 2;
    const auto at = [&](int u, int v) {
        return depth_[static_cast<std::size_t>(v) * static_cast<std::size_t>(width_) +
                      static_cast<std::size_t>(u)];
    };
    const bool flat = camera_.field_of_view <= 0.0F;
    const float here = at(x, y), unit = flat ? 4.0F : 0.06F * here;  // [m] that makes it dark
    float response = 0.0F;
    for (const auto& [dx, dy] :
         {std::pair{kAround, 0}, {-kAround, 0}, {0, kAround}, {0, -kAround}}) {
        const int u = std::clamp(x + dx, 0, width_ - 1), v = std::clamp(y + dy, 0, height_ - 1);
        response += std::clamp((here - at(u, v)) / unit, 0.0F, 1.0F);
    }
    return 1.0F - 0.6F * response / 4.0F;
}

io::Image Canvas::picture(const io::Color& background) const {
    io::Image image{width_ / kFine, height_ / kFine, {}};
    image.pixels.reserve(depth_.size() / (kFine * kFine));
    for (int y = 0; y < height_; y += kFine) {
        for (int x = 0; x < width_; x += kFine) {
            std::array<float, 3> sum{};
            for (int k = 0; k < kFine * kFine; ++k) {
                const int u = x + k % kFine, v = y + k / kFine;
                const auto at = static_cast<std::size_t>(v) * static_cast<std::size_t>(width_) +
                                static_cast<std::size_t>(u);
                const bool empty = depth_[at] == kInfinity;
                const float light = empty ? 1.0F : shade(u, v);
                const io::Color& color = empty ? background : colors_[at];
                for (std::size_t c = 0; c < 3; ++c) sum[c] += light * color[c];
            }
            io::Color pixel;
            for (std::size_t c = 0; c < 3; ++c) {
                pixel[c] = static_cast<std::uint8_t>(sum[c] / (kFine * kFine) + 0.5F);
            }
            image.pixels.push_back(pixel);
        }
    }
    return image;
}

io::Color height_color(float share) {
    const auto mix = [&](float a, float b) {
        return static_cast<std::uint8_t>(a + (b - a) * share);
    };
    return {mix(30, 150), mix(50, 190), mix(90, 175)};
}

io::Color height_color(const Point& point, const Eigen::AlignedBox3f& box) {
    const float share = (point.z() - box.min().z()) / std::max(0.1F, box.sizes().z());
    return height_color(std::clamp(share, 0.0F, 1.0F));
}

}  // namespace dynamic_filter::app
