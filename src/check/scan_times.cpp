// SPDX-License-Identifier: MIT
#include "check/scan_times.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/numbers.hpp"
#include "check/pieces.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/parallel.hpp"
#include "geometry/scan_order.hpp"
#include "tracking/overlay_blur.hpp"

namespace dynamic_filter::io {
namespace {

/// True if the points cover all directions, as those of a rotating sensor do.
bool turns(const Points& points) {
    constexpr std::size_t kSectors = 16, kMostEmpty = 3;
    std::array<bool, kSectors> seen{};
    for (const Point& p : points) {
        const double turned = std::atan2(p.y(), p.x()) / (2.0 * std::numbers::pi) + 0.5;
        const auto sector = static_cast<std::size_t>(turned * kSectors);
        if (is_measured(p)) seen[std::min(sector, kSectors - 1)] = true;
    }
    return std::count(seen.begin(), seen.end(), false) <= std::ptrdiff_t{kMostEmpty};
}

/// Blur [m] of the recording's scans at its poses, by place.
using Blurs = std::vector<double>;

constexpr std::size_t kManyPlaces = 5, kFewInARow = 9;

double blur_of(const Piece& piece, const OdometryConfig& config) {
    return overlay_blur(piece, given_poses(piece), config);
}

Blurs blurs_of(const Recording& recording, const OdometryConfig& config) {
    const std::vector<Piece> pieces = read_pieces(recording, kManyPlaces, kFewInARow);
    Blurs blurs(pieces.size());
    parallel_for(pieces.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) blurs[k] = blur_of(pieces[k], config);
    });
    return blurs;
}

/// Geometric mean; 0 if nothing could be compared.
double mean_of(const Blurs& blurs) {
    double sum = 0.0;
    for (const double blur : blurs) {
        if (!(blur > 0.0)) return 0.0;
        sum += std::log(blur);
    }
    return blurs.empty() ? 0.0 : std::exp(sum / static_cast<double>(blurs.size()));
}

constexpr double kLessSharp = 1.01;  // factor of the blur that counts as clearly less sharp
constexpr double kMuch = 0.98;       // factor of the blur that counts as much sharper

/// True if scans are sharper as a whole by this factor, and nowhere clearly less sharp, so that it
/// is no chance.
bool is_sharper(const Blurs& blurs, const Blurs& than, double factor) {
    if (blurs.size() != than.size() || !(mean_of(blurs) < factor * mean_of(than))) return false;
    for (std::size_t k = 0; k < blurs.size(); ++k) {
        if (blurs[k] > kLessSharp * than[k]) return false;
    }
    return true;
}

/// A way to tell times, and how the scans look with the motion undone by it.
struct Tried {
    Sweep sweep;
    Blurs blurs;
};

Tried tried(const Recording& recording, const OdometryConfig& config, const Sweep& sweep) {
    return {sweep, blurs_of(deskewed(recording, sweep), config)};
}

/// The first one, unless another one is clearly sharper.
const Tried& best_of(const std::vector<Tried>& all) {
    constexpr double kSharperThanFirst = 0.995;
    const Tried& best = *std::min_element(
        all.begin(), all.end(),
        [](const Tried& a, const Tried& b) { return mean_of(a.blurs) < mean_of(b.blurs); });
    const Tried& first = all.front();
    return mean_of(best.blurs) < kSharperThanFirst * mean_of(first.blurs) ? best : first;
}

/// Times of fields as they are, unless a shift is sharper everywhere, and also much sharper than
/// with the motion left in: among things that drive beside the sensor, little tells of shifts.
const Tried& best_shift_of(const std::vector<Tried>& all, const Blurs& as_measured) {
    constexpr double kClearly = 0.99;
    const Tried& best = best_of(all);
    const bool is_sure = is_sharper(best.blurs, all.front().blurs, kClearly) &&
                         mean_of(best.blurs) < kMuch * mean_of(as_measured);
    return is_sure ? best : all.front();
}

/// Times of the fields of the first scan [s], or none.
std::vector<float> times_in_fields(const Recording& recording) {
    try {
        return with_times(recording).read(0).times;
    } catch (const InputError&) {
        return {};
    }
}

/// Shifts [s] of times of fields: none, and those that put the stamp at their begin, middle, end.
std::vector<double> shifts_of(const std::vector<float>& times) {
    constexpr double kAlike = 0.1;  // share of the duration
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (const float time : times) {
        if (!std::isfinite(time)) continue;
        least = std::min<double>(least, time);
        most = std::max<double>(most, time);
    }
    std::vector<double> shifts = {0.0};
    for (const double zero : {least, 0.5 * (least + most), most}) {
        if (std::abs(zero) > kAlike * (most - least)) shifts.push_back(-zero);
    }
    return shifts;
}

/// Distance [m] by which the motion from scan i - 1 to scan i displaces points at a range of 10 m.
std::optional<double> displacement(const std::vector<Pose>& poses, std::size_t i) {
    if (!poses[i].matrix().allFinite() || !poses[i - 1].matrix().allFinite()) {
        return std::nullopt;
    }
    const Twist moved = log(poses[i - 1].inverse() * poses[i]);
    return moved.head<3>().norm() + 10.0 * moved.tail<3>().norm();
}

/// The same during a scan, as given.
double given_distortion(const Recording& recording) {
    const std::vector<Pose>& poses = recording.info().T_world_sensor;
    std::vector<double> shifts;
    for (std::size_t i = 1; i < poses.size(); ++i) {
        if (const auto shift = displacement(poses, i)) shifts.push_back(*shift);
    }
    if (shifts.empty()) return 0.0;
    // Not the median, because a vehicle may rest for half of the time.
    const auto at = shifts.begin() + static_cast<std::ptrdiff_t>(shifts.size() * 3 / 4);
    std::nth_element(shifts.begin(), at, shifts.end());
    return *at;
}

