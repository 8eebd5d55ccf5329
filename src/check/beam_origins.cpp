// SPDX-License-Identifier: MIT
#include "check/beam_origins.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <bitset>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "base/degree.hpp"
#include "base/numbers.hpp"

namespace dynamic_filter::io {
namespace {

using Vector5d = Eigen::Matrix<double, 5, 1>;
using Matrix5d = Eigen::Matrix<double, 5, 5>;

constexpr std::size_t kChainLength = 10;   // points in a chain
constexpr std::size_t kFewestChains = 60;  // chains that determine an apex
constexpr double kMostAway = 4.0;          // [m] from the origin of a vehicle's frame to its sensor
constexpr double kLeastAway = 0.25;        // [m] real sensors have no more exact centre than this
constexpr double kClearly = 2.5;           // ratio of spreads; blocks of lasers reach 1.9
constexpr double kSharp = 0.02 * kDegree;  // [rad] spread within a ring; a rosette has more
constexpr double kFloor = 1e-4 * kDegree;  // [rad] by the rounding of float coordinates
constexpr double kFinest = 1e-5;           // [m] the same
constexpr double kSteepest = 15.0 * kDegree;  // [rad] of a sensor's mounting
constexpr double kCertain = 0.05;             // [m] standard deviation in each direction

/// Points that follow each other on one beam.
struct Chain {
    std::array<Eigen::Vector3d, kChainLength> points;
    bool in_second_half = false;  ///< of the scan
};
using Chains = std::vector<Chain>;

struct Cone {
    Eigen::Vector3d apex = Eigen::Vector3d::Zero();
    Eigen::Vector2d tilt = Eigen::Vector2d::Zero();  ///< x and y of the axis, whose z is 1
};

/// From where the neighbours on a beam are looked for.
struct View {
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
    float least;  ///< [m] points nearer to the place are left out
    /// How much a difference of range counts, relative to one of direction. Seen from the apex, it
    /// is noise. Seen from near the ground, the rings on it lie behind each other.
    float depth;
};

/// A stretch of a scan, in the order of the file, as seen from a place.
struct Stretch {
    std::vector<std::size_t> index;  ///< in the scan
    std::vector<float> x, y, z, depth, range;

