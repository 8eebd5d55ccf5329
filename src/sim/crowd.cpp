// SPDX-License-Identifier: MIT
#include "sim/crowd.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/portable.hpp"
#include "sim/social_force.hpp"

namespace dynamic_filter::sim {
namespace {

using Eigen::Vector2d;

constexpr double settle_time = 15.0;  // [s] that the crowd walks before the simulation starts
constexpr double relaxation = 0.5;    // [s] to reach the desired velocity
constexpr double wall_strength = 3.0, wall_range = 0.15;
constexpr double fastest = 1.7;          // [m/s]
constexpr double look_ahead = 2.0;       // [m] along the route
constexpr double strongest_force = 6.0;  // [m/s2]

struct Body {
    Vector2d position, velocity = Vector2d::Zero(), heading, leg_start;
    double phase = 0.0, swing = 0.0, speed = 0.0;
    double pause_until = -1.0;
    double leg_since = 0.0;  // time at which the present waypoint became the target
    std::size_t next = 0;
    bool standing = false, waiting = false;
};

struct CrowdState {
    const CrowdPlan& plan;
    std::vector<Body> bodies;
    std::vector<Pair> pairs;  // pairs of walkers near each other
    std::vector<Mover> movers;
    double time = 0.0;
};

/// True if no vehicle comes near while this walker goes from `a` to `b`.
bool is_free_to_cross(const CrowdState& state, const Walker& walker, const Vector2d& a,
                      const Vector2d& b) {
    const double duration = (b - a).norm() / walker.speed + 1.0;
    for (int k = 0; 0.25 * k <= duration; ++k) {
        const double ahead = 0.25 * k;
        const Vector2d here = a + (b - a) * std::min(1.0, ahead / duration);
        for (const Mover& mover : state.plan.movers(state.time + ahead)) {
            const double clearance = mover.radius + 1.5;
            if ((mover.centre - here).squaredNorm() < clearance * clearance) return false;
        }
    }
    return true;
}

void aim_at_next(const CrowdState& state, const Walker& walker, Body& body) {
    const Waypoint& reached = walker.route[body.next];
    body.leg_start = body.position;
    body.leg_since = state.time;
    body.next = (body.next + 1) % walker.route.size();
    body.pause_until = state.time + reached.pause;
    if (reached.release) body.pause_until = reached.release(body.pause_until);
    body.standing = body.pause_until > state.time;
    body.waiting = reached.gated;
}

/// Follows the route: the walker stands, waits at the kerb, goes on, or skips a waypoint that is
/// blocked for too long.
void steer(const CrowdState& state, const Walker& walker, Body& body) {
    const Waypoint& target = walker.route[body.next];
    if (body.standing && state.time < body.pause_until) return;
    body.standing = false;
    if (body.waiting) {
        body.waiting = !is_free_to_cross(state, walker, body.position, target.at);
        body.leg_since = state.time;
        if (body.waiting) return;
    }
    const Vector2d to = target.at - body.position;
    const Vector2d leg = unit_or(target.at - body.leg_start, body.heading);
    const double past = -to.dot(leg);
    const double aside = std::abs(to.x() * leg.y() - to.y() * leg.x());
    const bool reached = to.norm() < target.reach || (past > 0.0 && aside < 2.0 * target.reach);
    const double expected = (target.at - body.leg_start).norm() / walker.speed;
    bool blocked = state.time - body.leg_since > 2.0 * expected + 8.0;
    if (blocked && !reached) {
        const Waypoint& after = walker.route[(body.next + 1) % walker.route.size()];
        blocked = is_clear(state.plan.field, body.position, after.at, 0.5 * walker.radius);
    }
    if (reached || blocked) aim_at_next(state, walker, body);
}

Vector2d desired_velocity(const Walker& walker, const Body& body) {
    if (body.standing || body.waiting) {
        const auto last = (body.next + walker.route.size() - 1) % walker.route.size();
        const Vector2d back = walker.route[last].at - body.position;  // keeps the place
        return back.norm() < 0.15 ? Vector2d(0.0, 0.0) : Vector2d(0.6 * unit_or(back, back));
    }
    // Goes back to the line between the waypoints first, so that walkers stay in their lanes.
    const Vector2d& target = walker.route[body.next].at;
    const Vector2d& from =
        walker.route[(body.next + walker.route.size() - 1) % walker.route.size()].at;
    const Vector2d leg = unit_or(target - from, body.heading);
    const double left = (target - body.position).dot(leg);
    const Vector2d carrot = target - std::max(0.0, left - look_ahead) * leg;
    return walker.speed * unit_or(carrot - body.position, body.heading);
}

void add_pair_forces(const CrowdState& state, std::vector<Vector2d>& forces) {
    for (const auto& [i, j] : state.pairs) {
        const Walker& a = state.plan.walkers[i];
        const Walker& b = state.plan.walkers[j];
        const Vector2d offset = state.bodies[i].position - state.bodies[j].position;
        const double gap = std::sqrt(offset.squaredNorm()) - a.radius - b.radius;
        const Vector2d& heading = state.bodies[i].heading;
        const bool oncoming = heading.dot(state.bodies[j].heading) < -0.3;
        const bool together = a.company >= 0 && a.company == b.company;
        const double share = together ? 0.3 : 1.0;
        forces[i] += share * person_force(heading, offset, gap, oncoming);
        forces[j] += share * person_force(state.bodies[j].heading, -offset, gap, oncoming);
    }
}

/// The forces are soft; this step separates bodies that were pushed into each other.
void separate(CrowdState& state) {
    for (const auto& [i, j] : state.pairs) {
        const Vector2d offset = state.bodies[i].position - state.bodies[j].position;
        const double d = std::sqrt(offset.squaredNorm());
        const double overlap = state.plan.walkers[i].radius + state.plan.walkers[j].radius - d;
        if (overlap <= 0.0) continue;
        const Vector2d push = 0.5 * std::min(overlap, 0.04) * unit_or(offset, Vector2d::UnitX());
        state.bodies[i].position += push;
        state.bodies[j].position -= push;
    }
    for (std::size_t i = 0; i < state.bodies.size(); ++i) {
        Body& body = state.bodies[i];
        const double radius = state.plan.walkers[i].radius;
        for (const Mover& mover : state.movers) {
            const Vector2d offset = body.position - mover.centre;
            const double overlap = radius + mover.radius - std::sqrt(offset.squaredNorm());
            if (overlap > 0.0) body.position += overlap * unit_or(offset, Vector2d::UnitX());
        }
        const auto wall = state.plan.field.at(body.position);
        if (wall.distance < radius) {
            body.position += (radius - wall.distance) * unit_or(wall.away, Vector2d::Zero());
        }
    }
}

/// Turns the body, and moves the legs according to the real motion.
void update_gait(const Walker& walker, Body& body, const Vector2d& moved) {
    const double speed = std::sqrt(moved.squaredNorm()) / crowd_step;
    body.speed = speed;
    Vector2d look = speed > 0.2 ? unit_or(moved, body.heading) : body.heading;
    if (body.standing) {
        const auto last = (body.next + walker.route.size() - 1) % walker.route.size();
        const Vector2d& face = walker.route[last].face;
        if (face.squaredNorm() > 0.0 && speed < 0.5) look = unit_or(face - body.position, look);
    }
    const double turn = 0.12;  // share of the turn per step
    body.heading = unit_or((1.0 - turn) * body.heading + turn * look,
                           Vector2d(-body.heading.y(), body.heading.x()));
    const double swing = speed < 0.12 ? 0.0 : std::clamp(0.32 * speed, 0.12, 0.5);
    body.swing += 0.15 * (swing - body.swing);
    const double stride =
        4.0 * leg_length * walker.height * portable_sincos(std::max(0.12, body.swing)).sin;
    if (speed > 0.12) body.phase += 2.0 * std::numbers::pi * speed * crowd_step / stride;
}

void advance(CrowdState& state) {
    std::vector<Vector2d> positions;
    for (const Body& body : state.bodies) positions.push_back(body.position);
    state.pairs = pairs_within(positions, neighbour_range);
    state.movers = state.plan.movers(state.time);
    std::vector<Vector2d> forces(state.bodies.size(), Vector2d::Zero());
    add_pair_forces(state, forces);
    std::vector<Vector2d> before;
    for (std::size_t i = 0; i < state.bodies.size(); ++i) {
        const Walker& walker = state.plan.walkers[i];
        Body& body = state.bodies[i];
        before.push_back(body.position);
        steer(state, walker, body);
        Vector2d force = forces[i] + (desired_velocity(walker, body) - body.velocity) / relaxation;
        const auto wall = state.plan.field.at(body.position);
        force +=
            wall_strength * portable_exp((walker.radius - wall.distance) / wall_range) * wall.away;
        for (const Mover& mover : state.movers)
            force += mover_force(body.position, walker.radius, mover);
        const double size = std::sqrt(force.squaredNorm());
        if (size > strongest_force) force *= strongest_force / size;
        body.velocity += crowd_step * force;
        const double speed = std::sqrt(body.velocity.squaredNorm());
        const double limit = std::min(fastest, 1.4 * walker.speed);
        if (speed > limit) body.velocity *= limit / speed;
        body.position += crowd_step * body.velocity;
    }
    separate(state);
    for (std::size_t i = 0; i < state.bodies.size(); ++i) {
        const Vector2d moved = state.bodies[i].position - before[i];
        update_gait(state.plan.walkers[i], state.bodies[i], moved);
    }
    state.time += crowd_step;
}

}  // namespace

Crowd simulate_crowd(const CrowdPlan& plan, double duration) {
    CrowdState state{.plan = plan, .bodies = {}, .pairs = {}, .movers = {}};
    for (const Walker& walker : plan.walkers) {
        const Vector2d to = walker.route[walker.next].at - walker.start;
        Body body;
        body.position = body.leg_start = walker.start;
        body.heading = unit_or(to, Vector2d::UnitX());
        body.next = walker.next;
        state.bodies.push_back(body);
    }
    const auto settle = static_cast<int>(settle_time / crowd_step);
    const auto steps = static_cast<int>(duration / crowd_step) + 2;
    state.time = -settle_time;
    Crowd crowd{.walkers = plan.walkers.size(), .strides = {}};
    for (int step = -settle; step < steps; ++step) {
        state.time = step * crowd_step;
        if (step >= 0) {
            for (const Body& body : state.bodies) {
                crowd.strides.push_back({body.position.cast<float>(), body.heading.cast<float>(),
                                         static_cast<float>(body.phase),
                                         static_cast<float>(body.swing),
                                         static_cast<float>(body.speed)});
            }
        }
        advance(state);
    }
    return crowd;
}

Stride stride_at(const Crowd& crowd, std::size_t walker, double t) {
    const std::size_t last = crowd.strides.size() / crowd.walkers - 2;
    const double steps = std::max(0.0, t / crowd_step);
    const std::size_t k = std::min(static_cast<std::size_t>(steps), last);
    const auto u = static_cast<float>(std::min(1.0, steps - static_cast<double>(k)));
    const Stride& a = crowd.strides[k * crowd.walkers + walker];
    const Stride& b = crowd.strides[(k + 1) * crowd.walkers + walker];
    Stride out;
    out.position = (1.0F - u) * a.position + u * b.position;
    out.heading = ((1.0F - u) * a.heading + u * b.heading).normalized();
    out.phase = (1.0F - u) * a.phase + u * b.phase;
    out.swing = (1.0F - u) * a.swing + u * b.swing;
    out.speed = (1.0F - u) * a.speed + u * b.speed;
    return out;
}

}  // namespace dynamic_filter::sim
