// SPDX-License-Identifier: MIT
#include "dynamic_filter/tracking.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "geometry/pose.hpp"
#include "tracking/coarse_search.hpp"
#include "tracking/registration.hpp"
#include "tracking/scan_sample.hpp"

namespace dynamic_filter {
namespace {

constexpr double kLeastShift = 0.01;  // [m] smallest uncertainty of the expected position
constexpr double kLeastTurn = 0.002;  // [rad] smallest uncertainty of the expected rotation
constexpr double kFastestTurn = 1.5;  // [rad/s] limit for a sensor whose motion is not known
constexpr double kNarrow = 0.2, kWide = 2.0;  // [m] initial reach of the registration
constexpr std::size_t kCandidates = 6;        // number of poses that a wide search tries
constexpr SearchWindow kSmallest{2.0, 0.1}, kLargest{20.0, 0.6};
constexpr double kNearly = 0.95;  // share of inliers that counts as equally good
constexpr double kYoung = 0.75;  // factor of lost_below for a map of one scan, which has many holes
constexpr double kHabit = 0.2;   // weight of a scan in the mean share of points on the map
constexpr int kMostBeginnings = 10;    // iterations for the first scan, whose motion was not known
constexpr double kAgreed = 0.003;      // [m], [rad] change at which the iterations stop
constexpr int kGiveUp = 10;            // number of lost scans in a row after which a new map begins
constexpr double kMapRadius = 1.5;     // radius of the map as a multiple of the range of the sensor
constexpr double kForgetEvery = 20.0;  // [m] motion after which far parts of the map are removed
// [m] distance from the origin up to which floats are precise enough.
constexpr double kFarFromOrigin = 1000.0;

/// True if, in the least determined direction, the points give less information than the prior,
/// which is an extrapolation of the previous motion, or hardly any of what they give in all. In a
/// smooth tunnel, the noise of the normals alone gives a little, and it says that the sensor rests.
bool is_weak(const Registration& found, const PosePrior& prior) {
    constexpr double kNoiseOfNormals = 0.011;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(
        found.information.topLeftCorner<3, 3>());
    const double least = axes.eigenvalues()[0];
    return least < std::max(prior.information(0, 0), kNoiseOfNormals * axes.eigenvalues().sum());
}

}  // namespace

/// The data of one scan: the expected pose and its uncertainty.
struct Step {
    PosePrior prior;
    double dt = 0.0;     // [s] since the previous scan
    double shift = 0.0;  // [m] uncertainty of the expected position
    ScanSample sample;   // the points for the registration
};

struct Odometry::Impl {
    explicit Impl(const OdometryConfig& c) : config(c), map(c.voxel) {}

    [[nodiscard]] Step expect(double dt, const std::optional<Pose>& guess) const;
    [[nodiscard]] Registration register_from(const Pose& start, const Step& step,
                                             double reach) const;
    Registration begin_again(const Step& step, Registration found);
    [[nodiscard]] Registration search(const Step& step, Registration best) const;
    [[nodiscard]] Tracked tracked(const Step& step, const Registration& found) const;
    Tracked go_on_lost(const Step& step);
    [[nodiscard]] Twist velocity_of(const Pose& T_map_sensor, double dt) const {
        return log(T_map_last.inverse() * T_map_sensor) / dt;
    }
    void forget_far();

