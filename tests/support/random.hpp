// SPDX-License-Identifier: MIT
/// Repeatable random numbers (splitmix64): the same on every platform, never seeded by the clock.
#pragma once

#include <cstdint>
#include <numbers>

#include "dynamic_filter/types.hpp"

namespace dynamic_filter::test {

class Random {
public:
    explicit Random(std::uint64_t seed) : state_(seed) {}

    std::uint64_t next() {
        std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ULL);
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
        return z ^ (z >> 31);
    }
    /// In [low, high).
    double uniform(double low, double high) {
        return low + (high - low) * static_cast<double>(next() >> 11) * 0x1.0p-53;
    }
    float uniform_f(double low, double high) { return static_cast<float>(uniform(low, high)); }
    /// In [0, count).
    std::size_t below(std::size_t count) { return static_cast<std::size_t>(next() % count); }
    bool chance(double share) { return uniform(0.0, 1.0) < share; }

    Point point(double half_width) {
        const float x = uniform_f(-half_width, half_width), y = uniform_f(-half_width, half_width);
        return {x, y, uniform_f(-half_width, half_width)};
    }
    Points points(std::size_t count, double half_width) {
        Points result(count);
        for (Point& p : result) p = point(half_width);
        return result;
    }
    Eigen::Vector3d direction() {
        const double z = uniform(-1.0, 1.0), a = uniform(0.0, 2.0 * std::numbers::pi);
        const double across = std::sqrt(1.0 - z * z);
        return {across * std::cos(a), across * std::sin(a), z};
    }
    /// Turned about any axis by at most `angle` [rad], moved by at most `reach` [m] per axis.
    Pose pose(double reach, double angle) {
        Pose pose = Pose::Identity();
        pose.linear() = Eigen::AngleAxisd(uniform(-angle, angle), direction()).toRotationMatrix();
        pose.translation() = point(reach).cast<double>();
        return pose;
    }

private:
    std::uint64_t state_;
};

}  // namespace dynamic_filter::test
