// SPDX-License-Identifier: MIT
#include "check/place_drive.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "base/degree.hpp"
#include "base/numbers.hpp"
#include "check/meeting_places.hpp"
#include "check/place_offset.hpp"
#include "check/recognized_places.hpp"
#include "check/seen_through.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/parallel.hpp"
#include "tracking/pose_graph.hpp"
#include "tracking/upright.hpp"

namespace dynamic_filter::io {
namespace {

constexpr std::size_t kMostOfDrive = 100, kMostOfMap = 1000;  // places

/// The information of the points, less what the registration does not know of.
Information believed(const Information& of_points) {
    constexpr double kShift = 0.03, kTurn = 0.06 * kDegree;  // [m], [rad]
    Information regular = of_points;
    regular.diagonal().array() += 1e-6;
    Information covariance = regular.inverse();
    covariance.diagonal().head<3>().array() += kShift * kShift;
    covariance.diagonal().tail<3>().array() += kTurn * kTurn;
    return covariance.inverse();
}

/// How the drive went, from scan to scan.
std::vector<Motion> own_way(const std::vector<Pose>& poses) {
    constexpr double kShift = 0.005, kShiftShare = 0.01;    // [m]
    constexpr double kTurn = 0.0003, kTurnPerMetre = 3e-4;  // [rad]
    std::vector<Motion> motions;
    std::optional<std::size_t> last;
    for (std::size_t i = 0; i < poses.size(); ++i) {
        if (!poses[i].matrix().allFinite()) continue;
        if (last) {
            Motion motion{*last, i, poses[*last].inverse() * poses[i]};
            const double step = motion.T_from_to.translation().norm();
            const double shift = kShift + kShiftShare * step, turn = kTurn + kTurnPerMetre * step;
            motion.information.diagonal() << Eigen::Vector3d::Constant(1.0 / (shift * shift)),
                Eigen::Vector3d::Constant(1.0 / (turn * turn));
            motions.push_back(motion);
        }
        last = i;
    }
    return motions;
}

/// Where the places of the drive lie on those of the map, at these poses of the drive.
struct OnMap {
    std::vector<PoseHint> hints;
    std::vector<double> through;  // by fitting place: share of what the map's scan saw through
    std::vector<double> fits;     // by fitting place: PlaceOffset::fit
    std::size_t places = 0;
    double worst = 0.0;  // [m] correction
};

/// Of points in the world.
double seen_through_by(const Recording& map, std::size_t scan, const Points& points) {
    try {
        const FullScan full = map.read(scan);
        if (!full.has_pose) return 0.0;
        return seen_through(full.points, moved(points, full.T_world_sensor.inverse()));
    } catch (const InputError&) {
        return 0.0;
    }
}

/// The scan of the map that was taken nearest to a place.
std::optional<ScanOfDrive> nearest_of(const std::vector<Positions>& map,
                                      const Eigen::Vector3d& at) {
    std::optional<ScanOfDrive> nearest;
    double least = kMeetingDistance;
    for (std::size_t d = 0; d < map.size(); ++d) {
        for (std::size_t i = 0; i < map[d].size(); ++i) {
            const double distance = (map[d][i] - at).norm();
            if (!(distance < least)) continue;
            least = distance;
            nearest = ScanOfDrive{d, i};
        }
    }
    return nearest;
}

/// The recordings of the map, and where their scans were taken.
struct MapDrives {
    std::span<const Recording* const> recordings;
    std::vector<Positions> positions;
};

/// A place of the drive, laid on the map.
struct Laid {
    bool is_compared = false;
    std::optional<PoseHint> hint{};  // empty: it does not fit
    double fit = 0.0, through = 0.0;
};

Laid lay_place(const Local& local, const Pose& own, const Pose& now, const MapDrives& map) {
    const Eigen::Vector3d at = now.translation();
    const std::optional<ScanOfDrive> near = nearest_of(map.positions, at);
    if (!near) return {};
    const Recording& recording = *map.recordings[near->drive];
    const auto around = scans_around(map.positions[near->drive], near->scan, 2.0, 2);
    const Pose turn(now.linear() * own.linear().transpose());
    const auto offset = register_clouds(cloud_around(recording, around, at),
                                        moved(local.cloud, turn), at, 2.0 * kSameTilt);
    if (!offset) return {};
    if (!offset->fits()) return {.is_compared = true};
    const Pose to_map = Eigen::Translation3d(at) * offset->motion;
    Information axes = Information::Zero();  // of the world, for those of the sensor
    axes.topLeftCorner<3, 3>() = axes.bottomRightCorner<3, 3>() = now.linear();
    return {.is_compared = true,
            .hint = PoseHint{local.place.scan, to_map * Eigen::Translation3d(-at) * now,
                             axes.transpose() * believed(offset->of_motion) * axes},
            .fit = offset->fit,
            .through = seen_through_by(recording, near->scan,
                                       moved(upright_points(local.cloud), to_map * turn))};
}

OnMap lay_on(const MapDrives& map, const std::vector<Local>& drive, const std::vector<Pose>& own,
             const std::vector<Pose>& poses) {
    std::vector<Laid> laid(drive.size());
    parallel_for(drive.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            const std::size_t scan = drive[k].place.scan;
            laid[k] = lay_place(drive[k], own[scan], poses[scan], map);
        }
    });
    OnMap on_map;
    for (const Laid& place : laid) {
        on_map.places += place.is_compared ? 1 : 0;
        if (!place.hint) continue;
        const Eigen::Vector3d& at = poses[place.hint->scan].translation();
        on_map.worst =
            std::max(on_map.worst, (place.hint->T_world_sensor.translation() - at).norm());
        on_map.hints.push_back(*place.hint);
        on_map.through.push_back(place.through);
        on_map.fits.push_back(place.fit);
    }
    return on_map;
}