    OdometryConfig config;
    SurfaceMap map;
    // Origin of the map frame, in the world frame.
    Eigen::Vector3d origin = Eigen::Vector3d::Zero();
    Pose T_map_last = Pose::Identity();
    double stamp = 0.0;
    Twist velocity = Twist::Zero();
    bool velocity_known = false;
    double usual_inliers = 0.0;
    int lost_in_a_row = 0;
    ScanSample newest;  // points of the newest scan, for the map
    // First scan of a map, without motion compensation, until the velocity is known.
    ScanSample first;
    Pose T_map_first = Pose::Identity();
    Eigen::Vector3d forgot_at = Eigen::Vector3d::Zero();
};

/// Extrapolates the previous motion. Its uncertainty follows from the accelerations in the
/// settings; at the start of a recording, from the speed in the settings.
Step Odometry::Impl::expect(double dt, const std::optional<Pose>& guess) const {
    Step step;
    step.dt = dt;
    const bool known = velocity_known || guess;
    const double degree = std::numbers::pi / 180.0;
    step.shift = known ? std::max(kLeastShift, config.acceleration * dt * dt) : config.speed * dt;
    const double turn = known ? std::max(kLeastTurn, config.angular_acceleration * degree * dt * dt)
                              : kFastestTurn * dt;
    step.prior.T_map_sensor = T_map_last * (guess ? *guess : exp(velocity * dt));
    step.prior.information.diagonal().head<3>().setConstant(1.0 / (step.shift * step.shift));
    step.prior.information.diagonal().tail<3>().setConstant(1.0 / (turn * turn));
    return step;
}

/// Registers the scan. If the times of its points are known, registers it again with the motion
/// compensation that follows from the result.
Registration Odometry::Impl::register_from(const Pose& start, const Step& step,
                                           double reach) const {
    const Points at_stamp = step.sample.at_stamp(velocity_of(start, step.dt));
    const Registration found = register_points(map, at_stamp, start, step.prior, reach);
    if (step.sample.times.empty()) return found;
    const Points again = step.sample.at_stamp(velocity_of(found.T_map_sensor, step.dt));
    return register_points(map, again, found.T_map_sensor, step.prior, kNarrow);
}

/// Returns the best registration: `best`, or one from the poses at which the scan looks like the
/// map from above.
Registration Odometry::Impl::search(const Step& step, Registration best) const {
    const SearchWindow window{
        std::clamp(config.speed * step.dt, kSmallest.distance, kLargest.distance),
        std::clamp(kFastestTurn * step.dt, kSmallest.turn, kLargest.turn)};
    const Pose& expected = step.prior.T_map_sensor;
    const Points around = moved(map.places(), expected.inverse());
    // Beam patterns look alike in distant places. So among poses that fit nearly equally well, the
    // one near the expected pose is preferred; it is right more often.
    const auto shift_of = [&](const Registration& r) {
        return (expected.inverse() * r.T_map_sensor).translation().norm();
    };
    const auto is_better = [&](const Registration& a, const Registration& b) {
        const bool nearer = shift_of(a) < shift_of(b);
        return nearer ? a.inliers > kNearly * b.inliers : kNearly * a.inliers > b.inliers;
    };
    const auto consider = [&](const Registration& found) {
        if (is_better(found, best)) best = found;
    };
    consider(register_from(expected, step, kNarrow));
    for (const Pose& displacement :
         search_displacements(around, newest.points, window, kCandidates)) {
        consider(register_from(expected * displacement, step, 0.5 * kWide));
    }
    return best;
}

/// Assumes that the motion during the first scan was the same as during the second one. Makes the
/// map again from the first scan with this motion compensation, until both scans give the same
/// motion.
Registration Odometry::Impl::begin_again(const Step& step, Registration found) {
    for (int i = 0; i < kMostBeginnings; ++i) {
        map = SurfaceMap(config.voxel);
        map.insert(moved(first.at_stamp(velocity_of(found.T_map_sensor, step.dt)), T_map_first));
        const Pose before = found.T_map_sensor;
        found = register_from(before, step, kNarrow);
        if (log(before.inverse() * found.T_map_sensor).norm() < kAgreed) break;
    }
    first = {};
    return found;
}

Tracked Odometry::Impl::tracked(const Step& step, const Registration& found) const {
    Tracked result;
    result.T_world_sensor = Eigen::Translation3d(origin) * T_map_last;
    result.velocity = velocity;
    result.inliers = found.inliers;
    if (is_weak(found, step.prior)) result.status = TrackStatus::weak;
    const Information both = found.information + step.prior.information;
    result.covariance = both.ldlt().solve(Information::Identity());
    return result;
}

Tracked Odometry::Impl::go_on_lost(const Step& step) {
    T_map_last = step.prior.T_map_sensor;
    Tracked result = tracked(step, {});
    result.status = TrackStatus::lost;
    result.begins_anew = ++lost_in_a_row == kGiveUp;
    if (result.begins_anew) {
        map = SurfaceMap(config.voxel);
        velocity_known = false;
        lost_in_a_row = 0;
    }
    return result;
}

void Odometry::Impl::forget_far() {
    const Eigen::Vector3d here = T_map_last.translation();
    if ((origin + here - forgot_at).norm() < kForgetEvery) return;
    forgot_at = origin + here;
    map.keep_within(here.cast<float>(), static_cast<float>(kMapRadius * config.farthest));
    if (here.norm() < kFarFromOrigin) return;
    const Eigen::Vector3d shift = nearby_origin(T_map_last, static_cast<double>(map.coarsest()));
    map.move_origin(shift.cast<float>());
    origin += shift;
    T_map_last.translation() -= shift;
}

Odometry::Odometry(const OdometryConfig& config) : impl_(std::make_unique<Impl>(config)) {}
Odometry::Odometry(Odometry&&) noexcept = default;
Odometry& Odometry::operator=(Odometry&&) noexcept = default;
Odometry::~Odometry() = default;

Tracked Odometry::track(const Points& points, std::span<const float> times, double stamp,
                        const std::optional<Pose>& guess) {
    constexpr double kShortest = 1e-3;  // [s] shortest time between scans
    Impl& o = *impl_;
    const double dt = std::max(kShortest, stamp - std::exchange(o.stamp, stamp));
    o.newest = sample_for_map(points, times, o.config);
    if (o.map.empty()) {
        if (guess) o.T_map_last = o.T_map_last * *guess;
        Tracked first;
        first.T_world_sensor = Eigen::Translation3d(o.origin) * o.T_map_last;
        return first;
    }
    Step step = o.expect(dt, guess);
    step.sample = sample_for_registration(o.newest, o.config);
    const double reach = std::clamp(3.0 * step.shift, kNarrow, kWide);
    Registration found = o.register_from(step.prior.T_map_sensor, step, reach);
    const double enough = std::max(o.config.lost_below, o.config.usual_share * o.usual_inliers);
    if ((!o.velocity_known && !guess) || found.inliers < enough) found = o.search(step, found);
    const double least = (o.velocity_known ? 1.0 : kYoung) * o.config.lost_below;
    if (found.inliers < least) return o.go_on_lost(step);
    if (!o.first.times.empty()) found = o.begin_again(step, found);

    o.lost_in_a_row = 0;
    o.velocity = o.velocity_of(found.T_map_sensor, dt);
    o.velocity_known = true;
    o.T_map_last = found.T_map_sensor;
    const double habit = o.usual_inliers > 0.0 ? kHabit : 1.0;
    o.usual_inliers += habit * (found.inliers - o.usual_inliers);
    return o.tracked(step, found);
}

void Odometry::learn(const Labels& labels) {
    Impl& o = *impl_;
    if (o.lost_in_a_row > 0) return;
    const ScanSample kept = without_dynamic(o.newest, labels);
    if (o.map.empty()) {
        o.first = kept;
        o.T_map_first = o.T_map_last;
    }
    o.map.insert(moved(kept.at_stamp(o.velocity), o.T_map_last));
    o.forget_far();
}

}  // namespace dynamic_filter
