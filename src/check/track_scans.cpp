// SPDX-License-Identifier: MIT
#include "check/track_scans.hpp"

#include <algorithm>
#include <cmath>

#include "check/loops.hpp"
#include "check/pose_outliers.hpp"
#include "check/scan_input.hpp"
#include "dynamic_filter/check.hpp"
#include "tracking/beginning.hpp"
#include "tracking/pose_graph.hpp"
#include "tracking/pose_hints.hpp"
#include "tracking/upright.hpp"

namespace dynamic_filter::io {
namespace {

using MaybePoses = std::vector<std::optional<Pose>>;

MaybePoses given_poses(const Recording& recording) {
    MaybePoses given(recording.size());
    const auto& poses = recording.info().T_world_sensor;
    for (std::size_t i = 0; i < poses.size(); ++i) {
        if (poses[i].matrix().allFinite()) given[i] = poses[i];
    }
    return given;
}

/// Without those that lie apart from their neighbours.
MaybePoses credible_poses(const Recording& recording) {
    MaybePoses given = given_poses(recording);
    const Info& info = recording.info();
    for (const std::size_t i : outliers_of(info.T_world_sensor, info.stamps)) given[i].reset();
    return given;
}

/// Scans without a pose can be read from it as well, if their points are not in the world.
Recording readable_without_poses(const Recording& recording) {
    const auto& poses = recording.info().T_world_sensor;
    const bool are_complete = std::all_of(
        poses.begin(), poses.end(), [](const Pose& pose) { return pose.matrix().allFinite(); });
    return are_complete || recording.info().points_in_world ? recording : without_poses(recording);
}

/// The given poses at the scans nearest to them in time, brought to their stamps.
MaybePoses anchors(const Recording& recording, const TrackedScans& tracked) {
    const auto& [stamps, poses] = recording.info().trajectory;
    const std::vector<double>& scans = recording.info().stamps;
    MaybePoses given(recording.size());
    for (std::size_t k = 0; k < stamps.size(); ++k) {
        const auto next = std::lower_bound(scans.begin(), scans.end(), stamps[k]);
        if (next == scans.end() || (next == scans.begin() && *next != stamps[k])) continue;
        const bool is_before = next != scans.begin() && stamps[k] - *(next - 1) < *next - stamps[k];
        const auto i = static_cast<std::size_t>(next - scans.begin()) - (is_before ? 1 : 0);
        if (tracked[i]) given[i] = poses[k] * exp(tracked[i]->velocity * (scans[i] - stamps[k]));
    }
    return given;
}

/// The velocity at scan i, where a map begins.
std::optional<Twist> velocity_at(const Recording& recording, std::size_t i,
                                 const OdometryConfig& config) {
    std::vector<Scan> first;
    for (; i < recording.size() && first.size() < kBeginning; ++i) {
        if (auto scan = read_scan(recording, i)) first.push_back(*std::move(scan));
    }
    return initial_velocity(first, config);
}

/// Given motions are the first guess of the odometry as long as they predict what it finds.
class Guesses {
public:
    void begin(const std::optional<Twist>& velocity) {
        velocity_ = velocity;
        last_ = std::nullopt;
    }
    std::optional<Pose> before(double stamp, const std::optional<Pose>& T_world_given) {
        std::optional<Pose> guess;
        if (last_) {
            if (velocity_) guess = exp(*velocity_ * (stamp - last_->stamp));
            given_ = T_world_given && last_->T_world_given
                         ? std::optional(last_->T_world_given->inverse() * *T_world_given)
                         : std::nullopt;
            if (given_ && is_trusted_) guess = given_;
            velocity_ = std::nullopt;
        }
        last_ = Last{stamp, T_world_given};
        return guess;
    }
    /// `moved`: what the odometry found.
    void after(const Pose& moved) {
        constexpr double kShift = 0.1, kShare = 0.1, kTurn = 0.03;  // [m], share of the way, [rad]
        if (!given_) return;
        const Twist off = log(given_->inverse() * moved);
        is_trusted_ = off.head<3>().norm() < kShift + kShare * moved.translation().norm() &&
                      off.tail<3>().norm() < kTurn;
    }

private:
    struct Last {
        double stamp;
        std::optional<Pose> T_world_given;
    };
    std::optional<Twist> velocity_;
    std::optional<Last> last_;
    std::optional<Pose> given_;
    bool is_trusted_ = false;
};

/// Motions between neighbouring scans. Their errors add up over the way like those of a random
/// walk.
std::vector<Motion> neighbours(const TrackedScans& tracked) {
    constexpr double kShift = 0.01, kTurn = 2e-4;            // [m], [rad] per root of a metre
    constexpr double kLeastShift = 1e-3, kLeastTurn = 4e-5;  // [m], [rad] of a sensor that rests
    constexpr double kLostShift = 2.0, kLostTurn = 0.2;      // [m], [rad] of a guess
    std::vector<Motion> motions;
    std::optional<std::size_t> last;
    for (std::size_t i = 0; i < tracked.size(); ++i) {
        if (!tracked[i]) continue;
        if (last) {
            const Pose moved =
                tracked[*last]->T_world_sensor.inverse() * tracked[i]->T_world_sensor;
            const double root = std::sqrt(moved.translation().norm());
            const bool lost = tracked[i]->status == TrackStatus::lost || tracked[i]->begins_anew;
            Twist error;
            error << Eigen::Vector3d::Constant(lost ? kLostShift : kLeastShift + kShift * root),
                Eigen::Vector3d::Constant(lost ? kLostTurn : kLeastTurn + kTurn * root);
            Information covariance = tracked[i]->covariance;
            covariance.diagonal() += error.cwiseAbs2();
            motions.push_back({*last, i, moved, covariance.inverse(), false});
        }
        last = i;
    }
    return motions;
}

/// Where the trajectory begins in the world: so that the hint in the middle holds.
Pose beginning_of(const TrackedScans& tracked, const std::vector<PoseHint>& hints) {
    if (hints.empty()) return Pose::Identity();
    const PoseHint& hint = hints[hints.size() / 2];
    return hint.T_world_sensor * tracked[hint.scan]->T_world_sensor.inverse();
}

MaybePoses maybe_poses(const TrackedScans& tracked) {
    MaybePoses poses(tracked.size());
    for (std::size_t i = 0; i < tracked.size(); ++i) {
        if (tracked[i]) poses[i] = tracked[i]->T_world_sensor;
    }
    return poses;
}

void move_to(TrackedScans& tracked, const std::vector<Pose>& poses) {
    for (std::size_t i = 0; i < tracked.size(); ++i) {
        if (tracked[i]) tracked[i]->T_world_sensor = poses[i];
    }
}

std::vector<Pose> poses_of(const TrackedScans& tracked) {
    std::vector<Pose> poses(tracked.size(), Pose::Identity());
    for (std::size_t i = 0; i < tracked.size(); ++i) {
        if (tracked[i]) poses[i] = tracked[i]->T_world_sensor;
    }
    return poses;
}

}  // namespace

TrackedScans follow(const Recording& recording, const OdometryConfig& config,
                    const std::function<bool()>& after) {
    const Recording readable = readable_without_poses(recording);
    const MaybePoses given = credible_poses(recording);
    TrackedScans tracked(recording.size());
    Odometry odometry(config);
    Guesses guesses;
    guesses.begin(velocity_at(readable, 0, config));
    Pose T_world_last = Pose::Identity();
    bool is_first = true;
    for (std::size_t i = 0; i < recording.size(); ++i) {
        if (const auto scan = read_scan(readable, i)) {
            auto guess = guesses.before(scan->stamp, given[i]);
            if (is_first) guess = Pose(upright_rotation(scan->points));  // in the world
            is_first = false;
            tracked[i] = odometry.track(scan->points, scan->times, scan->stamp, guess);
            odometry.learn({});
            guesses.after(T_world_last.inverse() * tracked[i]->T_world_sensor);
            T_world_last = tracked[i]->T_world_sensor;
            if (tracked[i]->begins_anew) guesses.begin(velocity_at(readable, i, config));
        }
        if (after && !after()) break;
    }
    return tracked;
}

TrackedScans bind_poses(const Recording& recording, TrackedScans tracked, bool to_given) {
    constexpr int kRounds = 3;  // corrected poses meet at more places
    const std::vector<Motion> chain = neighbours(tracked);
    const MaybePoses given =
        recording.info().sparse_poses ? anchors(recording, tracked) : credible_poses(recording);
    std::vector<PoseHint> hints = hints_of(given, maybe_poses(tracked));
    const Pose T_world_odometry = beginning_of(tracked, hints);
    if (!to_given) hints.clear();
    std::vector<Pose> start = poses_of(tracked);
    for (Pose& pose : start) pose = T_world_odometry * pose;
    std::vector<Motion> loops;
    for (int round = 0; round < kRounds; ++round) {
        std::vector<Motion> motions = chain;
        motions.insert(motions.end(), loops.begin(), loops.end());
        move_to(tracked, solve_pose_graph(start, motions, hints));
        std::vector<Motion> more = find_loops(with_poses(recording, tracked));
        if (more.size() <= loops.size()) break;
        loops = std::move(more);
    }
    return tracked;
}

TrackedScans track_scans(const Recording& recording, const OdometryConfig& config,
                         const std::function<bool()>& after) {
    return bind_poses(recording, follow(recording, config, after), true);
}

}  // namespace dynamic_filter::io
