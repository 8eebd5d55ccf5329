// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "sim/city.hpp"
#include "sim/portable.hpp"

namespace dynamic_filter::sim::city {
namespace {

using Eigen::Vector2d;
using Node = std::array<int, 2>;

constexpr double brake = 1.8, accelerate = 1.8;          // [m/s2]
constexpr double right_radius = 6.0, left_radius = 9.0;  // [m] of turns
constexpr double right_speed = 3.8, left_speed = 4.6;    // [m/s] in turns
constexpr double stop_line = 13.0;                       // [m] before the node
constexpr double grain = 0.5;                            // [m] between limits of the speed

/// A limit of the speed on a part of the route, or a halt at its beginning.
struct Limit {
    double begin = 0.0, end = 0.0;  // [m]
    double speed = 0.0;             // [m/s]
    double halt = 0.0;              // [s]
};

Node step(const Node& from, int direction) {
    constexpr int dx[] = {1, 0, -1, 0}, dy[] = {0, 1, 0, -1};
    return {from[0] + dx[direction], from[1] + dy[direction]};
}

Vector2d at_node(const Node& n) { return node(n[0], n[1]); }

/// A walk over the streets of a rectangle, without turning back. Of the streets that go on from a
/// node, it takes one of those that it took least often, more often straight ahead.
std::vector<Node> walk(Random& random, int across, double length) {
    const auto inside = [&](const Node& n) {
        return n[0] >= 0 && n[0] <= across && n[1] >= 0 && n[1] <= across;
    };
    std::map<std::pair<Node, Node>, int> taken;
    const auto street = [](const Node& a, const Node& b) { return std::minmax(a, b); };
    std::vector<Node> nodes = {{random.below(across + 1), random.below(across + 1)}};
    for (int back = -1; length > 0.0;) {
        const Node here = nodes.back();
        std::vector<int> best;
        int least = 0;
        for (int direction = 0; direction < 4; ++direction) {
            const Node next = step(here, direction);
            if (direction == back || !inside(next)) continue;
            const int times = taken[street(here, next)];
            if (best.empty() || times < least) best.clear(), least = times;
            const bool straight = direction == (back + 2) % 4;
            if (times == least) best.insert(best.end(), straight ? 3 : 1, direction);
        }
        const int direction =
            best[static_cast<std::size_t>(random.below(static_cast<int>(best.size())))];
        const Node next = step(here, direction);
        ++taken[street(here, next)];
        nodes.push_back(next);
        length -= pitch[direction % 2];
        back = (direction + 2) % 4;
    }
    return nodes;
}

/// Collects the points of the path, and the length so far.
struct Drawing {
    std::vector<Vector2d> points;
    double length = 0.0;

