// SPDX-License-Identifier: MIT
#include "dynamic_filter/check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <tuple>

#include "base/numbers.hpp"
#include "check/choose_poses.hpp"
#include "check/motion_look.hpp"
#include "check/pieces.hpp"
#include "check/pose_fit.hpp"
#include "check/pose_mistakes.hpp"
#include "check/scan_times.hpp"
#include "dynamic_filter/parallel.hpp"
#include "tracking/beginning.hpp"
#include "tracking/overlay_blur.hpp"

namespace dynamic_filter::io {
namespace {

// Number of places, and of consecutive scans at each.
constexpr std::size_t kPlaces = 5, kInARow = 21;
constexpr std::array<std::size_t, 4> kErrorsApart = {1, 5, 10, 20};

/// The velocity at the first scan.
std::optional<Twist> velocity_at_first(const Piece& piece, const OdometryConfig& config) {
    return initial_velocity(std::span(piece).first(std::min(piece.size(), kBeginning)), config);
}

std::vector<Tracked> track(const Piece& piece, const OdometryConfig& config,
                           const std::optional<Twist>& velocity) {
    Odometry odometry(config);
    std::vector<Tracked> tracked;
    for (const Scan& scan : piece) {
        std::optional<Pose> guess;
        if (velocity && tracked.size() == 1) {
            guess = exp(*velocity * (scan.stamp - piece.front().stamp));
        }
        tracked.push_back(odometry.track(scan.points, scan.times, scan.stamp, guess));
        odometry.learn({});
    }
    return tracked;
}

std::vector<Pose> poses_of(const std::vector<Tracked>& tracked) {
    std::vector<Pose> poses;
    for (const Tracked& t : tracked) poses.push_back(t.T_world_sensor);
    return poses;
}

/// Blur [m] of the scans at the poses of the odometry.
double blur(const Piece& piece, const std::vector<Tracked>& tracked, const OdometryConfig& config) {
    return overlay_blur(piece, poses_of(tracked), config);
}

/// Distance [m] by which the motion of the sensor during a scan displaces points at a range of 10
/// m.
double distortion(const Twist& velocity, double duration) {
    return duration * (velocity.head<3>().norm() + 10.0 * velocity.tail<3>().norm());
}

double median_distortion(const std::vector<Tracked>& tracked, double duration) {
    std::vector<double> shifts;
    for (const Tracked& t : tracked) shifts.push_back(distortion(t.velocity, duration));
    return median(std::move(shifts));
}

/// Poses of consecutive scans: as given, and as estimated from the scans.
struct Compared {
    std::vector<double> stamps;
    std::vector<Pose> given, shown;
    Blur at_given, at_shown;
    double given_overlay = 0.0, shown_overlay = 0.0;  // 0..1: see PoseFit
    double weak = 0.0;                                // 0..1: see MotionQuality
};

double share_of_weak(const std::vector<Tracked>& tracked) {
    const auto count = std::count_if(tracked.begin(), tracked.end(), [](const Tracked& t) {
        return t.status == TrackStatus::weak;
    });
    return static_cast<double>(count) / static_cast<double>(tracked.size());
}

/// What is compared: where the sensor went, and also how well the scans overlay.
enum class Compare { ways, all };

Compared compare(Piece piece, const OdometryConfig& config, Compare what = Compare::all) {
    Compared compared;
    const bool has_times = std::all_of(piece.begin(), piece.end(),
                                       [](const Scan& scan) { return !scan.times.empty(); });
    const bool has_poses = piece.front().has_pose;
    compared.given = given_poses(piece);
    for (const Scan& scan : piece) compared.stamps.push_back(scan.stamp);
    const std::optional<Twist> velocity = velocity_at_first(piece, config);
    if (what == Compare::ways && !has_times) {
        const std::vector<Tracked> tracked = track(thinned_piece(piece, config), config, velocity);
        compared.shown = poses_of(tracked);
        compared.weak = share_of_weak(tracked);
        return compared;
    }
    const std::vector<Points> upright = upright_of(piece);
    piece = thinned_piece(piece, config);
    const auto look = [&](double Blur::*which) {
        const std::vector<Tracked> tracked = track(piece, config, velocity);
        const std::vector<Pose> shown = poses_of(tracked);
        const PoseFit at_shown = fit_of(piece, upright, shown, config);
        compared.at_shown.*which = at_shown.blur;
        const bool best = at_shown.blur == compared.at_shown.least();
        if (best) {
            compared.shown = shown;
            compared.shown_overlay = at_shown.mean_overlay();
            compared.weak = share_of_weak(tracked);
        }
        if (!has_poses) return;
        const PoseFit at_given = fit_of(piece, upright, compared.given, config);
        compared.at_given.*which = at_given.blur;
        if (best) compared.given_overlay = at_given.mean_overlay();
    };
    if (has_times) look(&Blur::undone);
    for (Scan& scan : piece) scan.times.clear();
    look(&Blur::as_measured);
    return compared;
}

/// Errors for all pairs of scans with this separation.
std::vector<PoseError> errors_of(const std::vector<Compared>& pieces, std::size_t apart) {
    std::vector<PoseError> errors;
    for (const Compared& piece : pieces) {
        const auto& [given, shown] = std::tie(piece.given, piece.shown);
        for (std::size_t i = apart; i < shown.size(); ++i) {
            const Pose moved = shown[i - apart].inverse() * shown[i];
            const Twist off = log(moved.inverse() * given[i - apart].inverse() * given[i]);
            errors.push_back(
                {apart, moved.translation().norm(), off.head<3>().norm(), off.tail<3>().norm()});
        }
    }
    return errors;
}

double median_of(const std::vector<PoseError>& errors, double PoseError::*which) {
    std::vector<double> values;
    for (const PoseError& error : errors) values.push_back(error.*which);
    return median(std::move(values));
}

std::optional<PoseError> typical_error(const std::vector<Compared>& pieces, std::size_t apart) {
    const std::vector<PoseError> errors = errors_of(pieces, apart);
    if (errors.empty()) return std::nullopt;
    return PoseError{apart, median_of(errors, &PoseError::way),
                     median_of(errors, &PoseError::shift), median_of(errors, &PoseError::turn)};
}

/// See MotionQuality::nearly_right.
bool nearly_right(const std::vector<Compared>& pieces) {
    constexpr double kShift = 1.0, kShare = 0.3, kTurn = 0.1;  // [m], share of the distance, [rad]
    const std::vector<PoseError> errors = errors_of(pieces, kErrorsApart.back());
    const auto is_small = [&](const PoseError& error) {
        return error.shift <= std::max(kShift, kShare * error.way) && error.turn <= kTurn;
    };
    return !errors.empty() && std::all_of(errors.begin(), errors.end(), is_small);
}

std::vector<Compared> compare_places(const Recording& recording, std::size_t places,
                                     std::size_t in_a_row, const OdometryConfig& config,
                                     Compare what) {
    std::vector<Piece> pieces = read_pieces(recording, places, in_a_row);
    std::vector<Compared> compared(pieces.size());
    parallel_for(pieces.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            compared[k] = compare(std::move(pieces[k]), config, what);
        }
    });
    return compared;
}

