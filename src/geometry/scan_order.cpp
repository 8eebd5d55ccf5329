// SPDX-License-Identifier: MIT
#include "geometry/scan_order.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/angle.hpp"

namespace dynamic_filter {
namespace {

constexpr double kFullTurn = 2.0 * std::numbers::pi;
constexpr std::size_t kFewestPoints = 1000;

/// [rad] from -pi to pi
double nearest_turn(double angle) { return std::remainder(angle, kFullTurn); }

double azimuth_of(const Point& p) { return angle_of(p.y(), p.x()); }

std::vector<std::size_t> measured_of(const Points& points) {
    std::vector<std::size_t> measured;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (is_measured(points[i])) measured.push_back(i);
    }
    return measured;
}

/// Mean azimuths [rad] of parts of the scan, one after the other, without jumps by whole turns.
/// The lasers that fire together may point apart by some degrees; their mean does not jump. Empty
/// if the points of a part do not lie in one direction.
std::vector<double> headings(const Points& points, const std::vector<std::size_t>& measured,
                             std::size_t parts) {
    constexpr double kTogether = 0.9;  // length of the mean of unit vectors
    std::vector<double> turned;
    for (std::size_t k = 0; k < parts; ++k) {
        const std::size_t begin = k * measured.size() / parts;
        const std::size_t end = (k + 1) * measured.size() / parts;
        Eigen::Vector2d sum = Eigen::Vector2d::Zero();
        for (std::size_t i = begin; i < end; ++i) {
            sum += points[measured[i]].head<2>().cast<double>().normalized();
        }
        if (sum.norm() < kTogether * static_cast<double>(end - begin)) return {};
        const double heading = std::atan2(sum.y(), sum.x());
        turned.push_back(turned.empty() ? heading
                                        : turned.back() + nearest_turn(heading - turned.back()));
    }
    return turned;
}

/// True if the values go one way nearly all the time.
bool advances(const std::vector<double>& turned) {
    constexpr double kSteady = 0.9;
    double there_and_back = 0.0;
    for (std::size_t i = 1; i < turned.size(); ++i) {
        there_and_back += std::abs(turned[i] - turned[i - 1]);
    }
    return std::abs(turned.back() - turned.front()) > kSteady * there_and_back;
}

/// Of points in the order in which they were measured.
std::vector<float> shares_as_fired(const Points& points, const std::vector<std::size_t>& measured) {
    constexpr std::size_t kParts = 72;
    constexpr double kLeast = 0.7 * kFullTurn, kMost = 2.5 * kFullTurn;
    const std::vector<double> turned = headings(points, measured, kParts);
    if (turned.empty() || !advances(turned)) return {};
    // The headings are those of the middles of parts.
    const double whole = std::abs(turned.back() - turned.front()) * kParts / (kParts - 1);
    if (whole < kLeast || whole > kMost) return {};
    const double first = turned.front() - (turned[1] - turned[0]) / 2.0;
    std::vector<float> shares(points.size(), 0.5F);
    for (std::size_t i = 0; i < measured.size(); ++i) {
        const double part =
            (static_cast<double>(i) + 0.5) * kParts / static_cast<double>(measured.size()) - 0.5;
        const auto k = static_cast<std::size_t>(std::clamp(part, 0.0, kParts - 2.0));
        const double here =
            turned[k] + (part - static_cast<double>(k)) * (turned[k + 1] - turned[k]);
        const double share = std::abs(here - first) / std::max(whole, kFullTurn);
        shares[measured[i]] = static_cast<float>(std::clamp(share, 0.0, 1.0));
    }
    return shares;
}

/// Where, between two indices, the elevation changes most: there another laser's row begins.
std::size_t row_break(const std::vector<double>& elevations, std::size_t begin, std::size_t end) {
    double right = 0.0, left = 0.0, best = -1.0;
    for (std::size_t i = begin; i < end; ++i) right += elevations[i];
    std::size_t at = begin;
    for (std::size_t i = begin; i + 1 < end; ++i) {
        left += elevations[i];
        right -= elevations[i];
        const auto n = static_cast<double>(i + 1 - begin), m = static_cast<double>(end - i - 1);
        const double apart = left / n - right / m;
        const double between = apart * apart * n * m / (n + m);
        if (between > best) {
            best = between;
            at = i + 1;
        }
    }
    return at;
}

/// Of points in rows, each of which is a turn of one laser.
std::vector<float> shares_in_rows(const Points& points, const std::vector<std::size_t>& measured) {
    constexpr double kFewestRows = 4.0, kMostRows = 300.0;
    constexpr double kNear = 0.07;    // [turns] lasers of one firing point apart by less
    constexpr double kStep = 0.0015;  // [rad] from laser to laser
    std::vector<double> turned, elevations;
    for (const std::size_t i : measured) {
        const Point& p = points[i];
        const double azimuth = azimuth_of(p);
        turned.push_back(turned.empty() ? azimuth
                                        : turned.back() + nearest_turn(azimuth - turned.back()));
        elevations.push_back(angle_of(p.z(), p.head<2>().norm()));
    }
    const double sense = turned.back() > turned.front() ? 1.0 : -1.0;
    const double rows = std::abs(turned.back() - turned.front()) / kFullTurn;
    if (rows < kFewestRows || rows > kMostRows || !advances(turned)) return {};
    // Beams to the ground return all round, so their row shows where rows begin and end.
    const double seam = elevations.back() < elevations.front() ? turned.back() : turned.front();
    const auto phase = [&](std::size_t i) { return sense * (turned[i] - seam) / kFullTurn; };
    double row = std::floor(phase(0) + kNear);
    std::size_t next = 0;  // index at which the next row begins, or the present one
    double begun = row;    // phase at which the present row begins
    std::vector<float> shares(points.size(), 0.5F);
    for (std::size_t i = 0; i < measured.size(); ++i) {
        if (next <= i && phase(i) > row + 1.0 - kNear) {
            std::size_t end = i;
            while (end < measured.size() && phase(end) < row + 1.0 + kNear) ++end;
            // The last row ends where the scan does.
            next = end < measured.size() ? row_break(elevations, i, end) : end;
            row += 1.0;
        }
        if (i == next) {
            // A row whose first beams did not return begins where the others do.
            const bool shows_begin = i > 0 && std::abs(phase(i) - row) < kNear &&
                                     std::abs(elevations[i] - elevations[i - 1]) > kStep &&
                                     std::abs(phase(i) - phase(i - 1)) < kNear;
            begun = shows_begin ? phase(i) : row;
        }
        const double share = phase(i) - begun;
        shares[measured[i]] = static_cast<float>(share - std::floor(share));
    }
    return shares;
}

}  // namespace

std::vector<float> order_shares(const Points& points) {
    const std::vector<std::size_t> measured = measured_of(points);
    if (measured.size() < kFewestPoints) return {};
    std::vector<float> shares = shares_as_fired(points, measured);
    return shares.empty() ? shares_in_rows(points, measured) : shares;
}

}  // namespace dynamic_filter
