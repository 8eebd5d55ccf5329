// SPDX-License-Identifier: MIT
/// Points on walls and floors, drawn at random.
#pragma once

#include <vector>

#include "dynamic_filter/types.hpp"
#include "support/random.hpp"

namespace dynamic_filter::test {

/// All corner + a * along + b * across with a, b of 0..1.
struct Rectangle {
    Point corner, along, across;
};

/// The faces of a box, but for those across its x axis if it is open there.
inline std::vector<Rectangle> faces(const Point& low, const Point& high,
                                    bool open_along_x = false) {
    const Point x(high.x() - low.x(), 0, 0), y(0, high.y() - low.y(), 0),
        z(0, 0, high.z() - low.z());
    std::vector<Rectangle> out = {{low, x, y}, {low + z, x, y}, {low, x, z}, {low + y, x, z}};
    if (!open_along_x) out.insert(out.end(), {{low, y, z}, {low + x, y, z}});
    return out;
}

/// A hall with a block in it. No plane is a border of voxels.
inline std::vector<Rectangle> hall() {
    auto out = faces({-12.2F, -9.3F, -1.7F}, {15.1F, 10.2F, 5.2F});
    for (const Rectangle& face : faces({4.2F, 2.1F, -1.7F}, {6.7F, 5.3F, 1.7F}))
        out.push_back(face);
    return out;
}

/// A corridor along x whose ends nobody sees.
inline std::vector<Rectangle> corridor() {
    return faces({-60, -2.1F, -1.7F}, {60, 2.2F, 1.6F}, true);
}

/// As many per area everywhere, each off its plane by `noise` [m] at most.
inline Points points_on(const std::vector<Rectangle>& rectangles, double per_square_metre,
                        double noise, Random& random) {
    Points points;
    for (const Rectangle& r : rectangles) {
        const Point normal = r.along.cross(r.across);
        const auto count = static_cast<int>(per_square_metre * static_cast<double>(normal.norm()));
        for (int i = 0; i < count; ++i) {
            const float a = random.uniform_f(0.0, 1.0), b = random.uniform_f(0.0, 1.0);
            points.push_back(r.corner + a * r.along + b * r.across +
                             random.uniform_f(-noise, noise) * normal.normalized());
        }
    }
    return points;
}

}  // namespace dynamic_filter::test
