// SPDX-License-Identifier: MIT
#include "tracking/beginning.hpp"

#include <algorithm>
#include <array>

#include "dynamic_filter/tracking.hpp"
#include "tracking/coarse_search.hpp"
#include "tracking/scan_sample.hpp"
#include "tracking/upright.hpp"

namespace dynamic_filter {
namespace {

constexpr double kApart = 0.3;           // [s] between the scans that are compared from above
constexpr std::size_t kVelocities = 3;   // velocities that are tried beside the first one
constexpr double kSameTrack = 0.7;       // [m] displacements nearer to each other lead to one track
constexpr double kQuickestTurn = 1.5;    // [rad/s]
constexpr double kClearlyBetter = 1.05;  // factor of the overlay that counts as clearly better
constexpr int kFewPoints = 1500;         // of a scan; the odometry itself uses more
constexpr std::array<std::size_t, 3> kSeparations = {1, 3, 5};  // of the scans that are overlaid

using Track = std::vector<Pose>;

Track track_from(std::span<const Scan> scans, const OdometryConfig& config,
                 const std::optional<Twist>& velocity) {
    Odometry odometry(config);
    Track track;
    for (const Scan& scan : scans) {
        std::optional<Pose> guess;
        if (velocity && track.size() == 1) guess = exp(*velocity * (scan.stamp - scans[0].stamp));
        track.push_back(odometry.track(scan.points, scan.times, scan.stamp, guess).T_world_sensor);
        odometry.learn({});
    }
    return track;
}

/// By how much the overlay of the upright structures is better than with the other track, as a
/// factor, for pairs of scans whose displacements differ. 1 if none do.
double overlay_gain(const std::vector<Points>& upright, const Track& track, const Track& than) {
    constexpr double kDiffer = 0.1;  // [m]
    double sum = 0.0, other = 0.0;
    for (const std::size_t apart : kSeparations) {
        for (std::size_t i = apart; i < track.size(); ++i) {
            const Pose moved = track[i - apart].inverse() * track[i];
            const Pose otherwise = than[i - apart].inverse() * than[i];
            if ((moved.translation() - otherwise.translation()).norm() < kDiffer) continue;
            sum += upright_overlay(upright[i - apart], upright[i], moved);
            other += upright_overlay(upright[i - apart], upright[i], otherwise);
        }
    }
    return other > 0.0 ? sum / other : 1.0;
}

/// `first`: scans whose z axis is the vertical.
std::optional<Twist> velocity_of_upright(std::span<const Scan> first, const OdometryConfig& given) {
    if (first.size() < 3) return std::nullopt;
    OdometryConfig config = given;
    config.points = std::min(config.points, kFewPoints);
    std::size_t later = 1;
    while (later + 1 < first.size() && first[later].stamp - first[0].stamp < kApart) ++later;
    const double passed = first[later].stamp - first[0].stamp;
    if (!(passed > 0.0)) return std::nullopt;

    std::vector<Scan> thin;
    for (const Scan& scan : first) thin.push_back(thinned_scan(scan, config));
    const Track usual = track_from(thin, config, std::nullopt);
    const SearchWindow window{std::clamp(config.speed * passed, 2.0, 20.0),
                              std::clamp(kQuickestTurn * passed, 0.1, 0.6)};
    const auto seen_from_above =
        search_displacements(thin[0].points, thin[later].points, window, kVelocities);
    std::vector<Pose> tried = {usual[later]};
    std::vector<Points> upright;
    Track best = usual;
    double needed = kClearlyBetter;
    for (const Pose& displacement : seen_from_above) {
        const bool is_same = std::any_of(tried.begin(), tried.end(), [&](const Pose& other) {
            return (other.translation() - displacement.translation()).norm() < kSameTrack;
        });
        if (is_same) continue;
        if (upright.empty()) {
            for (const Scan& scan : first) upright.push_back(upright_points(scan.points));
        }
        const Track track = track_from(thin, config, log(displacement) / passed);
        tried.push_back(track[later]);
        if (overlay_gain(upright, track, best) <= needed) continue;
        needed = 1.0;
        best = track;
    }
    return log(best[1]) / (first[1].stamp - first[0].stamp);
}

/// The same scans in a frame whose z axis is the vertical.
std::vector<Scan> turned(std::span<const Scan> scans, const Eigen::Matrix3d& rotation) {
    std::vector<Scan> result(scans.begin(), scans.end());
    for (Scan& scan : result) scan.points = moved(scan.points, Pose(rotation));
    return result;
}

}  // namespace

std::optional<Twist> initial_velocity(std::span<const Scan> first, const OdometryConfig& given) {
    if (first.empty()) return std::nullopt;
    const Eigen::Matrix3d upright = upright_rotation(first.front().points);
    if (upright.isIdentity(0.0)) return velocity_of_upright(first, given);
    auto velocity = velocity_of_upright(turned(first, upright), given);
    if (velocity) {
        velocity->head<3>() = upright.transpose() * velocity->head<3>();
        velocity->tail<3>() = upright.transpose() * velocity->tail<3>();
    }
    return velocity;
}

}  // namespace dynamic_filter
