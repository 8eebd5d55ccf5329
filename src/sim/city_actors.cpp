// SPDX-License-Identifier: MIT
/// Traffic and people around the vehicle. Candidates are drawn at random places near the vehicle;
/// each goes straight along its street. Those that would come too close to the vehicle or to one
/// drawn before are left out, so nobody has to evade.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "sim/city.hpp"
#include "sim/people.hpp"
#include "sim/portable.hpp"

namespace dynamic_filter::sim::city {
namespace {

using Eigen::Vector2d;

constexpr double sight = 130.0;    // [m] from the vehicle, within which an actor is there
constexpr double tick = 0.25;      // [s] between the times at which gaps are checked
constexpr double longest = 120.0;  // [s] before and after the meeting

/// A rectangle on the ground.
struct Rectangle {
    Vector2d centre, axis, half;
};

Vector2d left_of(const Vector2d& d) { return {-d.y(), d.x()}; }

double reach_along(const Rectangle& r, const Vector2d& axis) {
    return r.half.x() * std::abs(r.axis.dot(axis)) +
           r.half.y() * std::abs(left_of(r.axis).dot(axis));
}

/// Theorem of the separating axis.
bool overlap(const Rectangle& a, const Rectangle& b) {
    const Vector2d between = b.centre - a.centre;
    for (const Vector2d& axis : {a.axis, left_of(a.axis), b.axis, left_of(b.axis)}) {
        if (std::abs(between.dot(axis)) > reach_along(a, axis) + reach_along(b, axis)) return false;
    }
    return true;
}

/// The rectangle that a body covers within half a tick.
Rectangle covered(const Ride& ride, const Vector2d& half, double t) {
    const double s = travelled(ride, t);
    const double stretch = 0.5 * std::abs(travelled(ride, t + tick) - s);
    const PathPoint p = at(ride.path, s);
    return {p.position, p.direction, half + Vector2d(stretch, 0.0)};
}

Vector2d room_of(const Actor& actor) {
    if (actor.on_foot) return {0.35, 0.35};
    return half_footprint(actor.vehicle.kind) + Vector2d(0.8, 0.1);
}

struct Town {
    const Route& route;
    std::vector<Actor>& actors;