MotionQuality quality_of(const std::vector<Compared>& compared, bool has_poses) {
    MotionQuality quality;
    const double share = 1.0 / static_cast<double>(compared.size());
    for (const Compared& piece : compared) {
        for (double Blur::*which : {&Blur::as_measured, &Blur::undone}) {
            quality.given.*which += share * piece.at_given.*which;
            quality.found.*which += share * piece.at_shown.*which;
        }
        quality.given_overlay += share * piece.given_overlay;
        quality.found_overlay += share * piece.shown_overlay;
        quality.weak += share * piece.weak;
    }
    quality.nearly_right = has_poses && nearly_right(compared);
    for (const std::size_t apart : kErrorsApart) {
        if (!has_poses) break;
        if (const auto error = typical_error(compared, apart)) quality.errors.push_back(*error);
    }
    return quality;
}

/// Consecutive scans without times, thinned out, and what the odometry makes of them.
struct Followed {
    Piece piece;
    std::vector<Tracked> tracked;
    double blur = 0.0;  // [m]
};

Piece part_of(const Piece& piece, std::size_t begin, std::size_t end) {
    const auto at = [&](std::size_t i) { return piece.begin() + static_cast<std::ptrdiff_t>(i); };
    return {at(begin), at(end)};
}

/// In a short recording, a sweep may look better by chance. A real one makes the map of each half
/// of the scans sharper.
bool sharpens_both_halves(const Piece& swept, const Followed& without,
                          const OdometryConfig& config) {
    const std::size_t middle = swept.size() / 2;
    for (const std::size_t first : {std::size_t{0}, middle}) {
        const std::size_t end = first == 0 ? middle : swept.size();
        const Twist& velocity = without.tracked[std::max<std::size_t>(first, 1)].velocity;
        const auto blur_of = [&](const Piece& piece) {
            const Piece half = part_of(piece, first, end);
            return blur(half, track(half, config, velocity), config);
        };
        if (!(blur_of(swept) < blur_of(without.piece))) return false;
    }
    return true;
}