    void add(const Vector2d& p) {
        if (!points.empty()) length += (p - points.back()).norm();
        points.push_back(p);
    }
};

Vector2d right_of(const Vector2d& d) { return {d.y(), -d.x()}; }

/// A quarter of a circle from heading `d` to heading `e` around the corner of the two lanes.
Limit draw_turn(Drawing& drawing, const Vector2d& corner, const Vector2d& d, const Vector2d& e) {
    const bool right = e.dot(right_of(d)) > 0.0;
    const double radius = right ? right_radius : left_radius;
    const Vector2d centre = corner - radius * d + radius * e;
    for (const double before : {3.0, 1.5}) drawing.add(corner - (radius + before) * d);
    Limit limit{.begin = drawing.length, .speed = right ? right_speed : left_speed};
    constexpr int pieces = 16;
    for (int i = 0; i <= pieces; ++i) {
        const SinCos a = portable_sincos(0.5 * std::numbers::pi * i / pieces);
        drawing.add(centre + radius * (a.sin * d - a.cos * e));
    }
    limit.end = drawing.length;
    for (const double after : {1.5, 3.0}) drawing.add(corner + (radius + after) * e);
    return limit;
}

/// The highest speed at every `grain` of the way, so that the vehicle can brake in time.
std::vector<double> speed_limits(const std::vector<Limit>& limits, double length) {
    std::vector<double> out(static_cast<std::size_t>(length / grain) + 2, 10.0);
    for (const Limit& limit : limits) {
        const auto first = static_cast<std::size_t>(limit.begin / grain);
        const auto last = static_cast<std::size_t>(limit.end / grain);
        for (std::size_t i = first; i <= last && i < out.size(); ++i)
            out[i] = std::min(out[i], limit.speed);
    }
    for (std::size_t i = out.size() - 1; i-- > 0;)
        out[i] = std::min(out[i], std::sqrt(out[i + 1] * out[i + 1] + 2.0 * brake * grain));
    return out;
}

/// The limit between two of the speed_limits(), at constant braking.
double limit_at(const std::vector<double>& allowed, double s) {
    const auto i = static_cast<std::size_t>(s / grain);
    const double u = s / grain - static_cast<double>(i);
    return std::sqrt((1.0 - u) * allowed[i] * allowed[i] + u * allowed[i + 1] * allowed[i + 1]);
}

/// Drives along the way from its beginning at full speed.
Log drive(const std::vector<Limit>& limits, double length) {
    constexpr double creep = 0.2;  // [m/s] least speed but for halts
    const std::vector<double> allowed = speed_limits(limits, length);
    Log log;
    double s = 0.0, speed = allowed.front();
    auto halt = limits.begin();
    while (s < length) {
        log.way.push_back(s);
        while (halt != limits.end() && (halt->halt == 0.0 || halt->begin < s)) ++halt;
        speed = std::min(speed + accelerate * log_step, std::max(creep, limit_at(allowed, s)));
        const double next = s + speed * log_step;
        if (halt != limits.end() && next >= halt->begin) {
            s = halt->begin;
            for (int k = 0; k < static_cast<int>(halt->halt / log_step); ++k) log.way.push_back(s);
            speed = 0.0;
            ++halt;
        } else {
            s = next;
        }
    }
    log.way.push_back(s);
    return log;
}

/// [s] at which the log reaches a distance.
double reaches(const Log& log, double s) {
    const auto at = std::lower_bound(log.way.begin(), log.way.end(), s);
    return log_step * static_cast<double>(at - log.way.begin());
}

}  // namespace

int blocks_across(double km) {
    // Of the streets of so many blocks, a drive takes most once and some several times.
    const double streets = 2.0 * 1.2 * 0.5 * (pitch[0] + pitch[1]);
    return std::max(1, static_cast<int>(std::sqrt(1000.0 * km / streets)));
}

Route route(std::uint64_t seed, double km, int drive_number) {
    constexpr double begin = 30.0;  // [m] after the first node
    const double length = 1000.0 * km;
    Random random{hash(seed, 0x2007e, static_cast<std::uint64_t>(drive_number))};
    const std::vector<Node> nodes = walk(random, blocks_across(km), length + 2.0 * pitch[0]);
    Route route;
    Drawing drawing;
    std::vector<Limit> limits;
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
        Leg leg{.from = at_node(nodes[i]), .to = at_node(nodes[i + 1])};
        const double whole = (leg.to - leg.from).norm();
        const Vector2d d = (leg.to - leg.from) / whole;
        if (i == 0) drawing.add(leg.from + begin * d + lane * right_of(d));
        leg.begin = drawing.length;
        const double cruise = random.uniform(8.2, 10.0);
        const bool halts = random.chance(0.12);
        const double halt = random.uniform(4.0, 12.0);
        const Vector2d line = leg.to - stop_line * d + lane * right_of(d);
        drawing.add(line);
        limits.push_back({.begin = leg.begin, .end = drawing.length, .speed = cruise});
        const double place = grain * std::floor(drawing.length / grain);
        if (halts) limits.push_back({.begin = place, .end = place, .halt = halt});
        if (i + 2 < nodes.size()) {
            const Vector2d e = (at_node(nodes[i + 2]) - leg.to).normalized();
            const Vector2d corner = leg.to + lane * (right_of(d) + right_of(e));
            if (std::abs(d.dot(e)) < 0.5) limits.push_back(draw_turn(drawing, corner, d, e));
        }
        leg.end = drawing.length;
        route.legs.push_back(leg);
    }
    route.ride.path = polyline(std::move(drawing.points));
    route.ride.log = drive(limits, std::min(length, drawing.length) + 20.0);
    route.duration = reaches(route.ride.log, length);
    for (Leg& leg : route.legs) {
        leg.enters = reaches(route.ride.log, leg.begin);
        leg.leaves = reaches(route.ride.log, leg.end);
    }
    std::erase_if(route.legs, [&](const Leg& leg) { return leg.begin > length; });
    return route;
}

}  // namespace dynamic_filter::sim::city