    [[nodiscard]] Vector2d vehicle_at(double t) const {
        return at(route.ride.path, travelled(route.ride, t)).position;
    }
    bool sees(const Actor& actor, double t) const;
    bool limit(Actor& actor, double meeting) const;
    [[nodiscard]] bool is_free(const Actor& actor) const;
    void offer(Actor actor, double meeting);
};

bool Town::sees(const Actor& actor, double t) const {
    const Vector2d p = at(actor.vehicle.ride.path, travelled(actor.vehicle.ride, t)).position;
    return (p - vehicle_at(t)).squaredNorm() < sight * sight;
}

/// Sets the time in which the actor is near the vehicle. False if it would stay too long.
bool Town::limit(Actor& actor, double meeting) const {
    actor.from = actor.until = meeting;
    while (meeting - actor.from < longest && sees(actor, actor.from)) actor.from -= 1.0;
    while (actor.until - meeting < longest && sees(actor, actor.until)) actor.until += 1.0;
    return meeting - actor.from < longest && actor.until - meeting < longest;
}

bool Town::is_free(const Actor& actor) const {
    constexpr double far = 20.0;  // [m] beyond which two bodies cannot touch
    const Vector2d room = room_of(actor);
    const Vector2d own = half_footprint(VehicleKind::car) + Vector2d(2.0, 0.12);
    std::vector<const Actor*> others;
    for (const Actor& other : actors) {
        if (other.from < actor.until && other.until > actor.from) others.push_back(&other);
    }
    for (double t = actor.from; t < actor.until; t += tick) {
        const Rectangle mine = covered(actor.vehicle.ride, room, t);
        if ((vehicle_at(t) - mine.centre).squaredNorm() < far * far &&
            overlap(mine, covered(route.ride, own, t))) {
            return false;
        }
        for (const Actor* other : others) {
            if (t < other->from || t > other->until) continue;
            const Ride& ride = other->vehicle.ride;
            const Vector2d p = at(ride.path, travelled(ride, t)).position;
            if ((p - mine.centre).squaredNorm() < far * far &&
                overlap(mine, covered(ride, room_of(*other), t))) {
                return false;
            }
        }
    }
    return true;
}

void Town::offer(Actor actor, double meeting) {
    constexpr double shortest = 4.0;  // [s] to be worth while
    if (!limit(actor, meeting) || actor.until - actor.from < shortest) return;
    if (is_free(actor)) actors.push_back(std::move(actor));
}

/// A straight way along a street.
struct Way {
    Vector2d middle;     ///< of the street, where a vehicle is at the time `meeting`
    Vector2d direction;  ///< of the motion
    double right = 0.0;  ///< [m] from the middle of the street
    double meeting = 0.0;
};

Ride straight(const Way& way, double speed) {
    constexpr double half = 500.0;  // [m]; beyond, a path goes straight on
    const Vector2d at = way.middle - way.right * left_of(way.direction);
    return {.path = polyline({at - half * way.direction, at + half * way.direction}),
            .start = half - speed * way.meeting,
            .speed = speed};
}

VehicleKind any_vehicle(Random& random) {
    const double u = random.uniform(0.0, 1.0);
    return u < 0.08 ? VehicleKind::bus : (u < 0.25 ? VehicleKind::van : VehicleKind::car);
}

/// Lets a vehicle halt at the line before a node.
void halt_before(Ride& ride, const Vector2d& node, Random& random) {
    constexpr double line = 13.0;  // [m]
    const Vector2d& first = ride.path.points.front();
    const Vector2d direction = (ride.path.points.back() - first).normalized();
    ride.stop_at = (node - first).dot(direction) - line;
    ride.stop_time = random.uniform(3.0, 10.0);
}

bool is_on_pavement(const Vector2d& p) { return ground(p) > 0.9 * pavement; }

/// People walk along the pavement, each direction on its half of it. Some stop on their way, and
/// some stand near a wall. Empty if one would stand in the street.
std::optional<Actor> pedestrian(Way way, Random& random) {
    Actor actor;
    actor.on_foot = true;
    actor.walker = draw_walker(random);
    const double side = random.chance(0.5) ? 1.0 : -1.0;
    const bool outward = random.chance(0.5), stands = random.chance(0.12);
    const bool stops = random.chance(0.15);
    const double off = stands    ? random.uniform(8.7, 8.85)
                       : outward ? random.uniform(7.0, 7.6)
                                 : random.uniform(7.9, 8.3);
    if (outward) way.direction = -way.direction;
    way.right = outward ? -side * off : side * off;
    Ride& ride = actor.vehicle.ride;
    ride = straight(way, stands ? 0.0 : actor.walker.speed);
    if (stops) {
        ride.stop_at = 0.5 * ride.path.lengths.back();
        ride.stop_time = random.uniform(4.0, 15.0);
    }
    const Vector2d place = at(ride.path, 0.5 * ride.path.lengths.back()).position;
    if ((stands || stops) && !is_on_pavement(place)) return std::nullopt;
    return actor;
}

/// Draws the candidates of one leg.
struct Draw {
    Town& town;
    const Leg& leg;
    Random& random;
    Vector2d along = (leg.to - leg.from).normalized();