Piece without_times(Piece piece) {
    for (Scan& scan : piece) scan.times.clear();
    return piece;
}

/// The scans with times by the sweep, thinned out.
Piece swept(Piece piece, const Sweep& sweep, const OdometryConfig& config) {
    for (Scan& scan : piece) scan.times = sweep_times(scan.points, sweep);
    return thinned_piece(piece, config);
}

/// The sweep by which the scans are sharpest at the poses that were found without any.
Sweep sharpest_of(const std::vector<Sweep>& sweeps, const Piece& piece, const Followed& without,
                  const OdometryConfig& config) {
    std::vector<double> blurs(sweeps.size());
    parallel_for(sweeps.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            blurs[k] = blur(swept(piece, sweeps[k], config), without.tracked, config);
        }
    });
    return sweeps[static_cast<std::size_t>(std::min_element(blurs.begin(), blurs.end()) -
                                           blurs.begin())];
}

/// True if a run would replace the poses, because other ones make the scans overlay better.
bool would_be_replaced(MotionLook& look) {
    if (!look.quality().has_bad_poses()) return false;
    return !choose_poses(look.recording(), look.config(), false, {}).tracked.empty();
}

/// True if scans overlay more sharply at the other poses than at their own; all are parallel.
bool sharpens(const std::vector<Piece>& pieces, const std::vector<std::vector<Pose>>& others,
              const OdometryConfig& config) {
    double own = 0.0, other = 0.0;
    for (std::size_t k = 0; k < pieces.size(); ++k) {
        const Piece piece = thinned_piece(pieces[k], config);
        own += overlay_blur(piece, given_poses(piece), config);
        other += overlay_blur(piece, others[k], config);
    }
    return other < own;
}

}  // namespace

