// SPDX-License-Identifier: MIT
#include "check/loops.hpp"

#include <algorithm>
#include <optional>

#include "check/meeting_places.hpp"
#include "check/place_offset.hpp"
#include "dynamic_filter/parallel.hpp"

namespace dynamic_filter::io {
namespace {

constexpr double kLoopWay = 50.0;           // [m] a shorter way is no loop
constexpr double kLeastSpacing = 10.0;      // [m] of the way between places
constexpr std::size_t kMostPassages = 100;  // places
// Tilts, which the registration takes from the poses.
constexpr double kFreeTilt = 0.005;  // [rad]

/// Pairs of scans at one place: the earlier one and the later one.
std::vector<MeetingPlace> passages(const Positions& positions) {
    const std::vector<double> way = way_of(positions);
    const double spacing = std::max(kLeastSpacing, way.back() / static_cast<double>(kMostPassages));
    std::vector<MeetingPlace> places;
    double next = kLoopWay;
    for (std::size_t i = 0; i < positions.size(); ++i) {
        if (way[i] < next || !positions[i].allFinite()) continue;
        std::optional<std::size_t> nearest;
        double least = kMeetingDistance;
        for (std::size_t j = 0; j < i && way[j] < way[i] - kLoopWay; ++j) {
            const double distance = (positions[j] - positions[i]).head<2>().norm();
            if (!(distance < least)) continue;
            least = distance;
            nearest = j;
        }
        next = way[i] + (nearest ? spacing : 0.2 * spacing);
        if (nearest) places.push_back({*nearest, i});
    }
    return places;
}

Pose corrected(const Pose& T_world_sensor, const PlaceOffset& offset) {
    const Eigen::AngleAxisd turn(offset.yaw, Eigen::Vector3d::UnitZ());
    return Eigen::Translation3d(offset.shift + offset.at) * turn *
           Eigen::Translation3d(-offset.at) * T_world_sensor;
}

/// What is known about x, y, z and yaw, with the tilts.
Information with_tilt(const FlatInformation& flat) {
    Information of_world = Information::Zero();
    constexpr std::array<Eigen::Index, 4> kKept = {0, 1, 2, 5};
    of_world(kKept, kKept) = flat;
    of_world(3, 3) = of_world(4, 4) = 1.0 / (kFreeTilt * kFreeTilt);
    return of_world;
}

std::optional<Motion> motion_at(const Recording& recording, const Positions& positions,
                                const MeetingPlace& place) {
    const Eigen::Vector3d& here = positions[place.in_b];
    const Points a = cloud_around(recording, scans_around(positions, place.in_a, 1.0, 4), here);
    const Points b = cloud_around(recording, scans_around(positions, place.in_b, 0.5, 1), here);
    const auto offset = register_clouds(a, b, here);
    if (!offset || !offset->fits()) return std::nullopt;
    const auto& poses = recording.info().T_world_sensor;
    const Pose T_world_b = corrected(poses[place.in_b], *offset);
    return Motion{place.in_a, place.in_b, poses[place.in_a].inverse() * T_world_b,
                  in_sensor(with_tilt(offset->information), T_world_b), true};
}

}  // namespace

std::vector<Motion> find_loops(const Recording& recording) {
    const Positions positions = positions_of(recording);
    if (positions.empty()) return {};
    const std::vector<MeetingPlace> places = passages(positions);
    std::vector<std::optional<Motion>> found(places.size());
    parallel_for(places.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            found[k] = motion_at(recording, positions, places[k]);
        }
    });
    std::vector<Motion> loops;
    for (auto& motion : found) {
        if (motion) loops.push_back(*std::move(motion));
    }
    return loops;
}

}  // namespace dynamic_filter::io
