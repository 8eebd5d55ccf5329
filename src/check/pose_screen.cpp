// SPDX-License-Identifier: MIT
#include "check/pose_screen.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "check/pieces.hpp"
#include "check/scan_input.hpp"
#include "dynamic_filter/motion.hpp"
#include "dynamic_filter/parallel.hpp"
#include "tracking/registration.hpp"
#include "tracking/scan_sample.hpp"
#include "tracking/upright.hpp"

namespace dynamic_filter::io {
namespace {

constexpr std::size_t kPlacesToScreen = 5;
constexpr std::array<std::size_t, 4> kScreened = {0, 7, 14, 20};  // of the scans in a row
constexpr double kMapped = 0.3;   // least share of the points where there are surfaces
constexpr double kMostLie = 0.7;  // least share of these that lie on the surfaces
constexpr double kReach = 0.5;    // [m]
// Registration may move a scan by this much [m], [rad]; or, among people, whose surfaces move as
// well, by more, if the points hardly lie better afterwards.
constexpr double kStays = 0.03, kStaysAtMost = 0.1;
constexpr double kTurns = 0.002, kTurnsAtMost = 0.02;
constexpr double kAsSharp = 1.015;  // blur of the points where they are, by that afterwards

/// A scan, and how the sensor moved during it.
struct Screened {
    Scan scan;
    Twist velocity = Twist::Zero();
};

std::vector<Screened> read_place(const Recording& recording, std::size_t first) {
    std::vector<Screened> scans;
    for (const std::size_t apart : kScreened) {
        if (first + apart >= recording.size()) break;
        auto scan = read_scan(recording, first + apart);
        if (scan) scans.push_back({*std::move(scan), velocity_at(recording, first + apart)});
    }
    return scans;
}

/// True if the points lie on the map as well as at the pose that registration leads to.
bool stays(const SurfaceMap& map, const Points& points, const Pose& given, const Pose& found) {
    const Twist off = log(given.inverse() * found);
    const double shift = off.head<3>().norm(), turn = off.tail<3>().norm();
    if (shift < kStays && turn < kTurns) return true;
    if (shift > kStaysAtMost || turn > kTurnsAtMost) return false;
    return blur_on_map(map, points, given) < kAsSharp * blur_on_map(map, points, found);
}

/// True if the scans lie on each other where they are.
bool scans_stay(const std::vector<Screened>& scans, const OdometryConfig& config) {
    SurfaceMap map(config.voxel);
    const Pose T_map_world = scans.front().scan.T_world_sensor.inverse();
    for (const auto& [scan, velocity] : scans) {
        const ScanSample sample = sample_for_map(scan.points, scan.times, config);
        const Pose given = T_map_world * scan.T_world_sensor;
        if (!map.empty()) {
            const Points few = sample_for_registration(sample, config).at_stamp(velocity);
            const Registration found = register_points(map, few, given, {}, kReach);
            const bool lie = found.mapped > kMapped && found.inliers > kMostLie * found.mapped;
            if (!lie || !stays(map, few, given, found.T_map_sensor)) return false;
        }
        map.insert(moved(sample.at_stamp(velocity), given));
    }
    return true;
}

/// True if upright structures overlay best where they are, not beside. Where a sensor drives along
/// walls, scans also lie on each other if the poses say that it rests.
bool overlay_is_best(const std::vector<Screened>& scans) {
    const Scan &a = scans[scans.size() - 2].scan, &b = scans.back().scan;
    const Points of_a = upright_points(a.points), of_b = upright_points(b.points);
    const Pose T_a_b = a.T_world_sensor.inverse() * b.T_world_sensor;
    const double here = upright_overlay(of_a, of_b, T_a_b);
    for (const double far : {0.5, 1.0, 2.0, 4.0, 8.0, 16.0}) {
        for (const auto& [x, y] : {std::pair{1.0, 0.0}, {-1.0, 0.0}, {0.0, 1.0}, {0.0, -1.0}}) {
            Pose beside = T_a_b;
            beside.translation() += far * Eigen::Vector3d(x, y, 0.0);
            if (upright_overlay(of_a, of_b, beside) >= here) return false;
        }
    }
    return true;
}

}  // namespace

bool poses_are_exact(const Recording& recording, const OdometryConfig& config) {
    const bool only_scans_hold_them = recording.info().T_world_sensor.size() != recording.size();
    if (only_scans_hold_them) return false;
    const std::size_t in_a_row = kScreened.back() + 1;
    const std::vector<std::size_t> places =
        first_scans(recording.size(), kPlacesToScreen, in_a_row);
    std::vector<std::uint8_t> exact(places.size());
    parallel_for(places.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            const std::vector<Screened> scans = read_place(recording, places[k]);
            if (scans.size() < kScreened.size()) continue;
            exact[k] = scans_stay(scans, config) && overlay_is_best(scans) ? 1 : 0;
        }
    });
    return std::find(exact.begin(), exact.end(), 0) == exact.end();
}

}  // namespace dynamic_filter::io