/// First scan of the place at which the sensor moves most.
std::size_t liveliest_place(const Recording& recording) {
    const std::vector<Pose>& poses = recording.info().T_world_sensor;
    const auto motion_at = [&](std::size_t first) {
        double sum = 0.0;
        const std::size_t end = std::min(first + kFewInARow, poses.size());
        for (std::size_t i = first + 1; i < end; ++i) sum += displacement(poses, i).value_or(0.0);
        return sum;
    };
    const auto places = first_scans(recording.size(), kManyPlaces, kFewInARow);
    return *std::max_element(places.begin(), places.end(), [&](std::size_t a, std::size_t b) {
        return motion_at(a) < motion_at(b);
    });
}

/// Leaves the sweeps that may be what happened: with the motion undone by these, scans are not
/// clearly less sharp where the sensor moves most.
void leave_possible(std::vector<Sweep>& sweeps, const Recording& recording,
                    const OdometryConfig& config) {
    const std::size_t first = liveliest_place(recording);
    const auto blur_by = [&](const Recording& r) {
        return blur_of(read_piece(r, first, kFewInARow), config);
    };
    const double as_measured = blur_by(recording);
    std::erase_if(sweeps, [&](const Sweep& sweep) {
        return blur_by(deskewed(recording, sweep)) > kLessSharp * as_measured;
    });
}

std::vector<Tried> try_fields(const Recording& recording, const OdometryConfig& config,
                              const std::vector<float>& times) {
    std::vector<Tried> all;
    for (const double shift : shifts_of(times)) {
        all.push_back(tried(recording, config, {.shift = shift}));
    }
    return all;
}

/// The stamp is in the middle, at the begin, or at the end. The latter two are tried only if the
/// first one helps.
std::vector<Tried> try_sweeps(const Recording& recording, const OdometryConfig& config,
                              std::vector<Sweep> sweeps, const Blurs& as_measured) {
    std::vector<Tried> middles;
    for (const Sweep& sweep : sweeps) middles.push_back(tried(recording, config, sweep));
    const Tried& middle = best_of(middles);
    if (!(mean_of(middle.blurs) < mean_of(as_measured))) return {middle};
    std::vector<Tried> all;
    for (const double share : {0.5, 0.0, -0.5}) {
        Sweep sweep = middle.sweep;
        sweep.shift = share * sweep.duration;
        all.push_back(share == 0.0 ? middle : tried(recording, config, sweep));
    }
    return all;
}

/// True if the scans were measured during this sweep. In few scans, points that are moved to and
/// fro may look sharper by chance, whichever way they are moved. So a sweep that runs backwards,
/// which doubles the motion instead of undoing it, must make them less sharp.
bool is_shown(const Recording& recording, const OdometryConfig& config, const Tried& forwards,
              const Blurs& as_measured) {
    if (!is_sharper(forwards.blurs, as_measured, 1.0)) return false;
    Sweep sweep = forwards.sweep;
    sweep.duration = -sweep.duration;
    const double backwards = mean_of(tried(recording, config, sweep).blurs);
    return backwards > mean_of(as_measured) && mean_of(forwards.blurs) < kMuch * backwards;
}

std::vector<Sweep> sweeps_to_try(const Recording& recording, bool asks_more) {
    const double duration = usual_step(recording);
    if (!(duration > 0.0) || duration > kLongestSweep) return {};
    if (!asks_more && given_distortion(recording) < kLeastDistortion) return {};
    try {
        std::vector<Sweep> sweeps = possible_sweeps(recording.read(0).points, duration);
        if (!sweeps.empty() && sweeps.front().in_order && !asks_more) sweeps.resize(1);
        return sweeps;
    } catch (const InputError&) {
        return {};
    }
}

}  // namespace

double usual_step(const Recording& recording) {
    std::vector<double> steps;
    for (std::size_t i = 1; i < recording.size(); ++i) {
        steps.push_back(recording.info().stamps[i] - recording.info().stamps[i - 1]);
    }
    return median(std::move(steps));
}

std::vector<Sweep> possible_sweeps(const Points& points, double duration) {
    if (!turns(points)) return {};
    std::vector<Sweep> sweeps;
    if (!order_shares(points).empty()) sweeps.push_back({.duration = duration, .in_order = true});
    for (const bool clockwise : {false, true}) {
        for (int quarter = 0; quarter < 4; ++quarter) {
            sweeps.push_back({clockwise, quarter * 0.5 * std::numbers::pi, duration});
        }
    }
    return sweeps;
}

TimesChoice choose_times(const Recording& recording, const OdometryConfig& config, bool asks_more) {
    TimesChoice choice;
    const std::vector<float> times = times_in_fields(recording);
    std::vector<Sweep> sweeps;
    if (times.empty()) {
        sweeps = sweeps_to_try(recording, asks_more);
        if (!asks_more && !sweeps.empty()) leave_possible(sweeps, recording, config);
    }
    if (times.empty() && sweeps.empty()) return choice;
    const Blurs as_measured = blurs_of(recording, config);
    const std::vector<Tried> all = times.empty()
                                       ? try_sweeps(recording, config, sweeps, as_measured)
                                       : try_fields(recording, config, times);
    const Tried& best = times.empty() ? best_of(all) : best_shift_of(all, as_measured);
    choice.blur = {mean_of(as_measured), mean_of(best.blurs)};
    const bool is_sure =
        times.empty() ? is_shown(recording, config, best, as_measured) : choice.blur.is_distorted();
    if (is_sure || (asks_more && choice.blur.is_distorted())) choice.sweep = best.sweep;
    return choice;
}

}  // namespace dynamic_filter::io