/// The drive where its places were recognized on the map; empty if they tell nothing.
std::vector<PoseHint> hints_by_looks(const MapDrives& map, const std::vector<Local>& drive,
                                     const std::vector<Pose>& own) {
    constexpr double kShift = 0.5, kTurn = 1.0 * kDegree;
    std::vector<PoseHint> hints;
    for (const Found& found : recognize(locals_of(map.recordings, kMostOfMap), drive)) {
        PoseHint hint{found.of_drive->place.scan, found.motion * own[found.of_drive->place.scan]};
        hint.information.diagonal() << Eigen::Vector3d::Constant(1.0 / (kShift * kShift)),
            Eigen::Vector3d::Constant(1.0 / (kTurn * kTurn));
        hints.push_back(hint);
    }
    return hints;
}

/// The drive as a whole, where one of the places is: a start for the pose graph.
std::vector<Pose> placed_whole(const std::vector<Pose>& own, const PoseHint& hint) {
    const Pose motion = hint.T_world_sensor * own[hint.scan].inverse();
    std::vector<Pose> poses;
    poses.reserve(own.size());
    for (const Pose& pose : own) poses.push_back(motion * pose);
    return poses;
}

/// Bends the way of the drive, from a start, until its places lie on the map.
PlacedDrive bent(const MapDrives& map, const std::vector<Local>& drive,
                 const std::vector<Pose>& own, std::vector<Pose> start) {
    constexpr int kRounds = 6;
    constexpr double kStill = 0.02;  // [m]
    const std::vector<Motion> way = own_way(own);
    PlacedDrive placed;
    placed.T_world_sensor = std::move(start);
    OnMap on_map = lay_on(map, drive, own, placed.T_world_sensor);
    for (int round = 0; round < kRounds && !on_map.hints.empty(); ++round) {
        placed.T_world_sensor = solve_pose_graph(placed.T_world_sensor, way, on_map.hints);
        if (on_map.worst < kStill) break;
        on_map = lay_on(map, drive, own, placed.T_world_sensor);
    }
    placed.places = on_map.places;
    placed.fitting = on_map.hints.size();
    placed.through = median(std::move(on_map.through));
    placed.fit = median(std::move(on_map.fits));
    for (std::size_t i = 0; i < own.size(); ++i) {
        const double moved = (placed.T_world_sensor[i].translation() - own[i].translation()).norm();
        if (std::isfinite(moved)) placed.moved = std::max(placed.moved, moved);
    }
    return placed;
}

}  // namespace

bool PlacedDrive::fits() const {
    // Streets may look alike, so half of the points on surfaces of the map is not enough.
    constexpr double kMost = 0.8, kFit = 0.57, kMostThrough = 0.08;
    return fitting >= kFewestOnMap &&
           static_cast<double>(fitting) >= kMost * static_cast<double>(places) && fit >= kFit &&
           through <= kMostThrough;
}

PlacedDrive place_drive(const Recording& drive, std::span<const Recording* const> drives) {
    const Recording* const alone = &drive;
    const std::vector<Pose>& own = drive.info().T_world_sensor;
    const std::vector<Local> locals = locals_of({&alone, 1}, kMostOfDrive);
    MapDrives map{drives, {}};
    for (const Recording* recording : drives) map.positions.push_back(positions_of(*recording));
    PlacedDrive near = bent(map, locals, own, own);
    if (near.fits()) return near;
    const std::vector<PoseHint> hints = hints_by_looks(map, locals, own);
    if (hints.empty()) return near;
    PlacedDrive found = bent(
        map, locals, own, solve_pose_graph(placed_whole(own, hints.front()), own_way(own), hints));
    found.is_found = true;
    return found;
}

}  // namespace dynamic_filter::io