    void add(std::size_t i, const Point& from_there, float depth_factor) {
        const float r = from_there.norm();
        index.push_back(i);
        range.push_back(r);
        x.push_back(from_there.x() / r);
        y.push_back(from_there.y() / r);
        z.push_back(from_there.z() / r);
        depth.push_back(depth_factor * std::log(r));
    }
};

/// Stretches from all over the scan.
std::vector<Stretch> stretches_of(const Points& points, const View& view) {
    constexpr std::size_t kStretches = 6, kPoints = 4096;
    const Point from = view.place.cast<float>();
    std::vector<std::size_t> usable;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (is_measured(points[i]) && (points[i] - from).norm() > view.least) usable.push_back(i);
    }
    std::vector<Stretch> stretches(kStretches);
    const std::size_t size = std::min(kPoints, usable.size() / kStretches);
    for (std::size_t k = 0; k < kStretches; ++k) {
        const std::size_t first = k * (usable.size() - size) / (kStretches - 1);
        for (std::size_t i = first; i < first + size; ++i) {
            stretches[k].add(usable[i], points[usable[i]] - from, view.depth);
        }
    }
    return stretches;
}

/// For each point, how far ahead the next point of its beam is: the one nearest to it.
/// In files that hold one beam after the other, it is the next one. Otherwise that one belongs to
/// the next beam.
struct Ahead {
    std::vector<float> distance;  ///< squared, of direction and depth
    std::vector<std::int32_t> lag;
};

Ahead look_ahead(const Stretch& stretch) {
    constexpr std::size_t kFarAhead = 160;  // more than the beams of any sensor
    constexpr float kNone = std::numeric_limits<float>::max();
    const std::size_t n = stretch.x.size();
    const auto distances = [&](std::size_t lag, std::vector<float>& to) {
        const float *x = stretch.x.data(), *y = stretch.y.data(), *z = stretch.z.data();
        const float* depth = stretch.depth.data();
        for (std::size_t i = 0; i + lag < n; ++i) {
            const float dx = x[i + lag] - x[i], dy = y[i + lag] - y[i], dz = z[i + lag] - z[i];
            const float step = depth[i + lag] - depth[i];
            to[i] = dx * dx + dy * dy + dz * dz + step * step;
        }
    };
    Ahead next{std::vector<float>(n, kNone), std::vector<std::int32_t>(n, 1)};
    Ahead far = next;
    distances(1, next.distance);
    std::vector<float> at_lag(n, kNone);
    for (std::size_t lag = 2; lag < std::min(kFarAhead, n); ++lag) {
        distances(lag, at_lag);
        float* best = far.distance.data();
        std::int32_t* which = far.lag.data();
        for (std::size_t i = 0; i + lag < n; ++i) {
            const bool nearer = at_lag[i] < best[i];
            best[i] = nearer ? at_lag[i] : best[i];
            which[i] = nearer ? static_cast<std::int32_t>(lag) : which[i];
        }
    }
    // On one beam after the other, the point after the next is twice as far: 4 times, squared.
    return 2.0F * median(next.distance) < median(far.distance) ? next : far;
}

void add_chains(const Points& points, const Stretch& stretch, Chains& chains) {
    constexpr float kBeside = 0.02F * 0.02F;  // [rad^2] neighbours on a beam are nearer
    constexpr float kSame = 1e-6F * 1e-6F;    // [rad^2] returns of one beam are nearer
    constexpr float kStep = 0.05F;            // of the range; more is another surface
    const Ahead ahead = look_ahead(stretch);
    const std::size_t n = stretch.x.size();
    const auto next_of = [&](std::size_t i) -> std::optional<std::size_t> {
        const std::size_t next = i + static_cast<std::size_t>(ahead.lag[i]);
        const bool beside = ahead.distance[i] < kBeside && ahead.distance[i] > kSame;
        if (next >= n || !beside) return std::nullopt;
        const float step = std::abs(stretch.range[next] - stretch.range[i]);
        return step < kStep * stretch.range[i] ? std::optional(next) : std::nullopt;
    };
    std::vector<bool> used(n);
    for (std::size_t first = 0; first < n; ++first) {
        Chain chain;
        std::size_t length = 0;
        std::optional<std::size_t> at = first;
        while (at && !used[*at] && length < kChainLength) {
            used[*at] = true;
            chain.points[length++] = points[stretch.index[*at]].cast<double>();
            at = next_of(*at);
        }
        if (length < kChainLength) continue;
        chain.in_second_half = stretch.index[first] >= points.size() / 2;
        chains.push_back(chain);
    }
}

Chains chains_of(const Points& points, const View& view) {
    Chains chains;
    for (const Stretch& stretch : stretches_of(points, view)) add_chains(points, stretch, chains);
    return chains;
}

/// Elevations of a chain's points minus their mean, times the mean range: how far [m] they are from
/// one cone. Angles alone would be least as seen from infinity.
struct Elevations {
    std::array<double, kChainLength> centred{};   ///< [m]
    std::array<Vector5d, kChainLength> slopes{};  ///< by apex and tilt
    double spread = 0.0;                          ///< [m] mean deviation
    double range = 0.0;                           ///< [m] mean
};

Elevations elevations(const Chain& chain, const Cone& cone) {
    const Eigen::Vector3d axis = Eigen::Vector3d(cone.tilt.x(), cone.tilt.y(), 1.0).normalized();
    Elevations e;
    double mean = 0.0;
    Vector5d mean_slope = Vector5d::Zero();
    Eigen::Vector3d mean_direction = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < kChainLength; ++i) {
        const Eigen::Vector3d ray = chain.points[i] - cone.apex;
        const double range = std::max(ray.norm(), 0.1);
        const double sine = std::clamp(axis.dot(ray) / range, -1.0, 1.0);
        const double flat = range * std::sqrt(std::max(1.0 - sine * sine, 0.01));
        e.centred[i] = std::asin(sine);
        e.slopes[i] << (sine * ray / range - axis) / flat, ray.x() / flat, ray.y() / flat;
        e.range += range / kChainLength;
        mean_direction += ray / range / kChainLength;
        mean += e.centred[i] / kChainLength;
        mean_slope += e.slopes[i] / kChainLength;
    }
    for (std::size_t i = 0; i < kChainLength; ++i) {
        const double angle = e.centred[i] - mean;
        e.centred[i] = e.range * angle;
        e.slopes[i] = e.range * (e.slopes[i] - mean_slope);
        e.slopes[i].head<3>() -= angle * mean_direction;
        e.spread += std::abs(e.centred[i]) / kChainLength;
    }
    return e;
}

/// The spread [rad] of the median chain.
double spread_of(const Chains& chains, const Cone& cone) {
    std::vector<double> spreads;
    for (const Chain& chain : chains) {
        const Elevations e = elevations(chain, cone);
        spreads.push_back(e.spread / e.range);
    }
    return std::max(median(std::move(spreads)), kFloor);
}