    /// On the street of the leg, `ahead` of the vehicle at some time.
    Way own(double ahead, double way, double right) {
        const double t = random.uniform(leg.enters, leg.leaves);
        const double u = (town.vehicle_at(t) - leg.from).dot(along) + ahead;
        return {leg.from + u * along, way * along, right, t};
    }
    /// On the street that crosses at the end of the leg.
    Way cross(double right) {
        const Vector2d direction = (random.chance(0.5) ? 1.0 : -1.0) * left_of(along);
        return {leg.to + random.uniform(-25.0, 25.0) * direction, direction, right,
                random.uniform(leg.enters, leg.leaves + 4.0)};
    }
    void vehicle(const Way& way, VehicleKind kind, double speed);
    void vehicles();
    void people(int count);
};

void Draw::vehicle(const Way& way, VehicleKind kind, double speed) {
    Actor actor;
    actor.vehicle = {.kind = kind,
                     .ride = straight(way, speed),
                     .brightness = static_cast<float>(random.uniform(0.5, 1.4))};
    const double towards = way.direction.dot(along);
    if (random.chance(0.2) && std::abs(towards) > 0.5)
        halt_before(actor.vehicle.ride, towards > 0.0 ? leg.to : leg.from, random);
    town.offer(std::move(actor), way.meeting);
}

void Draw::vehicles() {
    for (int i = 0; i < 4; ++i) {
        const double oncoming = random.uniform(7.0, 10.0);
        const VehicleKind kind_oncoming = any_vehicle(random);
        vehicle(own(random.uniform(-30.0, 70.0), -1.0, lane), kind_oncoming, oncoming);
        const double ahead = random.uniform(6.0, 11.0);
        const VehicleKind kind_ahead = any_vehicle(random);
        vehicle(own(random.uniform(-40.0, 60.0), 1.0, lane), kind_ahead, ahead);
        const double across = random.uniform(7.0, 10.0);
        const VehicleKind kind_across = any_vehicle(random);
        vehicle(cross(lane), kind_across, across);
    }
    for (const double way : {1.0, -1.0, 1.0, -1.0}) {
        const double speed = random.uniform(3.8, 5.5);
        vehicle(own(random.uniform(-30.0, 50.0), way, cycle_lane), VehicleKind::cyclist, speed);
    }
    const double speed = random.uniform(3.8, 5.5);
    vehicle(cross(cycle_lane), VehicleKind::cyclist, speed);
}

void Draw::people(int count) {
    for (int i = 0; i < count; ++i) {
        const bool crosses = random.chance(0.25);
        const Way way = crosses ? cross(0.0) : own(random.uniform(-40.0, 60.0), 1.0, 0.0);
        if (std::optional<Actor> actor = pedestrian(way, random)) {
            town.offer(std::move(*actor), way.meeting);
        }
    }
}

}  // namespace

std::vector<Actor> actors(std::uint64_t seed, const Route& route, int people, int drive) {
    std::vector<Actor> out;
    Town town{route, out};
    for (std::size_t i = 0; i < route.legs.size(); ++i) {
        Random random{hash(hash(seed, 0xac7), static_cast<std::uint64_t>(drive), i)};
        Draw draw{town, route.legs[i], random};
        draw.vehicles();
        draw.people(people);
    }
    return out;
}

Stride stride_of(const Actor& actor, double t) {
    constexpr double slowest = 0.12, step = 0.05;  // [m/s] with moving legs; [s]
    const Ride& ride = actor.vehicle.ride;
    const double s = travelled(ride, t);
    const double speed = std::abs(travelled(ride, t + step) - s) / step;
    const double usual = std::clamp(0.32 * actor.walker.speed, 0.12, 0.5);
    const double stride = 4.0 * leg_length * actor.walker.height * portable_sincos(usual).sin;
    const PathPoint p = at(ride.path, s);
    return {
        .position = p.position.cast<float>(),
        .heading = p.direction.cast<float>(),
        .phase = static_cast<float>(2.0 * std::numbers::pi * std::fmod(s / stride, 1.0)),
        .swing = speed < slowest ? 0.0F : static_cast<float>(std::clamp(0.32 * speed, 0.12, 0.5)),
        .speed = static_cast<float>(speed)};
}

}  // namespace dynamic_filter::sim::city
