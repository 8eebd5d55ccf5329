// SPDX-License-Identifier: MIT
#include "sim/traffic.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dynamic_filter::sim {
namespace {

using Eigen::Vector2d;

constexpr double headway = 1.1;                   // [s] to the vehicle ahead
constexpr double strongest = 1.4, comfort = 2.0;  // [m/s2] usual acceleration and braking
constexpr double hardest = 5.0;                   // [m/s2] emergency braking
constexpr double side_room = 0.25;                // [m] beside vehicles that are passed
constexpr double merge = 16.0;                    // [m] that must be free to swerve
constexpr double line_gap = 0.6;  // [m] distance from the line at which vehicles halt

struct VehicleState {
    double u = 0.0, v = 0.0, a = 0.0;
    std::size_t halts = 0;  // number of completed halts
    double since = 0.0;     // start of the present halt
    bool halted = false;
    double low = 0.0, high = 0.0;  // y range of the vehicle
};

struct Traffic {
    const std::vector<Driver>& drivers;
    const std::vector<Signal>& signals;
    std::vector<VehicleState> states;
    double time = 0.0;

    [[nodiscard]] Vector2d half(std::size_t i) const { return half_footprint(drivers[i].kind); }
};

struct Span {
    double low = std::numeric_limits<double>::max(), high = -low;
};

/// Range of y that the vehicle covers on the way from `u0` to `u1`.
Span covered(const Driver& driver, double u0, double u1) {
    const double half = half_footprint(driver.kind).y();
    Span span;
    const int steps = 1 + static_cast<int>((u1 - u0) / 1.5);
    for (int k = 0; k <= steps; ++k) {
        const double y = lateral(driver, u0 + (u1 - u0) * k / steps);
        span.low = std::min(span.low, y - half);
        span.high = std::max(span.high, y + half);
    }
    return span;
}

bool is_in(const Traffic& traffic, const Span& span, std::size_t j) {
    const VehicleState& other = traffic.states[j];
    return other.low < span.high + side_room && other.high > span.low - side_room;
}

/// True if no vehicle stands where vehicle i is about to swerve to, or approaches from behind.
bool may_merge(const Traffic& traffic, std::size_t i) {
    const VehicleState& state = traffic.states[i];
    const double length = traffic.half(i).x();
    const Span span = covered(traffic.drivers[i], state.u - length, state.u + merge);
    for (std::size_t j = 0; j < traffic.states.size(); ++j) {
        const VehicleState& other = traffic.states[j];
        if (j == i || traffic.drivers[j].way != traffic.drivers[i].way) continue;
        const double ahead = other.u - state.u;
        const double touch = length + traffic.half(j).x();
        if (ahead > touch + 3.0 || ahead < -(touch + 4.0 + 4.5 * other.v)) continue;
        const bool follows = ahead < -touch && is_in(traffic, {state.low, state.high}, j);
        if (!follows && is_in(traffic, span, j)) return false;
    }
    return true;
}

/// Acceleration [m/s2] at speed `v` with `gap` to the vehicle ahead; `rest` is the gap when both
/// stand.
double follow(const VehicleState& state, double desired, double gap, double v, double rest) {
    const double closing = state.v * (state.v - v) / (2.0 * std::sqrt(strongest * comfort));
    const double wanted = rest + std::max(0.0, state.v * headway + closing);
    const double ratio = wanted / std::max(gap, 0.1), share = state.v / desired;
    return strongest * (1.0 - share * share * share * share - ratio * ratio);
}

/// True if the vehicle ahead will halt so close behind the line that this one would stand on the
/// crossing.
bool is_blocked(const Traffic& traffic, std::size_t i, double line) {
    const double needed = line + 2.0 * stop_line + 2.0 * traffic.half(i).x() + 2.0;
    const Span span = covered(traffic.drivers[i], line, line + 4.0);
    for (std::size_t j = 0; j < traffic.states.size(); ++j) {
        const VehicleState& other = traffic.states[j];
        if (j == i || traffic.drivers[j].way != traffic.drivers[i].way || other.u < line) continue;
        const double halts = other.u - traffic.half(j).x() + other.v * other.v / (2.0 * comfort);
        if (other.a < 0.1 && halts < needed && is_in(traffic, span, j)) return true;
    }
    return false;
}

double at_signals(const Traffic& traffic, std::size_t i) {
    const VehicleState& state = traffic.states[i];
    const Driver& driver = traffic.drivers[i];
    double out = strongest;
    for (const Signal& signal : traffic.signals) {
        const double line = driver.way * signal.at - stop_line;
        const double gap = line - state.u - traffic.half(i).x();
        const double needed = state.v * state.v / 6.0;  // [m] to stop with 3 m/s2
        if (gap < 0.0 || gap > 60.0 || (gap < needed && state.v > 1.0)) continue;
        if (is_red(signal, traffic.time) || is_blocked(traffic, i, line))
            out = std::min(out, follow(state, driver.speed, gap, 0.0, line_gap));
    }
    return out;
}

double behind_others(const Traffic& traffic, std::size_t i) {
    const VehicleState& state = traffic.states[i];
    const Driver& driver = traffic.drivers[i];
    const double length = traffic.half(i).x();
    double out = strongest;
    for (std::size_t j = 0; j < traffic.states.size(); ++j) {
        const VehicleState& other = traffic.states[j];
        const double ahead = other.u - state.u;
        if (j == i || traffic.drivers[j].way != driver.way || ahead <= 0.0 || ahead > 60.0)
            continue;
        const double touch = length + traffic.half(j).x();
        const Span span = covered(driver, std::max(state.u, other.u - touch), other.u + touch);
        if (!is_in(traffic, span, j)) continue;
        out = std::min(out, follow(state, driver.speed, ahead - touch, other.v, driver.gap));
    }
    return out;
}

/// Drives to the next halt, stands there, and goes on.
double at_halts(Traffic& traffic, std::size_t i) {
    VehicleState& state = traffic.states[i];
    const Driver& driver = traffic.drivers[i];
    if (state.halts == driver.halts.size()) return strongest;
    const Halt& halt = driver.halts[state.halts];
    const double left = halt.at - state.u;
    if (!state.halted && (left > 1.5 || state.v > 0.15)) {
        const bool near = left < state.v * state.v / 3.0 + 3.0;
        if (halt.time == 0.0 && halt.gives_way && near && may_merge(traffic, i)) {
            ++state.halts;
            return strongest;
        }
        return left > 80.0 ? strongest : follow(state, driver.speed, left, 0.0, line_gap);
    }
    if (!state.halted) {
        state.halted = true;
        state.since = traffic.time;
    }
    const bool ready = traffic.time >= state.since + halt.time && traffic.time >= halt.not_before;
    if (!ready || (halt.gives_way && !may_merge(traffic, i))) return -hardest;
    state.halted = false;
    ++state.halts;
    return strongest;
}

void update_width(Traffic& traffic, std::size_t i) {
    VehicleState& state = traffic.states[i];
    const double length = traffic.half(i).x();
    const Span span = covered(traffic.drivers[i], state.u - length, state.u + length);
    state.low = span.low;
    state.high = span.high;
}

void advance(Traffic& traffic) {
    std::vector<double> accelerations;
    for (std::size_t i = 0; i < traffic.states.size(); ++i) {
        const double free = follow(traffic.states[i], traffic.drivers[i].speed, 1e6, 0.0, 0.0);
        accelerations.push_back(std::min(
            {free, behind_others(traffic, i), at_signals(traffic, i), at_halts(traffic, i)}));
    }
    for (std::size_t i = 0; i < traffic.states.size(); ++i) {
        VehicleState& state = traffic.states[i];
        state.a = std::clamp(accelerations[i], -hardest, strongest);
        const double v = std::max(0.0, state.v + state.a * log_step);
        // In the model, vehicles creep towards their gap for ever; very slow ones are stopped.
        state.v = v < 0.04 && state.a < 0.25 ? 0.0 : v;
        state.u += state.v * log_step;
        update_width(traffic, i);
    }
    traffic.time += log_step;
}

/// The curve of a driver from `first` to `last`, in the plane.
Path course(const Driver& driver, double first, double last) {
    std::vector<double> ways = {first - 50.0, first - 1.0};
    for (const Swerve& swerve : driver.swerves) {
        for (double u = swerve.from; u < swerve.until + 0.25; u += 0.5) ways.push_back(u);
    }
    ways.push_back(last + 1.0);
    ways.push_back(last + 50.0);
    std::sort(ways.begin(), ways.end());
    std::vector<Vector2d> points;
    for (const double u : ways) {
        const Vector2d p(driver.way * u, lateral(driver, u));
        if (points.empty() || (p - points.back()).norm() > 0.05) points.push_back(p);
    }
    return polyline(std::move(points));
}

/// Length of the path up to a position along the street.
double length_at(const Path& path, double way, double u) {
    const auto above =
        std::upper_bound(path.points.begin(), path.points.end(), u,
                         [&](double value, const Vector2d& p) { return value < way * p.x(); });
    const auto i = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(
        above - path.points.begin() - 1, 0, static_cast<std::ptrdiff_t>(path.points.size()) - 2));
    const double a = way * path.points[i].x(), b = way * path.points[i + 1].x();
    return path.lengths[i] + (u - a) / (b - a) * (path.lengths[i + 1] - path.lengths[i]);
}

}  // namespace

