// SPDX-License-Identifier: MIT
#include "check/place_drive.hpp"

#include <algorithm>
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

/// The drive in its own world.
struct OwnDrive {
    const std::vector<Pose>& poses;
    std::vector<Local> places;
    std::vector<Motion> way;  // from scan to scan
};

/// A place of the drive, laid on the map.
struct Laid {
    const Local* of_drive;
    ScanOfDrive near;  // of the map
    Pose to_map;       // of the points of the place
    double fit;        // PlaceOffset::fit
    PoseHint hint;
};

/// Where the places of the drive lie on those of the map, at some poses of the drive.
struct OnMap {
    std::vector<Laid> fitting;
    std::size_t places = 0;
    double worst = 0.0;  // [m] correction

    [[nodiscard]] std::vector<PoseHint> hints() const {
        std::vector<PoseHint> all;
        for (const Laid& laid : fitting) all.push_back(laid.hint);
        return all;
    }
};

struct LaidOrNot {
    bool shows_enough = false;
    std::optional<Laid> laid{};  // empty: it does not fit
};

LaidOrNot lay_place(const Local& local, const Pose& own, const Pose& now, const MapDrives& map) {
    const Eigen::Vector3d at = now.translation();
    const std::optional<ScanOfDrive> near = nearest_of(map.positions, at);
    if (!near) return {};
    const auto around = scans_around(map.positions[near->drive], near->scan, 2.0, 2);
    const Pose turn(now.linear() * own.linear().transpose());
    const auto offset = register_clouds(cloud_around(*map.recordings[near->drive], around, at),
                                        moved(local.cloud, turn), at, 2.0 * kSameTilt);
    if (!offset) return {};
    if (!offset->fits()) return {.shows_enough = true};
    const Pose to_map = Eigen::Translation3d(at) * offset->motion;
    const PoseHint hint{local.place.scan, to_map * Eigen::Translation3d(-at) * now,
                        in_sensor(offset->of_motion, now)};
    return {.shows_enough = true, .laid = Laid{&local, *near, to_map * turn, offset->fit, hint}};
}

OnMap lay_on(const MapDrives& map, const OwnDrive& drive, const std::vector<Pose>& poses) {
    std::vector<LaidOrNot> compared(drive.places.size());
    parallel_for(compared.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            const std::size_t scan = drive.places[k].place.scan;
            compared[k] = lay_place(drive.places[k], drive.poses[scan], poses[scan], map);
        }
    });
    OnMap on_map;
    for (const LaidOrNot& place : compared) {
        on_map.places += place.shows_enough ? 1 : 0;
        if (!place.laid) continue;
        const PoseHint& hint = place.laid->hint;
        const Eigen::Vector3d& at = poses[hint.scan].translation();
        on_map.worst = std::max(on_map.worst, (hint.T_world_sensor.translation() - at).norm());
        on_map.fitting.push_back(*place.laid);
    }
    return on_map;
}

/// Of the upright points of a place, the share that the nearest scan of the map saw through.
double seen_through_by(const MapDrives& map, const Laid& laid) {
    try {
        const FullScan full = map.recordings[laid.near.drive]->read(laid.near.scan);
        if (!full.has_pose) return 0.0;
        const Points points = moved(upright_points(laid.of_drive->cloud), laid.to_map);
        return seen_through(full.points, moved(points, full.T_world_sensor.inverse()));
    } catch (const InputError&) {
        return 0.0;
    }
}

/// The drive where its places were recognized on the map; empty if they tell nothing.
std::vector<PoseHint> hints_by_looks(const MapDrives& map, const OwnDrive& drive) {
    constexpr double kShift = 0.5, kTurn = 1.0 * kDegree;
    std::vector<PoseHint> hints;
    for (const Found& found : recognize(locals_of(map.recordings, kMostOfMap), drive.places)) {
        const std::size_t scan = found.of_drive->place.scan;
        PoseHint hint{scan, found.motion * drive.poses[scan]};
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
PlacedDrive bent(const MapDrives& map, const OwnDrive& drive, std::vector<Pose> start) {
    constexpr int kRounds = 6;
    constexpr double kStill = 0.02;  // [m]
    PlacedDrive placed;
    placed.T_world_sensor = std::move(start);
    OnMap on_map = lay_on(map, drive, placed.T_world_sensor);
    for (int round = 0; round < kRounds && !on_map.fitting.empty(); ++round) {
        placed.T_world_sensor = solve_pose_graph(placed.T_world_sensor, drive.way, on_map.hints());
        if (on_map.worst < kStill) break;
        on_map = lay_on(map, drive, placed.T_world_sensor);
    }
    placed.places = on_map.places;
    placed.fitting = on_map.fitting.size();
    std::vector<double> through(on_map.fitting.size()), fits;
    parallel_for(through.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            through[k] = seen_through_by(map, on_map.fitting[k]);
        }
    });
    for (const Laid& laid : on_map.fitting) fits.push_back(laid.fit);
    placed.through = median(std::move(through));
    placed.fit = median(std::move(fits));
    for (std::size_t i = 0; i < drive.poses.size(); ++i) {
        const Eigen::Vector3d way =
            placed.T_world_sensor[i].translation() - drive.poses[i].translation();
        if (way.allFinite()) placed.moved = std::max(placed.moved, way.norm());
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
    const std::vector<Pose>& poses = drive.info().T_world_sensor;
    const OwnDrive own{poses, locals_of({&alone, 1}, kMostOfDrive), own_way(poses)};
    MapDrives map{drives, {}};
    for (const Recording* recording : drives) map.positions.push_back(positions_of(*recording));
    PlacedDrive near = bent(map, own, poses);
    if (near.fits()) return near;
    const std::vector<PoseHint> hints = hints_by_looks(map, own);
    if (hints.empty()) return near;
    PlacedDrive found =
        bent(map, own, solve_pose_graph(placed_whole(poses, hints.front()), own.way, hints));
    found.is_found = true;
    return found;
}

}  // namespace dynamic_filter::io
