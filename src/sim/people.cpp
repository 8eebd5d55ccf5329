// SPDX-License-Identifier: MIT
#include "sim/people.hpp"

#include <algorithm>
#include <cmath>

namespace dynamic_filter::sim {
namespace {

using Eigen::Vector2d;

/// True if the place is clear of walls and of the walkers already placed, except those of the same
/// company.
bool is_vacant(const std::vector<Walker>& walkers, std::size_t count, const Walker& walker,
               const Vector2d& p, const DistanceField& field) {
    if (field.at(p).distance < walker.radius) return false;
    for (std::size_t i = 0; i < count; ++i) {
        const double room = walkers[i].radius + walker.radius + 0.1;
        if ((walkers[i].start - p).squaredNorm() < room * room) return false;
    }
    return true;
}

void put(Walker& walker, std::size_t leg, double share) {
    const std::size_t n = walker.route.size();
    const Vector2d& from = walker.route[leg % n].at;
    walker.next = (leg + 1) % n;
    walker.start = from + share * (walker.route[walker.next].at - from);
}

}  // namespace

Walker draw_walker(Random& random) {
    Walker walker;
    const bool child = random.chance(0.1);
    walker.height = child ? random.uniform(1.0, 1.35)
                          : 1.5 + 0.225 * (unit(random.bits()) + unit(random.bits()));
    walker.radius = child ? 0.17 : random.uniform(0.2, 0.24);
    walker.speed = child ? random.uniform(0.6, 1.1) : random.uniform(0.8, 1.55);
    return walker;
}

Walker companion(const Walker& leader, double offset, Random& random) {
    Walker walker = draw_walker(random);
    walker.speed = leader.speed;
    walker.company = leader.company;
    const std::size_t n = leader.route.size();
    for (std::size_t i = 0; i < n; ++i) {
        Waypoint waypoint = leader.route[i];
        const Vector2d along = leader.route[(i + 1) % n].at - leader.route[(i + n - 1) % n].at;
        const double length = along.norm();
        // Opposite the first person, or beside for the third one.
        if (waypoint.face.squaredNorm() > 0.0) {
            const Vector2d to = waypoint.face - waypoint.at;
            waypoint.at = waypoint.face +
                          Vector2d(-to.y(), to.x()) * (offset > 0.0 ? 1.0 : -1.0) * 0.9 + 0.4 * to;
        } else if (length > 2.0) {
            waypoint.at += offset / length * Vector2d(-along.y(), along.x());
        }
        walker.route.push_back(waypoint);
    }
    return walker;
}

void scatter(std::vector<Walker>& walkers, const DistanceField& field, Random& random) {
    for (std::size_t i = 0; i < walkers.size(); ++i) {
        Walker& walker = walkers[i];
        if (i > 0 && walker.company >= 0 && walker.company == walkers[i - 1].company) {
            // Same segment of the route, and same share of it.
            const Walker& leader = walkers[i - 1];
            const std::size_t n = walker.route.size();
            const std::size_t leg = (leader.next + n - 1) % n;
            const Vector2d& a = leader.route[leg].at;
            const double length = (leader.route[leader.next].at - a).norm();
            put(walker, leg, length > 0.0 ? (leader.start - a).norm() / length : 0.0);
            continue;
        }
        double whole = 0.0;
        for (std::size_t k = 0; k < walker.route.size(); ++k) {
            whole += (walker.route[(k + 1) % walker.route.size()].at - walker.route[k].at).norm();
        }
        for (int attempt = 0; attempt < 60; ++attempt) {
            double along = random.uniform(0.0, whole);
            std::size_t leg = 0;
            for (;; ++leg) {
                const auto n = walker.route.size();
                const double length =
                    (walker.route[(leg + 1) % n].at - walker.route[leg % n].at).norm();
                if (along < length || leg > n) {
                    put(walker, leg, length > 0.0 ? std::min(1.0, along / length) : 0.0);
                    break;
                }
                along -= length;
            }
            if (is_vacant(walkers, i, walker, walker.start, field)) break;
        }
    }
}

}  // namespace dynamic_filter::sim