std::optional<Sweep> find_sweep(const Recording& recording, const OdometryConfig& given) {
    OdometryConfig config = given;
    config.points = std::min(config.points, 1500);  // fewer points, because this takes long
    constexpr double kClearly = 0.988;  // factor of the blur that counts as clearly better
    const double duration = usual_step(recording);
    if (!(duration > 0.0) || duration > kLongestSweep) return std::nullopt;
    const std::vector<Piece> pieces = read_pieces(recording, 3, kInARow);
    const Piece* fastest = nullptr;
    Twist fastest_velocity;
    double most_distorted = 0.0;
    for (const Piece& piece : pieces) {
        const auto velocity = velocity_at_first(piece, config);
        if (!velocity || possible_sweeps(piece.front().points, duration).empty()) continue;
        const double distorted = distortion(*velocity, duration);
        if (distorted <= most_distorted) continue;
        most_distorted = distorted;
        fastest = &piece;
        fastest_velocity = *velocity;
    }
    if (fastest == nullptr) return std::nullopt;
    Followed without{thinned_piece(without_times(*fastest), config), {}};
    without.tracked = track(without.piece, config, fastest_velocity);
    if (median_distortion(without.tracked, duration) < kLeastDistortion) return std::nullopt;
    without.blur = blur(without.piece, without.tracked, config);
    const Twist velocity = without.tracked[1].velocity;  // of the first scan, nearly
    const auto helps = [&](const Sweep& sweep) {
        const Piece piece = swept(*fastest, sweep, config);
        return blur(piece, track(piece, config, velocity), config) <= kClearly * without.blur &&
               sharpens_both_halves(piece, without, config);
    };
    std::vector<Sweep> sweeps = possible_sweeps(fastest->front().points, duration);
    // The order of points tells times more surely than their azimuths do.
    if (sweeps.front().in_order) {
        if (helps(sweeps.front())) return sweeps.front();
        sweeps.erase(sweeps.begin());
    }
    const Sweep best = sharpest_of(sweeps, *fastest, without, config);
    return helps(best) ? std::optional(best) : std::nullopt;
}

double Blur::least() const {
    return undone > 0.0 ? std::min(undone, as_measured > 0.0 ? as_measured : undone) : as_measured;
}

bool Blur::is_distorted() const {
    constexpr double kClearly = 0.995;
    return undone > 0.0 && undone < kClearly * as_measured;
}

bool MotionQuality::has_bad_poses() const {
    constexpr double kClearly = 1.1;
    constexpr double kAsMuch = 0.97;  // factor of the overlay
    return shows_motion() && given.least() > kClearly * found.least() &&
           found_overlay > kAsMuch * given_overlay;
}

bool MotionQuality::shows_motion() const {
    constexpr double kMany = 0.3;
    return weak < kMany;
}

MotionQuality measure_motion(const Recording& recording, const OdometryConfig& config) {
    return quality_of(compare_places(recording, kPlaces, kInARow, config, Compare::all),
                      recording.info().has_poses);
}

MotionQuality measure_motion_at(const Recording& recording, std::size_t scan,
                                const OdometryConfig& config) {
    const std::size_t most = recording.size() - std::min(recording.size(), kInARow);
    Piece piece =
        read_piece(recording, std::min(most, scan - std::min(scan, kInARow / 2)), kInARow);
    if (piece.size() < 2) return {};
    return quality_of({compare(std::move(piece), config)}, recording.info().has_poses);
}

std::string find_pose_mistake(const Recording& recording, const OdometryConfig& config) {
    MotionLook look(recording, config, "off");
    return find_pose_mistake(look);
}

std::string find_pose_mistake(MotionLook& look) {
    const Recording& recording = look.recording();
    const OdometryConfig& config = look.config();
    // Number of consecutive scans; long enough that the motion varies.
    constexpr std::size_t kLong = 60;
    std::vector<Compared> compared = compare_places(recording, 3, kLong, config, Compare::ways);
    if (compared.empty() || !recording.info().has_poses) return "";
    if (!quality_of(compared, true).shows_motion()) return "";
    std::vector<TwoTracks> tracks;
    for (Compared& piece : compared) {
        tracks.push_back({std::move(piece.stamps), std::move(piece.given), std::move(piece.shown)});
    }
    if (would_be_replaced(look)) return name_mistake(tracks);
    // The odometry may be wrong as well: the scans decide.
    const ConstantMistake mistake = find_constant_mistake(tracks);
    const bool is_shown =
        !mistake.text.empty() && sharpens(read_pieces(recording, 3, kLong), mistake.mended, config);
    return is_shown ? mistake.text : "";
}

}  // namespace dynamic_filter::io
