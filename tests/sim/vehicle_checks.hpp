// SPDX-License-Identifier: MIT
/// Outlines of vehicles over time, and how long they stand.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "sim/bodies.hpp"
#include "sim/obstacles.hpp"

namespace dynamic_filter::sim {

/// The rectangle that a vehicle covers at a time.
inline Obstacle outline(VehicleKind kind, const Ride& ride, double t) {
    const PathPoint p = at(ride.path, travelled(ride, t));
    return {.centre = p.position, .half = half_footprint(kind), .axis = p.direction};
}

/// [m] Between two rectangles along the best separating axis: negative if they overlap.
inline double clearance(const Obstacle& a, const Obstacle& b) {
    double best = std::numeric_limits<double>::lowest();
    for (const Eigen::Vector2d& along : {a.axis, b.axis}) {
        for (const Eigen::Vector2d& axis : {along, Eigen::Vector2d(-along.y(), along.x())}) {
            double reach = 0.0;
            for (const Obstacle* o : {&a, &b}) {
                const Eigen::Vector2d across(-o->axis.y(), o->axis.x());
                reach += o->half.x() * std::abs(o->axis.dot(axis)) +
                         o->half.y() * std::abs(across.dot(axis)) + o->radius;
            }
            best = std::max(best, std::abs((a.centre - b.centre).dot(axis)) - reach);
        }
    }
    return best;
}

struct Rest {
    double from = 0.0, until = 0.0;  ///< [s]
    double s = 0.0;                  ///< [m] of the path
};

/// Where and when a ride stands for at least two seconds between 0 and `duration`.
inline std::vector<Rest> rests(const Ride& ride, double duration) {
    std::vector<Rest> out;
    double since = 0.0;
    for (double t = 0.0; t <= duration; t += 0.1) {
        const double s = travelled(ride, t);
        if (travelled(ride, t + 0.1) - s < 1e-6 && t + 0.1 <= duration) continue;
        if (t - since > 2.0) out.push_back({since, t, s});
        since = t + 0.1;
    }
    return out;
}

inline double longest(const std::vector<Rest>& rests) {
    double out = 0.0;
    for (const Rest& rest : rests) out = std::max(out, rest.until - rest.from);
    return out;
}

}  // namespace dynamic_filter::sim