/// The cone at which the elevations within chains differ least, by least squares that trust chains
/// less the more they spread. Empty if there is none, or if it is not certain.
std::optional<Cone> fit(const Chains& chains, Cone cone) {
    constexpr int kSteps = 25;
    constexpr double kLongest = 0.7, kDone = 1e-3;  // [m]
    if (chains.size() < kFewestChains) return std::nullopt;
    for (int step = 0; step < kSteps; ++step) {
        std::vector<double> spreads;
        for (const Chain& chain : chains) spreads.push_back(elevations(chain, cone).spread);
        const double usual = std::max(median(std::move(spreads)), kFinest);
        Matrix5d information = Matrix5d::Zero();
        Vector5d gradient = Vector5d::Zero();
        for (const Chain& chain : chains) {
            const Elevations e = elevations(chain, cone);
            const double times = e.spread / (2.0 * usual);
            const double weight = std::pow(1.0 + times * times, -2.0);
            for (std::size_t i = 0; i < kChainLength; ++i) {
                information += weight * e.slopes[i] * e.slopes[i].transpose();
                gradient += weight * e.centred[i] * e.slopes[i];
            }
        }
        information.diagonal() *= 1.0 + 1e-6;
        const Eigen::LDLT<Matrix5d> solver(information);
        Vector5d move = -solver.solve(gradient);
        const double length = move.head<3>().norm();
        if (!move.allFinite()) return std::nullopt;
        if (length > kLongest) move *= kLongest / length;
        cone.apex += move.head<3>();
        cone.tilt += move.tail<2>();
        if (cone.apex.norm() > 2.0 * kMostAway) return std::nullopt;
        if (length > kDone) continue;
        const Matrix5d variance = usual * usual * solver.solve(Matrix5d::Identity());
        const bool certain = variance.diagonal().head<3>().maxCoeff() < kCertain * kCertain;
        const bool possible =
            cone.apex.norm() < kMostAway && cone.tilt.norm() < std::tan(kSteepest);
        const bool sharp = spread_of(chains, cone) < kSharp;
        return certain && possible && sharp ? std::optional(cone) : std::nullopt;
    }
    return std::nullopt;
}

/// The azimuths [in sectors] of the chains' points, as seen from the apex.
std::bitset<24> sectors_of(const Chains& chains, const Cone& cone) {
    std::bitset<24> sectors;
    for (const Chain& chain : chains) {
        const Eigen::Vector3d ray = chain.points.front() - cone.apex;
        const double turns = std::atan2(ray.y(), ray.x()) / (2.0 * std::numbers::pi) + 0.5;
        sectors.set(static_cast<std::size_t>(turns * 24.0) % 24);
    }
    return sectors;
}

/// The apices of both halves of a scan, if each half is clearly sharper at its own. Two sensors see
/// the same surroundings. The halves of one sweep are also seen from two places, if the sensor's
/// motion was undone, but in different directions.
std::vector<Eigen::Vector3d> of_two_sensors(const Chains& chains) {
    constexpr double kApart = 2.0 * kLeastAway;
    std::array<Chains, 2> halves;
    for (const Chain& chain : chains) halves[chain.in_second_half ? 1 : 0].push_back(chain);
    const auto first = fit(halves[0], {}), second = fit(halves[1], {});
    if (!first || !second || (first->apex - second->apex).norm() < kApart) return {};
    const bool differ = spread_of(halves[0], *second) > kClearly * spread_of(halves[0], *first) &&
                        spread_of(halves[1], *first) > kClearly * spread_of(halves[1], *second);
    const auto one = sectors_of(halves[0], *first), other = sectors_of(halves[1], *second);
    if (!differ || 2 * (one & other).count() < (one | other).count()) return {};
    return {first->apex, second->apex};
}

Eigen::Vector3d away_from_origin(const Cone& cone, const Chains& chains) {
    const bool is_away =
        cone.apex.norm() > kLeastAway && spread_of(chains, {}) > kClearly * spread_of(chains, cone);
    return is_away ? cone.apex : Eigen::Vector3d::Zero();
}

}  // namespace

std::vector<Eigen::Vector3d> beam_origins(const Points& points) {
    // [m] Neighbours far away lie in nearly the same directions from wherever one looks, and those
    // nearby do not. A small room has none far away.
    for (const float far : {9.0F, 4.0F}) {
        constexpr float kNear = 3.0F;  // [m] nearer points are the vehicle's own
        const Chains first = chains_of(points, {.least = far, .depth = 0.5F});
        if (auto two = of_two_sensors(first); !two.empty()) return two;
        const auto rough = fit(first, {});
        if (!rough) continue;
        if (away_from_origin(*rough, first).isZero()) return {Eigen::Vector3d::Zero()};
        const Chains all = chains_of(points, {rough->apex, kNear, 0.0F});
        if (const auto fine = fit(all, *rough)) return {away_from_origin(*fine, all)};
    }
    return {};
}

}  // namespace dynamic_filter::io
