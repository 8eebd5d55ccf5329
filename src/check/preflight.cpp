// SPDX-License-Identifier: MIT
#include "dynamic_filter/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>

#include "base/numbers.hpp"
#include "check/choose_poses.hpp"
#include "check/motion_look.hpp"
#include "check/overlay.hpp"
#include "check/rig_fit.hpp"
#include "check/rotation_parts.hpp"
#include "check/samples.hpp"
#include "check/scan_times.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/poses.hpp"
#include "recording/recording_parts.hpp"

namespace dynamic_filter::io {
namespace {

constexpr const char* kOtherPoses =
    "check that the poses are of this recording, of the same times, and of the sensor, not of the "
    "vehicle that carries it; give other poses with --poses, or --poses none, which finds them";

double share_of(const std::vector<Overlay>& overlays, const std::string& reading) {
    const auto found = std::find_if(overlays.begin(), overlays.end(),
                                    [&](const Overlay& o) { return o.reading == reading; });
    return found == overlays.end() ? 0.0 : found->share;
}

/// True if the difference is clearly more than chance and moving objects explain.
bool clearly_better(double share, double than) { return share > 1.1 * than + 0.02; }

bool all_equal(const Samples& samples) {
    return std::all_of(samples.begin(), samples.end(), [&](const auto& sample) {
        return sample.second.T_world_sensor.isApprox(samples.begin()->second.T_world_sensor, 1e-9);
    });
}

/// True if the points are in the world frame: then the ground is near the poses, not near the
/// origin.
bool lie_in_world(const Samples& samples) {
    constexpr double kAway = 10.0;  // [m]
    std::size_t near_origin = 0, near_pose = 0;
    for (const auto& [i, sample] : samples) {
        if (sample.T_world_sensor.translation().norm() < kAway) continue;
        near_origin += sample.near_origin;
        near_pose += sample.near_pose;
    }
    return near_pose > 2 * near_origin + 100;
}

/// [m] How far the surroundings move between scans that lie on each other without any motion, as
/// those do whose points are in the world's frame; 0 if odometry finds a motion.
double motion_of_surroundings(const Samples& samples) {
    constexpr double kRests = 2.0;  // [m]
    double moved = 0.0;
    for (const auto& [i, sample] : samples) {
        const Sample& first = samples.begin()->second;
        const Pose way = first.T_world_sensor.inverse() * sample.T_world_sensor;
        if (way.translation().norm() > kRests) return 0.0;
        moved = std::max(moved, static_cast<double>((sample.middle - first.middle).norm()));
    }
    return moved;
}

/// A finding if points without poses are in the world's frame. Returns true if there is one.
bool judge_frame(Preflight& result, const Recording& recording, const Samples& samples) {
    constexpr double kFar = 4.0;  // [m] that no passing vehicle moves the middle of a scan
    const double moved = recording.info().tracked ? motion_of_surroundings(samples) : 0.0;
    if (moved < kFar) return false;
    result.findings.push_back(
        {fmt::format("the points are in the world's frame already: scans lie on each other as they "
                     "are, but what they show moves by {:.1f} m, so the places of the sensor are "
                     "not known",
                     moved),
         "give the trajectory with --poses FILE and --points-in-world, or the scans in the "
         "sensor's frame"});
    return true;
}

/// True if the format says in which order the components of quaternions are.
bool names_quaternions(const Recording& recording) {
    return recording.info().layout == "bag" || recording.info().pose_source.extension() == ".csv";
}

void leave_out_quaternions(std::vector<Overlay>& overlays) {
    std::erase_if(overlays,
                  [](const Overlay& o) { return o.reading == "wxyz" || o.reading == "xyzw"; });
}

/// True if scans show enough upright structures to be compared.
bool have_structure(const Samples& samples) {
    return std::count_if(samples.begin(), samples.end(), [](const auto& sample) {
               constexpr std::size_t kEnough = 200;
               return sample.second.upright.size() > kEnough;
           }) > 1;
}

/// True if the sensor would be upside down; sensors of ground robots are upright.
bool hang_upside_down(const Samples& samples, const Reading& reading) {
    return std::all_of(samples.begin(), samples.end(), [&](const auto& sample) {
        return pose_of(sample.second, reading)(2, 2) < -0.5;
    });
}

std::string meaning_of(const std::string& reading) {
    static const std::map<std::string, std::string> meanings = {
        {"inverse", "the poses are inverse (T_sensor_world)"},
        {"camera", "the poses are a camera's, not the LiDAR's"},
        {"lidar", "the poses are the LiDAR's already, but calib.txt makes them a camera's"},
        {"wxyz", "the quaternions are w x y z, but were read as x y z w"},
        {"xyzw", "the quaternions are x y z w, but were read as w x y z"},
        {"mm", "the poses are in millimetres"},
        {"cm", "the poses are in centimetres"},
        {"feet", "the poses are in feet"},
        {kPointsInFeet, "the points are in feet, the poses in metres"},
        {"transpose",
         "the rotations turn in the wrong sense (R_sensor_world); positions are right"},
        {"mirror", "the poses are left-handed: y points to the right, and yaw turns clockwise"},
        {"ned", "the poses have z down and y to the right (north, east, down)"},
        {"relative", "each pose is the motion since the scan before, and no place in the world"},
    };
    return meanings.at(reading);
}

std::string fits_better(const std::vector<Overlay>& overlays, const std::string& reading) {
    return fmt::format("scans overlay by {:.0f} % this way, by {:.0f} % as given",
                       100.0 * share_of(overlays, reading), 100.0 * share_of(overlays, kAsGiven));
}

Finding pose_finding(const std::vector<Overlay>& overlays, const std::string& reading) {
    const bool is_of_points = reading == kPointsInFeet;
    return {meaning_of(reading) + ": " + fits_better(overlays, reading),
            is_of_points ? "--point-unit feet" : "--pose-fix " + reading};
}

/// True if scans far apart overlay as well as neighbors do, because the sensor stands still.
bool stands_still(const Samples& samples, const std::vector<Pair>& pairs) {
    std::vector<Pair> near, far;
    for (const Pair& pair : pairs) (pair.apart == kApart.front() ? near : far).push_back(pair);
    return share_of(compare(samples, far), kInWorld) >
           0.8 * share_of(compare(samples, near), kInWorld);
}

/// A finding if displacements of the scans improve their overlay, which is impossible with correct
/// poses.
std::optional<Finding> misfit(const Samples& samples, const std::vector<Pair>& pairs) {
    std::vector<double> given, best, offset;
    for (const Pair& pair : pairs) {
        const auto a = samples.find(pair.from), b = samples.find(pair.from + pair.apart);
        if (pair.apart != kApart[1] || a == samples.end() || b == samples.end()) continue;
        const Search search = search_around(a->second, b->second);
        given.push_back(search.given);
        best.push_back(search.best);
        offset.push_back(search.offset);
    }
    constexpr double kFar = 0.7;  // [m]
    if (given.empty() || median(offset) < kFar || median(best) < 1.5 * median(given) + 0.02) {
        return std::nullopt;
    }
    return Finding{
        fmt::format("the poses do not fit the scans: those {} scans apart overlay by "
                    "{:.0f} %, but by {:.0f} % if moved by {:.1f} m",
                    kApart[1], 100.0 * median(given), 100.0 * median(best), median(offset)),
        kOtherPoses};
}

/// On a straight path, several interpretations overlay equally well. Then the one in which the
/// sensor is upright is right.
void judge_upside_down(Preflight& result, const Samples& samples) {
    const auto& all = readings();
    if (!hang_upside_down(samples, all.front())) return;
    for (const PoseFix fix : pose_fixes()) {
        const std::string name = to_string(fix);
        const auto reading =
            std::find_if(all.begin(), all.end(), [&](const Reading& r) { return r.name == name; });
        const bool alike =
            share_of(result.overlays, name) > 0.97 * share_of(result.overlays, kAsGiven);
        if (!alike || hang_upside_down(samples, *reading)) continue;
        Finding finding = pose_finding(result.overlays, name);
        finding.what += ", but then the sensor would hang upside down";
        result.findings.push_back(std::move(finding));
        return;
    }
}

/// Finding: points are in the sensor frame, although the format or an option says world frame.
Finding in_sensor_finding(const std::vector<Overlay>& overlays, bool files_in_world) {
    if (files_in_world) {
        return {"the points are in the sensor's frame, but this format has them in the world's: " +
                    fits_better(overlays, kInSensor),
                "give --format folder, and a pose file with --poses"};
    }
    return {"the points are in the sensor's frame, not in the world's: " +
                fits_better(overlays, kInSensor),
            "leave out --points-in-world"};
}

/// `nearly_right` is called before poses are reported as wrong as a whole: if the sensor hardly
/// moves, drifting poses overlay better under every interpretation.
void judge_poses(Preflight& result, const Recording& recording, const Samples& samples,
                 const std::vector<Pair>& pairs, const std::function<bool()>& nearly_right) {
    const auto& overlays = result.overlays;
    const double given = share_of(overlays, kAsGiven);
    if (all_equal(samples)) {
        if (stands_still(samples, pairs)) return;
        result.findings.push_back({"all poses are equal, but the scans show that the sensor moves",
                                   "give the trajectory with --poses FILE, which scans in the "
                                   "world's frame need as well; "
                                   "--poses none finds it for scans in the sensor's frame"});
        return;
    }
    const bool files_in_world = recording.info().layout == "benchmark";
    const bool may_be_in_world = share_of(overlays, kInWorld) > given;
    if (!files_in_world && may_be_in_world && lie_in_world(samples)) {
        result.findings.push_back(
            {"the points are in the world's frame already: " + fits_better(overlays, kInWorld),
             "--points-in-world"});
        return;
    }
    const auto best =
        std::max_element(overlays.begin(), overlays.end(),
                         [](const Overlay& a, const Overlay& b) { return a.share < b.share; });
    const bool much = clearly_better(best->share, given);
    constexpr double kNothing = 0.02;
    if (best->share < kNothing && have_structure(samples)) {
        result.findings.push_back(
            {fmt::format("the scans do not overlay, however the poses are read ({:.0f} %)",
                         100.0 * best->share),
             kOtherPoses});
        return;
    }
    if (best->reading == kAsGiven) {
        judge_upside_down(result, samples);
        return;
    }
    if (best->reading == kInSensor && (files_in_world || recording.info().points_in_world)) {
        if (much) result.findings.push_back(in_sensor_finding(overlays, files_in_world));
        return;
    }
    // If poses are read as mm or cm, hardly anything of the given motion is left, which is nearly
    // the same as no motion. Such a reading must explain clearly more.
    const bool is_scale = best->reading == "mm" || best->reading == "cm";
    const bool as_if_still = best->share < (is_scale ? 1.1 : 1.02) * share_of(overlays, kInWorld);
    if (as_if_still || best->reading == kInSensor) {
        if (much && !nearly_right()) {
            result.findings.push_back(
                {"the poses do not fit the scans: " + fits_better(overlays, best->reading) +
                     (as_if_still ? "; the first value assumes that the sensor does not move"
                                  : "; the first value assumes that it goes twice as far"),
                 kOtherPoses});
        }
        return;
    }
    const auto& all = readings();
    const auto& as_best = *std::find_if(all.begin(), all.end(),
                                        [&](const Reading& r) { return r.name == best->reading; });
    const bool upright_instead =
        hang_upside_down(samples, all.front()) && !hang_upside_down(samples, as_best);
    if (upright_instead || (much && !nearly_right())) {
        result.findings.push_back(pose_finding(overlays, best->reading));
    }
}

/// A finding if the scans of two sensors are merged. Returns true if there is one.
bool judge_sensors(Preflight& result, const Recording& recording) {
    const auto places = find_sensor_places(recording);
    if (places.size() < 2) return false;
    const auto& a = places.front();
    const auto& b = places.back();
    result.findings.push_back(
        {fmt::format(
             "the beams meet in two places, ({:.2f}, {:.2f}, {:.2f}) m and ({:.2f}, {:.2f}, "
             "{:.2f}) m from the origin of the points' frame: several sensors are merged "
             "into one scan",
             a.x(), a.y(), a.z(), b.x(), b.y(), b.z()),
         "use the scans of one sensor, each with its own pose"});
    return true;
}

void judge_points(Preflight& result, const Samples& samples) {
    constexpr double kSuspicious = 0.2;
    std::vector<double> doubled;
    for (const auto& [i, sample] : samples) doubled.push_back(sample.doubled);
    // Seen from another place, points naturally lie behind each other.
    if (doubled.empty() || lie_in_world(samples)) return;
    const double typical = median(std::move(doubled));
    if (typical < kSuspicious) return;
    result.findings.push_back(
        {fmt::format("{:.0f} % of the points that lie in one direction are at different ranges: "
                     "several sensors or several sweeps are merged into one scan",
                     100.0 * typical),
         "use the scans of one sensor, each with its own pose"});
}

/// A finding if the coordinates are no metres. Sensors of all kinds see less far than 500 m with
/// half of their beams. Returns true if there is one.
bool judge_unit(Preflight& result, const Samples& samples) {
    constexpr double kTooFar = 500.0, kNoLength = 1e7;  // [m]
    std::vector<double> ranges, middles;
    for (const auto& [i, sample] : samples) {
        ranges.push_back(sample.typical_range);
        middles.push_back(sample.middle.norm());
    }
    if (ranges.empty() || lie_in_world(samples)) return false;
    const double typical = median(std::move(ranges)), middle = median(std::move(middles));
    if (!(typical < kNoLength)) {
        result.findings.push_back(
            {"the coordinates of most points are no lengths, but numbers without any order: their "
             "bytes were read in the wrong way",
             "check the order of bytes, the type and the number of the fields of a point (in a "
             "bag: "
             "is_bigendian)"});
        return true;
    }
    if (typical < kTooFar) return false;
    const std::string far =
        fmt::format("half of the points lie more than {:.0f} m from the sensor", typical);
    // Around a sensor, points lie on all sides; seen from the origin of a world, on one.
    if (middle > 0.5 * typical) {
        result.findings.push_back({far + ", all in one direction: they are in the world's frame",
                                   "give the trajectory with --poses FILE and --points-in-world, "
                                   "or the scans in the sensor's frame"});
        return true;
    }
    // Half of the points of a scan lie within some tens of metres.
    const bool is_mm = typical > 4000.0;
    result.findings.push_back(
        {fmt::format("the points are in {}: {}", is_mm ? "millimetres" : "centimetres", far),
         std::string("--point-unit ") + (is_mm ? "mm" : "cm")});
    return true;
}

/// Far from the origin, numbers of type float32 are too far apart for what the filter looks for.
void judge_precision(Preflight& result, const Samples& samples, double unit) {
    constexpr double kCoarse = 0.03;  // [m]
    double step = 0.0;
    for (const auto& [i, sample] : samples) step = std::max(step, unit * sample.step);
    if (step < kCoarse) return;
    result.findings.push_back(
        {fmt::format("coordinates of type float32 are {:.2g} m apart so far from their origin, so "
                     "points are rounded by as much, and thin or slow things are lost",
                     step),
         "write the points as float64, or those and the poses relative to an origin close by"});
}

/// Scans and poses were matched by order, but both have stamps, which may contradict each other.
void judge_pose_stamps(Preflight& result, const Recording& recording, double step) {
    const auto& scans = recording.info().stamps;
    const auto& poses = recording.info().pose_stamps;
    if (poses.size() != scans.size()) return;
    const double ratio = (poses.back() - poses.front()) / (scans.back() - scans.front());
    for (const auto& [unit, seconds] : {std::pair{"ms", 1e-3}, {"us", 1e-6}, {"ns", 1e-9}}) {
        if (std::abs(ratio * seconds - 1.0) < 0.5) {
            result.findings.push_back(
                {fmt::format("the poses' stamps are in {}, those of the scans in s", unit),
                 "write the poses with stamps in seconds; here they were matched by order"});
            return;
        }
        if (std::abs(ratio / seconds - 1.0) < 0.5) {
            result.findings.push_back(
                {fmt::format("the scans' stamps are in {}, those of the poses in s", unit),
                 fmt::format("--time-unit {}", unit)});
            return;
        }
    }
    // A clock that begins at 0 cannot be compared with the other one.
    const bool relative = std::abs(scans.front()) < 1.0 || std::abs(poses.front()) < 1.0;
    std::vector<double> offsets;
    for (std::size_t i = 0; i < scans.size(); ++i) {
        offsets.push_back(poses[i] - scans[i] - (relative ? poses.front() - scans.front() : 0.0));
    }
    const double offset = median(std::move(offsets));
    if (std::abs(offset) < 0.75 * step) return;
    result.findings.push_back(
        {fmt::format("the poses' stamps are {:.3g} s {} those of the scans, which are {:.3g} s "
                     "apart; they were matched by order",
                     std::abs(offset), offset < 0.0 ? "before" : "after", step),
         kOtherPoses});
}

/// Times in whole seconds of scans that follow faster have the right unit, but tell no order.
bool are_whole_seconds(const std::vector<double>& steps, const std::vector<double>& stamps) {
    return stamps.front() == std::floor(stamps.front()) &&
           std::find(steps.begin(), steps.end(), 1.0) != steps.end() &&
           std::all_of(steps.begin(), steps.end(), [](double s) { return s == 0.0 || s == 1.0; });
}

void judge_stamps(Preflight& result, const Recording& recording) {
    if (!recording.info().measured_stamps || recording.size() < 3) return;
    std::vector<double> steps;
    for (std::size_t i = 1; i < recording.size(); ++i) {
        steps.push_back(recording.info().stamps[i] - recording.info().stamps[i - 1]);
    }
    const bool are_rounded = are_whole_seconds(steps, recording.info().stamps);
    const double step = median(std::move(steps));
    judge_pose_stamps(result, recording, step);
    constexpr double kLongest = 20.0, kShortest = 1e-3;  // [s] between scans
    if (step < kLongest && step > kShortest) return;
    if (are_rounded) {
        result.findings.push_back(
            {"the times of the scans were rounded to whole seconds, so several scans have the same",
             "write the times with their fractions, or leave them out"});
        return;
    }
    for (const auto& [unit, seconds] : {std::pair{"ms", 1e-3}, {"us", 1e-6}, {"ns", 1e-9}}) {
        if (step * seconds > 0.5 * kLongest || step * seconds < 10.0 * kShortest) continue;
        result.findings.push_back({fmt::format("the stamps are not in seconds: scans are {:.4g} "
                                               "apart, which is {:.3g} s if the unit is {}",
                                               step, step * seconds, unit),
                                   fmt::format("--time-unit {}", unit)});
        return;
    }
    result.findings.push_back({fmt::format("scans are {:.3g} s apart", step),
                               "check the stamps; they should be in seconds"});
}

/// Natural order puts "10.pcd" after "9.pcd"; the order of other names may not be that of time.
void judge_order(Preflight& result, const Recording& recording, const Samples& samples) {
    const auto unknown = [](const auto& sample) { return !sample.second.began; };
    if (recording.info().layout == "bag" || std::any_of(samples.begin(), samples.end(), unknown))
        return;
    const auto back = std::adjacent_find(
        samples.begin(), samples.end(),
        [](const auto& a, const auto& b) { return *b.second.began < *a.second.began; });
    if (back == samples.end()) return;
    const auto next = std::next(back);
    result.findings.push_back(
        {fmt::format("the order of the file names is not the order in time: by the times of its "
                     "points, {} was taken {:.3g} s before {}, whose name comes first",
                     recording.info().scan_files[next->first].filename().string(),
                     *back->second.began - *next->second.began,
                     recording.info().scan_files[back->first].filename().string()),
         "rename the scans, and their labels, so that their names sort by time"});
}

/// Findings about poses that are nearly right, and about motion during scans.
void judge_motion(Preflight& result, MotionLook& look) {
    const Recording& recording = look.recording();
    const Info& info = recording.info();
    std::string mistake = info.tracked ? "" : outliers_text(recording);
    if (mistake.empty() && !info.tracked) mistake = find_pose_mistake(look);
    if (!mistake.empty()) {
        result.findings.push_back({mistake,
                                   "`run` refines such poses of a single recording without being "
                                   "asked (as with --refine on), but not those of several; more "
                                   "accurate poses give better results"});
    }
    if (info.deskewed || info.tracked) return;
    const std::optional<Sweep>& sweep = look.times().sweep;
    const Blur blur = sweep ? Blur{} : look.quality().found;
    // At good poses, a run looks for no other times than look.times() did.
    const bool may_find = !mistake.empty() && !(blur.undone > 0.0);
    if (!sweep && !blur.is_distorted() && !(may_find && find_sweep(recording, look.config()))) {
        return;
    }
    const bool is_shifted = sweep && !sweep->in_order && sweep->shift != 0.0;
    result.notes.push_back(
        "the sensor's motion during each scan is still in the points: scans overlay better "
        "without it" +
        (is_shifted ? fmt::format(", most if the times of points are shifted by {:.0f} ms",
                                  1e3 * sweep->shift)
                    : "") +
        "; `run` undoes it");
}

/// Faults of all scans that show without reading the points.
std::map<std::size_t, std::string> find_unusable(const Recording& recording) {
    const Info& info = recording.info();
    std::map<std::size_t, std::string> unusable;
    for (std::size_t i = 0; i < recording.size(); ++i) {
        try {
            const bool has_pose =
                info.T_world_sensor.empty() || info.T_world_sensor[i].matrix().allFinite();
            // Where odometry found no pose, the points tell why.
            if (has_pose || !info.tracked) {
                recording.check(i);
            } else {
                static_cast<void>(recording.read(i));
            }
        } catch (const InputError& error) {
            unusable[i] = error.what();
        }
    }
    return unusable;
}

/// A run finds the poses that single scans lack, so these are not unusable.
void note_missing_poses(Preflight& result, const Recording& recording,
                        std::map<std::size_t, std::string>& unusable) {
    const Info& info = recording.info();
    if (info.tracked || info.points_in_world) return;
    const std::vector<std::size_t> missing = scans_without_pose(recording);
    if (missing.empty() || missing.size() == info.T_world_sensor.size()) return;
    for (const std::size_t i : missing) unusable.erase(i);
    result.notes.push_back(fmt::format("{}, the first is {}; `run` finds them by odometry",
                                       missing_text(recording, missing.size()),
                                       stem(recording, missing.front())));
}

/// Adds what is not there yet.
void merge(Preflight& result, Preflight of_another) {
    for (Finding& finding : of_another.findings) {
        const bool is_known =
            std::any_of(result.findings.begin(), result.findings.end(),
                        [&](const Finding& known) { return known.advice == finding.advice; });
        if (!is_known) result.findings.push_back(std::move(finding));
    }
    for (std::string& note : of_another.notes) {
        const bool is_known =
            std::find(result.notes.begin(), result.notes.end(), note) != result.notes.end();
        if (!is_known) result.notes.push_back(std::move(note));
    }
    for (std::string& line : of_another.unusable) result.unusable.push_back(std::move(line));
    if (result.overlays.empty()) result.overlays = std::move(of_another.overlays);
    result.scans += of_another.scans;
}

Preflight check_sensor(const Recording& recording, Depth depth, MotionLook& look) {
    const std::size_t places = depth == Depth::thorough ? 12 : 3;
    const std::vector<Pair> chosen = choose_pairs(recording.size(), places);
    Preflight result;
    std::map<std::size_t, std::string> unusable = find_unusable(recording);
    const Samples samples = read_samples(recording, chosen, unusable);
    const std::vector<Pair> pairs = comparable(samples, chosen);
    if (depth == Depth::thorough) note_missing_poses(result, recording, unusable);
    for (const auto& [i, why] : unusable)
        result.unusable.push_back(stem(recording, i) + ": " + why);
    result.scans = samples.size();
    if (recording.info().has_poses) result.overlays = compare(samples, pairs);
    if (names_quaternions(recording)) leave_out_quaternions(result.overlays);
    judge_stamps(result, recording);
    judge_order(result, recording, samples);
    if (judge_unit(result, samples) || judge_frame(result, recording, samples)) return result;
    judge_precision(result, samples, recording.info().point_unit);
    if (auto parts = find_rotation_parts(recording)) {
        result.findings.push_back(std::move(*parts));
        return result;
    }
    if (!judge_sensors(result, recording)) judge_points(result, samples);
    // Poses that odometry found fit the scans, as far as these show it.
    if (result.overlays.empty() || recording.info().tracked) return result;
    const auto nearly_right = [&] {
        const MotionQuality& quality = look.quality();
        return quality.nearly_right || !quality.shows_motion();
    };
    judge_poses(result, recording, samples, pairs, nearly_right);
    if (!result.findings.empty() || depth == Depth::quick) return result;
    auto finding = misfit(samples, pairs);
    if (finding && !nearly_right()) {
        result.findings.push_back(std::move(*finding));
        return result;
    }
    judge_motion(result, look);
    return result;
}

}  // namespace

Preflight check_recording(const Recording& recording, Depth depth) {
    MotionLook look(recording, {}, recording.info().deskewed ? "off" : "auto");
    return check_recording(recording, depth, look);
}

Preflight check_recording(const Recording& recording, Depth depth, MotionLook& look) {
    const std::vector<Recording> sensors = by_sensor(recording);
    if (sensors.size() == 1) return check_sensor(recording, depth, look);
    // A sensor that is elsewhere on the vehicle makes all of its poses look wrong.
    auto [misplaced, notes] = misplaced_sensors(recording, look.config());
    Preflight result;
    for (const Recording& sensor : sensors) {
        MotionLook own_look(sensor, look.config(), look.deskew());
        Preflight of_sensor = check_sensor(sensor, depth, own_look);
        const bool is_first = &sensor == &sensors.front();
        if (!is_first && !misplaced.empty()) of_sensor.findings.clear();
        merge(result, std::move(of_sensor));
    }
    std::move(misplaced.begin(), misplaced.end(), std::back_inserter(result.findings));
    std::move(notes.begin(), notes.end(), std::back_inserter(result.notes));
    return result;
}

}  // namespace dynamic_filter::io