double lateral(const Driver& driver, double u) {
    double y = driver.y;
    for (const Swerve& swerve : driver.swerves) {
        const double s = std::clamp((u - swerve.from) / (swerve.until - swerve.from), 0.0, 1.0);
        y += (swerve.to - y) * s * s * s * (10.0 + s * (6.0 * s - 15.0));
    }
    return y;
}

std::vector<Ride> drive(const std::vector<Driver>& drivers, const std::vector<Signal>& signals,
                        double from, double until) {
    Traffic traffic{.drivers = drivers, .signals = signals, .states = {}, .time = from};
    for (const Driver& driver : drivers) {
        traffic.states.push_back({.u = driver.start, .v = driver.moving ? driver.speed : 0.0});
        update_width(traffic, traffic.states.size() - 1);
    }
    std::vector<std::vector<double>> ways(drivers.size());
    while (traffic.time < until) {
        for (std::size_t i = 0; i < drivers.size(); ++i) ways[i].push_back(traffic.states[i].u);
        advance(traffic);
    }
    std::vector<Ride> rides;
    for (std::size_t i = 0; i < drivers.size(); ++i) {
        Ride ride{.path = course(drivers[i], ways[i].front(), ways[i].back()),
                  .speed = drivers[i].speed};
        ride.log.from = from;
        for (const double u : ways[i])
            ride.log.way.push_back(length_at(ride.path, drivers[i].way, u));
        rides.push_back(std::move(ride));
    }
    return rides;
}

}  // namespace dynamic_filter::sim
