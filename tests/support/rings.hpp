// SPDX-License-Identifier: MIT
/// Scans of a rotating sensor.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "dynamic_filter/types.hpp"

namespace dynamic_filter::io {

/// A scan of `beams` beams of a sensor at the origin, 1.7 m above the ground, in a street with
/// walls on both sides and a wall at its end; column by column. `sigma` is the range noise [m].
inline Points scan_of(int beams, unsigned seed, float sigma = 0.01F) {
    constexpr int kColumns = 900;
    std::mt19937 random(seed);
    std::normal_distribution<float> noise(0.0F, 1.0F);
    const float low = -25.0F, high = 15.0F, degree = std::numbers::pi_v<float> / 180.0F;
    Points points;
    for (int column = 0; column < kColumns; ++column) {
        const float azimuth =
            -2.0F * std::numbers::pi_v<float> * static_cast<float>(column) / kColumns;
        for (int beam = 0; beam < beams; ++beam) {
            const float share = static_cast<float>(beam) / static_cast<float>(beams - 1);
            const float elevation = (high + share * (low - high)) * degree;
            const Point ray(std::cos(elevation) * std::cos(azimuth),
                            std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
            float range = 80.0F;
            if (ray.z() < 0.0F) range = std::min(range, -1.7F / ray.z());
            if (ray.y() > 0.0F) range = std::min(range, 11.0F / ray.y());
            if (ray.y() < 0.0F) range = std::min(range, -7.0F / ray.y());
            if (ray.x() > 0.0F) range = std::min(range, 30.0F / ray.x());
            if (range < 80.0F) points.push_back((range + sigma * noise(random)) * ray);
        }
    }
    return points;
}

inline Points moved(Points points, const Point& by) {
    for (Point& p : points) p += by;
    return points;
}

}  // namespace dynamic_filter::io
