// SPDX-License-Identifier: MIT
#include "check/pose_mistakes.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <functional>

#include "base/degree.hpp"
#include "base/numbers.hpp"
#include "dynamic_filter/motion.hpp"

namespace dynamic_filter::io {
namespace {

constexpr double kRange = 10.0;  // [m] range at which a rotation error is converted to a distance
// Separation of the scans whose motions are used to fit mistakes.
constexpr std::size_t kFitApart = 10;

/// Pose of the sensor at scan i under the assumption of a mistake with these parameters.
using Model = std::function<Pose(const TwoTracks&, std::size_t, const Eigen::VectorXd&)>;

/// `poses` are those of the track at its stamps.
Pose interpolated(const TwoTracks& track, const std::vector<Pose>& poses, double stamp) {
    const auto after = std::upper_bound(track.stamps.begin() + 1, track.stamps.end() - 1, stamp);
    const auto i = static_cast<std::size_t>(after - track.stamps.begin());
    const double share = (stamp - track.stamps[i - 1]) / (track.stamps[i] - track.stamps[i - 1]);
    return poses[i - 1] * exp(share * log(poses[i - 1].inverse() * poses[i]));
}

Pose as_shown(const TwoTracks& track, std::size_t i, const Eigen::VectorXd&) {
    return track.shown[i];
}

/// Differences between the measured motions over `apart` scans and those that the model predicts.
Eigen::VectorXd errors_of(const std::vector<TwoTracks>& tracks, const Model& model,
                          const Eigen::VectorXd& parameters, std::size_t apart) {
    std::vector<double> errors;
    for (const TwoTracks& track : tracks) {
        for (std::size_t i = apart; i < track.given.size(); ++i) {
            const Pose expected =
                model(track, i - apart, parameters).inverse() * model(track, i, parameters);
            Twist off = log(expected.inverse() * track.given[i - apart].inverse() * track.given[i]);
            off.tail<3>() *= kRange;
            errors.insert(errors.end(), off.begin(), off.end());
        }
    }
    return Eigen::Map<Eigen::VectorXd>(errors.data(), static_cast<Eigen::Index>(errors.size()));
}

struct Fit {
    Eigen::VectorXd parameters;
    double explained = 0.0;  // explained share of the squared error
};

/// Share of the squared error that a constant drift in the sensor frame explains.
double explained_by_drift(const std::vector<TwoTracks>& tracks) {
    const Eigen::VectorXd errors = errors_of(tracks, as_shown, {}, kFitApart);
    if (errors.size() == 0) return 0.0;
    const auto steps = Eigen::Map<const Eigen::MatrixXd>(errors.data(), 6, errors.size() / 6);
    const double after = (steps.colwise() - steps.rowwise().mean()).squaredNorm();
    return 1.0 - after / std::max(errors.squaredNorm(), 1e-12);
}

/// Gauss-Newton with numerical derivatives.
Fit fit(const std::vector<TwoTracks>& tracks, const Model& model, Eigen::Index count) {
    constexpr int kSteps = 4;
    constexpr double kDifference = 1e-3;
    Fit result{Eigen::VectorXd::Zero(count), 0.0};
    const double before = errors_of(tracks, model, result.parameters, kFitApart).squaredNorm();
    for (int step = 0; step < kSteps; ++step) {
        const Eigen::VectorXd errors = errors_of(tracks, model, result.parameters, kFitApart);
        Eigen::MatrixXd J(errors.size(), count);
        for (Eigen::Index k = 0; k < count; ++k) {
            Eigen::VectorXd moved = result.parameters;
            moved[k] += kDifference;
            J.col(k) = (errors_of(tracks, model, moved, kFitApart) - errors) / kDifference;
        }
        Eigen::MatrixXd H = J.transpose() * J;
        H.diagonal().array() += 1e-3;  // parameters that the trajectory does not determine stay 0
        result.parameters -= H.ldlt().solve(J.transpose() * errors);
    }
    const double after = errors_of(tracks, model, result.parameters, kFitApart).squaredNorm();
    result.explained = before > 0.0 ? 1.0 - after / before : 0.0;
    return result;
}

/// Median error over so many scans: of the translation [m], and of the rotation at kRange [m].
std::pair<double, double> typical_error(const std::vector<TwoTracks>& tracks, std::size_t apart) {
    const Eigen::VectorXd errors = errors_of(tracks, as_shown, {}, apart);
    std::vector<double> shifts, turns;
    for (Eigen::Index i = 0; i + 6 <= errors.size(); i += 6) {
        shifts.push_back(errors.segment<3>(i).norm());
        turns.push_back(errors.segment<3>(i + 3).norm());
    }
    return {median(std::move(shifts)), median(std::move(turns))};
}

std::string offset_text(double seconds) {
    return fmt::format("the poses are offset in time: each is where the sensor was {:.0f} ms {}",
                       1e3 * std::abs(seconds),
                       seconds > 0.0 ? "after its scan" : "before its scan");
}

std::string mount_text(const Eigen::VectorXd& displacement) {
    const Eigen::Vector3d shift = displacement.head<3>(), turn = displacement.tail<3>() / kDegree;
    return fmt::format(
        "the poses are not the sensor's own, but of a frame that lies ({:.2f}, {:.2f}, {:.2f}) m "
        "from it and is turned by ({:.1f}, {:.1f}, {:.1f}) deg",
        shift.x(), shift.y(), shift.z(), turn.x(), turn.y(), turn.z());
}

/// Describes the noise: errors that do not grow with distance are jitter, growing ones are drift.
std::string noise_text(const std::vector<TwoTracks>& tracks) {
    const auto [near_shift, near_turn] = typical_error(tracks, 1);
    const auto [far_shift, far_turn] = typical_error(tracks, 20);
    const bool grows = far_shift + far_turn > 2.0 * (near_shift + near_turn);
    if (!grows) {
        return fmt::format(
            "the poses jitter: from one scan to the next they are off by {:.1f} cm and {:.2f} deg",
            100.0 * near_shift, near_turn / kRange / kDegree);
    }
    return fmt::format("the poses drift: over 20 scans they are off by {:.1f} cm and {:.2f} deg",
                       100.0 * far_shift, far_turn / kRange / kDegree);
}

}  // namespace

namespace {

template <class PoseAt>
std::vector<std::vector<Pose>> mended(const std::vector<TwoTracks>& tracks, const PoseAt& pose_at) {
    std::vector<std::vector<Pose>> all;
    for (const TwoTracks& track : tracks) {
        std::vector<Pose>& poses = all.emplace_back();
        for (std::size_t i = 0; i < track.given.size(); ++i) poses.push_back(pose_at(track, i));
    }
    return all;
}

/// Describes an offset in time or another frame, if that explains more than `mostly` of the squared
/// error.
ConstantMistake constant_mistake(const std::vector<TwoTracks>& tracks, double mostly) {
    constexpr double kLeastOffset = 0.01, kMostOffset = 1.0;  // [s]
    constexpr double kBetter = 0.1;
    constexpr double kFarthestMount = 5.0;  // [m] larger than any vehicle
    const Fit offset = fit(
        tracks,
        [](const TwoTracks& track, std::size_t i, const Eigen::VectorXd& p) {
            return interpolated(track, track.shown, track.stamps[i] + p[0]);
        },
        1);
    const Fit mount = fit(
        tracks,
        [](const TwoTracks& track, std::size_t i, const Eigen::VectorXd& p) {
            return track.shown[i] * exp(Twist(p));
        },
        6);
    const bool is_offset = offset.explained > mostly &&
                           std::abs(offset.parameters[0]) > kLeastOffset &&
                           std::abs(offset.parameters[0]) < kMostOffset &&
                           offset.explained > mount.explained - kBetter;
    if (is_offset) {
        const double seconds = offset.parameters[0];
        return {offset_text(seconds), mended(tracks, [&](const TwoTracks& track, std::size_t i) {
                    return interpolated(track, track.given, track.stamps[i] - seconds);
                })};
    }
    // At a constant speed, poses of another frame look like a constant drift.
    const bool is_mount = mount.explained > mostly &&
                          mount.explained > explained_by_drift(tracks) + kBetter &&
                          mount.parameters.head<3>().norm() < kFarthestMount;
    if (!is_mount) return {};
    const Pose T_frame_sensor = exp(Twist(mount.parameters)).inverse();
    return {mount_text(mount.parameters),
            mended(tracks, [&](const TwoTracks& track, std::size_t i) {
                return track.given[i] * T_frame_sensor;
            })};
}

}  // namespace

std::string name_mistake(const std::vector<TwoTracks>& tracks) {
    constexpr double kMostly = 0.5;
    const std::string constant = constant_mistake(tracks, kMostly).text;
    return constant.empty() ? noise_text(tracks) : constant;
}

ConstantMistake find_constant_mistake(const std::vector<TwoTracks>& tracks) {
    constexpr double kNearlyAll = 0.8;
    constexpr double kOdometry = 0.03;  // [m] error of the odometry itself
    const Eigen::VectorXd errors = errors_of(tracks, as_shown, {}, kFitApart);
    const double mean_square = 6.0 * errors.squaredNorm() / static_cast<double>(errors.size());
    return std::sqrt(mean_square) > kOdometry ? constant_mistake(tracks, kNearlyAll)
                                              : ConstantMistake{};
}

}  // namespace dynamic_filter::io
