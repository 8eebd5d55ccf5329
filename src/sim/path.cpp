// SPDX-License-Identifier: MIT
#include "sim/path.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/portable.hpp"

namespace dynamic_filter::sim {
namespace {

using Eigen::Vector2d;

constexpr double brake = 1.5;  // [m/s2]

Path measured(std::vector<Vector2d> points, bool closed) {
    if (closed) points.push_back(points.front());
    Path path{.points = std::move(points), .lengths = {0.0}, .closed = closed};
    for (std::size_t i = 1; i < path.points.size(); ++i) {
        path.lengths.push_back(path.lengths.back() + (path.points[i] - path.points[i - 1]).norm());
    }
    return path;
}

/// Tangent at a point of the polyline: the mean of the directions of its neighbors.
Vector2d tangent(const Path& path, std::size_t i) {
    const std::size_t last = path.points.size() - 1;
    const std::size_t before = i > 0 ? i - 1 : (path.closed ? last - 1 : 0);
    const std::size_t after = i < last ? i + 1 : (path.closed ? 1 : last);
    return (path.points[after] - path.points[before]).normalized();
}

/// Before and after the log, the vehicle moves at the speed of its first or last entries.
double logged(const Log& log, double t) {
    const double steps = (t - log.from) / log_step;
    const auto last = static_cast<std::ptrdiff_t>(log.way.size()) - 2;
    const auto i = static_cast<std::size_t>(
        std::clamp<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(std::floor(steps)), 0, last));
    return log.way[i] + (steps - static_cast<double>(i)) * (log.way[i + 1] - log.way[i]);
}

}  // namespace

Path polyline(std::vector<Vector2d> points) { return measured(std::move(points), false); }

Path smooth_path(const std::vector<Vector2d>& corners, bool closed) {
    const auto n = static_cast<int>(corners.size());
    const auto corner = [&](int i) {
        return corners[static_cast<std::size_t>(closed ? (i + n) % n : std::clamp(i, 0, n - 1))];
    };
    std::vector<Vector2d> points;
    constexpr int pieces = 16;
    const int first = closed ? 0 : -1;
    for (int i = first; i < n; ++i) {
        for (int k = 0; k < pieces; ++k) {
            const double u = static_cast<double>(k) / pieces;
            const double v = 1.0 - u;
            points.emplace_back(
                (v * v * v * corner(i - 1) + (3 * u * u * u - 6 * u * u + 4) * corner(i) +
                 (3 * v * v * v - 6 * v * v + 4) * corner(i + 1) + u * u * u * corner(i + 2)) /
                6.0);
        }
    }
    if (!closed) points.push_back(corners.back());
    points.erase(
        std::unique(points.begin(), points.end(),
                    [](const Vector2d& a, const Vector2d& b) { return (a - b).norm() < 1e-6; }),
        points.end());
    return measured(std::move(points), closed);
}

Path stadium(double half_straight, double radius, double start_x) {
    std::vector<Vector2d> points;
    constexpr int pieces = 64;
    for (int k = 0; k <= pieces; ++k) {
        const SinCos a = portable_sincos(std::numbers::pi * k / pieces);
        points.emplace_back(half_straight + radius * a.sin, -radius * a.cos);
    }
    for (int k = 0; k <= pieces; ++k) {
        const SinCos a = portable_sincos(std::numbers::pi * k / pieces);
        points.emplace_back(-half_straight - radius * a.sin, radius * a.cos);
    }
    points.insert(points.begin(), Vector2d(start_x, -radius));
    return measured(std::move(points), true);
}

PathPoint at(const Path& path, double s) {
    const double total = path.lengths.back();
    if (path.closed) s -= total * std::floor(s / total);
    const auto above = std::upper_bound(path.lengths.begin(), path.lengths.end(), s);
    const auto i = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(
        above - path.lengths.begin() - 1, 0, static_cast<std::ptrdiff_t>(path.points.size()) - 2));
    const double u = (s - path.lengths[i]) / (path.lengths[i + 1] - path.lengths[i]);
    const double w = std::clamp(u, 0.0, 1.0);
    return {path.points[i] + u * (path.points[i + 1] - path.points[i]),
            ((1.0 - w) * tangent(path, i) + w * tangent(path, i + 1)).normalized()};
}

double halts_at(const Ride& ride) {
    const double ramp = ride.speed / brake;
    return (ride.stop_at - ride.start - 0.5 * ride.speed * ramp) / ride.speed + ramp;
}

double travelled(const Ride& ride, double t) {
    if (!ride.log.way.empty()) return logged(ride.log, t);
    if (ride.stop_at <= ride.start || ride.speed <= 0.0) return ride.start + ride.speed * t;
    const double ramp = ride.speed / brake;           // [s]
    const double ramp_way = 0.5 * ride.speed * ramp;  // [m]
    const double cruise = (ride.stop_at - ride.start - ramp_way) / ride.speed;
    if (t < cruise) return ride.start + ride.speed * t;
    t -= cruise;
    if (t < ramp) return ride.stop_at - 0.5 * brake * (ramp - t) * (ramp - t);
    t -= ramp;
    if (t < ride.stop_time) return ride.stop_at;
    t -= ride.stop_time;
    if (t < ramp) return ride.stop_at + 0.5 * brake * t * t;
    return ride.stop_at + ramp_way + ride.speed * (t - ramp);
}

double speed_at(const Ride& ride, double t) {
    if (ride.log.way.empty()) return ride.speed;
    return (travelled(ride, t + log_step) - travelled(ride, t)) / log_step;
}

}  // namespace dynamic_filter::sim
