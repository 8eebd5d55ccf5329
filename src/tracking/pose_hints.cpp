// SPDX-License-Identifier: MIT
#include "tracking/pose_hints.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/numbers.hpp"

namespace dynamic_filter {
namespace {

constexpr double kHintSpacing = 10.0;  // [m] of the way between hints
// [m] over which the two sources are compared.
constexpr std::array<double, 7> kLags = {1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0};
// Error of the odometry over a distance: share of the distance, and [rad] per metre.
constexpr double kOdometryShift = 0.003, kOdometryTurn = 5e-5;
constexpr double kGivenShift = 0.02, kGivenTurn = 0.002;  // [m], [rad] best accuracy of given poses
constexpr double kNormal = 1.4826;  // standard deviation of a normal distribution, in medians

/// A scan whose pose both sources know.
struct Both {
    std::size_t scan = 0;
    Pose given, shown;
    double way = 0.0;  // [m] until here
};

std::vector<Both> known_to_both(const std::vector<std::optional<Pose>>& given,
                                const std::vector<std::optional<Pose>>& shown) {
    std::vector<Both> both;
    std::optional<Eigen::Vector3d> last;
    double way = 0.0;
    for (std::size_t i = 0; i < given.size(); ++i) {
        if (!shown[i]) continue;
        way += last ? (shown[i]->translation() - *last).norm() : 0.0;
        last = shown[i]->translation();
        if (given[i]) both.push_back({i, *given[i], *shown[i], way});
    }
    return both;
}

/// Displacement by which the given motion from a to b differs from the one that the scans show.
Twist disagreement(const Both& a, const Both& b) {
    return log((a.shown.inverse() * b.shown).inverse() * a.given.inverse() * b.given);
}

/// Typical error of the given poses along each axis of the sensor and about it.
Twist typical_error(const std::vector<Both>& both) {
    Twist error;
    error << Eigen::Vector3d::Constant(kGivenShift), Eigen::Vector3d::Constant(kGivenTurn);
    for (const double lag : kLags) {
        std::array<std::vector<double>, 6> sizes;
        std::size_t j = 0;
        for (std::size_t i = 0; i < both.size(); ++i) {
            while (j < both.size() && both[j].way - both[i].way < lag) ++j;
            if (j == both.size()) break;
            if (both[j].way - both[i].way > 2.0 * lag) continue;
            const Twist off = disagreement(both[i], both[j]);
            for (Eigen::Index k = 0; k < 6; ++k)
                sizes[static_cast<std::size_t>(k)].push_back(std::abs(off[k]));
        }
        if (sizes.front().empty()) continue;
        for (Eigen::Index k = 0; k < 6; ++k) {
            const double of_both = kNormal * median(std::move(sizes[static_cast<std::size_t>(k)]));
            const double of_odometry = lag * (k < 3 ? kOdometryShift : kOdometryTurn);
            error[k] = std::max(error[k], of_both / std::sqrt(2.0) - of_odometry);
        }
    }
    return error;
}

/// Where the given poses around a scan put it: the median, which outliers do not move.
Pose middle_of(const std::vector<Both>& both, std::size_t at) {
    std::array<std::vector<double>, 6> offs;
    const auto look_at = [&](std::size_t i) {
        const Both& other = both[i];
        const Pose T_world_here = other.given * other.shown.inverse() * both[at].shown;
        const Twist off = log(both[at].given.inverse() * T_world_here);
        for (Eigen::Index k = 0; k < 6; ++k) offs[static_cast<std::size_t>(k)].push_back(off[k]);
    };
    const auto is_near = [&](std::size_t i) {
        return std::abs(both[i].way - both[at].way) <= 0.5 * kHintSpacing;
    };
    for (std::size_t i = at; i < both.size() && is_near(i); ++i) look_at(i);
    for (std::size_t i = at; i-- > 0 && is_near(i);) look_at(i);
    Twist middle;
    for (Eigen::Index k = 0; k < 6; ++k)
        middle[k] = median(std::move(offs[static_cast<std::size_t>(k)]));
    return both[at].given * exp(middle);
}

}  // namespace

std::vector<PoseHint> hints_of(const std::vector<std::optional<Pose>>& T_world_given,
                               const std::vector<std::optional<Pose>>& T_odometry_sensor) {
    const std::vector<Both> both = known_to_both(T_world_given, T_odometry_sensor);
    if (both.empty()) return {};
    const Twist error = typical_error(both);
    const Information information = error.cwiseAbs2().cwiseInverse().asDiagonal();
    std::vector<PoseHint> hints;
    double next = 0.0;
    for (std::size_t i = 0; i < both.size(); ++i) {
        if (both[i].way < next && i + 1 < both.size()) continue;
        next = both[i].way + kHintSpacing;
        hints.push_back({both[i].scan, middle_of(both, i), information});
    }
    return hints;
}

}  // namespace dynamic_filter
