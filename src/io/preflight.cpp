// SPDX-License-Identifier: MIT
#include "dynamic_filter/io/preflight.hpp"

#include <fmt/format.h>
#include <tsl/robin_map.h>
#include <tsl/robin_set.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <optional>

#include "dynamic_filter/error.hpp"
#include "dynamic_filter/geometry/voxel.hpp"
#include "dynamic_filter/io/pose_fix.hpp"

namespace dynamic_filter::io {
namespace {

/// A scan thinned to what the comparison needs.
struct Sample {
    Points points;  // sensor frame, what stands upright
    Pose T_world_sensor = Pose::Identity();
    double doubled = 0.0;  // see share_of_doubles()
    // Points within a few metres of the frame's origin, and of where the pose says the sensor is.
    std::size_t near_origin = 0, near_pose = 0;
};
using Voxels = tsl::robin_set<VoxelKey, VoxelHash>;

constexpr float kVoxel = 0.3F, kNearest = 2.0F, kFarthest = 30.0F;  // [m]
constexpr std::array<std::size_t, 4> kApart = {1, 3, 8, 20};        // scans of a pair

/// What stands upright. The ground is left out: the rings on it look the same from everywhere, as
/// if nothing had moved.
Points upright(const Points& points) {
    constexpr float kColumn = 0.6F, kTall = 0.5F;  // [m]
    struct Extent {
        float low, high;
    };
    tsl::robin_map<VoxelKey, Extent, VoxelHash> columns;
    const auto column_of = [&](const Point& p) -> std::optional<VoxelKey> {
        const bool usable = is_measured(p) && p.norm() > kNearest && p.norm() < kFarthest;
        const auto cell = usable ? cell_of({p.x(), p.y(), 0.0F}, 1.0F / kColumn) : std::nullopt;
        return cell ? std::optional(pack(*cell)) : std::nullopt;
    };
    for (const Point& p : points) {
        if (const auto column = column_of(p)) {
            Extent& e = columns.try_emplace(*column, Extent{p.z(), p.z()}).first.value();
            e = {std::min(e.low, p.z()), std::max(e.high, p.z())};
        }
    }
    Points kept;
    for (const Point& p : points) {
        const auto column = column_of(p);
        if (!column) continue;
        const Extent& e = columns.at(*column);
        if (e.high - e.low > kTall && p.z() > e.low + 0.5F * kTall) kept.push_back(p);
    }
    return kept;
}

/// Of the pairs of points in nearly the same direction, how many are not at the same range: from
/// one place one sees one thing. Two returns of one beam have exactly one direction.
double share_of_doubles(const Points& points) {
    constexpr float kPixel = 0.2F * 3.14159265F / 180.0F, kSame = 0.02F * kPixel;
    struct Direction {
        float azimuth, elevation, range;
    };
    tsl::robin_map<VoxelKey, Direction, VoxelHash> first;
    std::size_t pairs = 0, doubles = 0;
    for (const Point& p : points) {
        const float range = p.norm();
        if (!is_measured(p) || range < kNearest || range > kFarthest) continue;
        const Direction d{std::atan2(p.y(), p.x()), std::asin(p.z() / range), range};
        const auto cell = cell_of({d.azimuth, d.elevation, 0.0F}, 1.0F / kPixel);
        const auto [it, fresh] = first.try_emplace(pack(*cell), d);
        if (fresh) continue;
        const Direction& other = it->second;
        const bool one_beam = std::abs(d.azimuth - other.azimuth) < kSame &&
                              std::abs(d.elevation - other.elevation) < kSame;
        if (one_beam) continue;
        ++pairs;
        doubles += std::abs(range - other.range) > std::max(0.5F, 0.1F * range) ? 1 : 0;
    }
    constexpr double kEnough = 0.015;  // a seam, edges and a window make some
    const bool many = static_cast<double>(doubles) > kEnough * static_cast<double>(points.size());
    return many ? static_cast<double>(doubles) / static_cast<double>(pairs) : 0.0;
}

std::size_t count_near(const Points& points, const Point& place) {
    constexpr float kNear = 6.0F;  // [m] a LiDAR on a car or robot sees the ground there
    return static_cast<std::size_t>(std::count_if(
        points.begin(), points.end(),
        [&](const Point& p) { return is_measured(p) && (p - place).norm() < kNear; }));
}

std::optional<Sample> read_sample(const Sequence& sequence, std::size_t i) {
    try {
        const Frame frame = read_frame(sequence, i);
        const Point said = frame.T_world_sensor.translation().cast<float>();
        return Sample{upright(frame.points), frame.T_world_sensor, share_of_doubles(frame.points),
                      count_near(frame.points, Point::Zero()), count_near(frame.points, said)};
    } catch (const InputError&) {
        return std::nullopt;
    }
}

Voxels voxels_of(const Points& points) {
    Voxels voxels;
    for (const Point& p : points) {
        if (const auto cell = cell_of(p, 1.0F / kVoxel)) voxels.insert(pack(*cell));
    }
    return voxels;
}

Points thinned(const Points& points) {
    constexpr std::size_t kMost = 2000;
    const std::size_t step = points.size() / kMost + 1;
    Points thin;
    for (std::size_t i = 0; i < points.size(); i += step) thin.push_back(points[i]);
    return thin;
}

double share_inside(const Points& points, const Pose& T_to_from, const Voxels& voxels) {
    if (points.empty()) return 0.0;
    const Eigen::Isometry3f transform = T_to_from.cast<float>();
    std::size_t inside = 0;
    for (const Point& p : points) {
        const auto cell = cell_of(transform * p, 1.0F / kVoxel);
        inside += cell && voxels.contains(pack(*cell)) ? 1 : 0;
    }
    return static_cast<double>(inside) / static_cast<double>(points.size());
}

/// Where a scan would be under another reading of its pose.
struct Reading {
    std::string name;
    std::function<Pose(const Pose&)> pose;
};
constexpr const char *kAsGiven = "as given", *kInWorld = "points in world",
                     *kInSensor = "points in sensor";
std::vector<Reading> readings() {
    std::vector<Reading> all = {{kAsGiven, [](const Pose& pose) { return pose; }}};
    for (const PoseFix fix : pose_fixes()) {
        all.push_back({to_string(fix), [fix](const Pose& pose) { return fixed(fix, pose); }});
    }
    all.push_back({kInWorld, [](const Pose&) { return Pose(Pose::Identity()); }});
    all.push_back({kInSensor, [](const Pose& pose) { return pose * pose; }});
    return all;
}

struct Pair {
    std::size_t from, apart;
};
std::vector<Pair> choose_pairs(std::size_t scans, std::size_t places) {
    std::vector<Pair> pairs;
    for (std::size_t k = 0; k < places; ++k) {
        const std::size_t from = k * scans / places;
        for (const std::size_t apart : kApart) {
            if (from + apart < scans) pairs.push_back({from, apart});
        }
    }
    return pairs;
}

/// Scans by index, read once.
using Samples = std::map<std::size_t, Sample>;

Samples read_samples(const Sequence& sequence, const std::vector<Pair>& pairs) {
    Samples samples;
    for (const Pair& pair : pairs) {
        for (const std::size_t i : {pair.from, pair.from + pair.apart}) {
            if (samples.contains(i)) continue;
            if (auto sample = read_sample(sequence, i)) samples.emplace(i, std::move(*sample));
        }
    }
    return samples;
}

/// The mean share of each reading.
std::vector<Overlay> compare(const Samples& samples, const std::vector<Pair>& pairs) {
    const std::vector<Reading> all = readings();
    std::vector<Overlay> overlays;
    for (const Reading& reading : all) overlays.push_back({reading.name, 0.0});
    std::size_t compared = 0, of = SIZE_MAX;
    Voxels voxels;
    for (const Pair& pair : pairs) {
        const auto a = samples.find(pair.from), b = samples.find(pair.from + pair.apart);
        if (a == samples.end() || b == samples.end()) continue;
        if (of != pair.from) voxels = voxels_of(a->second.points);
        of = pair.from;
        const Points points = thinned(b->second.points);
        for (std::size_t r = 0; r < all.size(); ++r) {
            const Pose T_a_b = all[r].pose(a->second.T_world_sensor).inverse() *
                               all[r].pose(b->second.T_world_sensor);
            overlays[r].share += share_inside(points, T_a_b, voxels);
        }
        ++compared;
    }
    if (compared == 0) return {};
    for (Overlay& overlay : overlays) overlay.share /= static_cast<double>(compared);
    return overlays;
}

double share_of(const std::vector<Overlay>& overlays, const std::string& reading) {
    const auto found = std::find_if(overlays.begin(), overlays.end(),
                                    [&](const Overlay& o) { return o.reading == reading; });
    return found == overlays.end() ? 0.0 : found->share;
}

/// Clearly more than what chance and a moving scene make of it.
bool clearly_better(double share, double than) { return share > 1.1 * than + 0.02; }

bool all_equal(const Samples& samples) {
    return std::all_of(samples.begin(), samples.end(), [&](const auto& sample) {
        return sample.second.T_world_sensor.isApprox(samples.begin()->second.T_world_sensor, 1e-9);
    });
}

/// Scans in the world's frame have their ground where the pose is, not at the origin.
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

/// The sensors of robots stand upright, as long as they do not fly.
bool hang_upside_down(const Samples& samples, const Reading& reading) {
    return std::all_of(samples.begin(), samples.end(), [&](const auto& sample) {
        return reading.pose(sample.second.T_world_sensor)(2, 2) < -0.5;
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
    };
    return meanings.at(reading);
}

std::string fits_better(const std::vector<Overlay>& overlays, const std::string& reading) {
    return fmt::format("scans overlay by {:.0f} % so, by {:.0f} % as given",
                       100.0 * share_of(overlays, reading), 100.0 * share_of(overlays, kAsGiven));
}

Finding pose_finding(const std::vector<Overlay>& overlays, const std::string& reading) {
    return {meaning_of(reading) + ": " + fits_better(overlays, reading), "--pose-fix " + reading};
}

/// While the sensor stands still, scans far apart overlay as well as neighbours do.
bool stands_still(const Samples& samples, const std::vector<Pair>& pairs) {
    std::vector<Pair> near, far;
    for (const Pair& pair : pairs) (pair.apart == kApart.front() ? near : far).push_back(pair);
    return share_of(compare(samples, far), kInWorld) >
           0.8 * share_of(compare(samples, near), kInWorld);
}

void judge_poses(Preflight& result, const Sequence& sequence, const Samples& samples,
                 const std::vector<Pair>& pairs) {
    const auto& overlays = result.overlays;
    const double given = share_of(overlays, kAsGiven);
    if (all_equal(samples)) {
        if (stands_still(samples, pairs)) return;
        result.findings.push_back(
            {"all poses are equal, but what the scans show moves",
             "give the trajectory with --poses; if the scans are in the world's frame, too"});
        return;
    }
    const bool files_in_world = sequence.format == Format::benchmark;
    if (!files_in_world && lie_in_world(samples)) {
        result.findings.push_back(
            {"the points are in the world's frame already: " + fits_better(overlays, kInWorld),
             "--points-in-world"});
        return;
    }
    const auto best =
        std::max_element(overlays.begin(), overlays.end(),
                         [](const Overlay& a, const Overlay& b) { return a.share < b.share; });
    if (best->reading == kAsGiven) return;
    const bool much = clearly_better(best->share, given);
    const bool is_fix = best->reading != kInWorld && best->reading != kInSensor;
    if (is_fix) {
        const auto all = readings();
        const auto& as_best = all[static_cast<std::size_t>(best - overlays.begin())];
        const bool upright_instead =
            hang_upside_down(samples, all.front()) && !hang_upside_down(samples, as_best);
        if (much || upright_instead)
            result.findings.push_back(pose_finding(overlays, best->reading));
        return;
    }
    if (!much) return;
    if (best->reading == kInSensor && files_in_world) {
        result.findings.push_back(
            {"the points are in the sensor's frame, but this format has them in the world's: " +
                 fits_better(overlays, kInSensor),
             "--format folder with a pose file"});
        return;
    }
    result.findings.push_back({"the poses do not fit the scans: " +
                                   fits_better(overlays, kInWorld) + ", as if nothing moved",
                               "look whether they are of this recording, and of the same times; "
                               "give others with --poses"});
}

void judge_points(Preflight& result, const Samples& samples) {
    constexpr double kSuspicious = 0.2;
    std::vector<double> doubled;
    for (const auto& [i, sample] : samples) doubled.push_back(sample.doubled);
    if (doubled.empty()) return;
    std::nth_element(doubled.begin(),
                     doubled.begin() + static_cast<std::ptrdiff_t>(doubled.size() / 2),
                     doubled.end());
    const double typical = doubled[doubled.size() / 2];
    if (typical < kSuspicious) return;
    result.findings.push_back(
        {fmt::format("{:.0f} % of the points that lie in one direction are at different ranges: "
                     "several sensors or several sweeps are merged into one scan",
                     100.0 * typical),
         "use the scans of one sensor, each with its own pose"});
}

void judge_stamps(Preflight& result, const Sequence& sequence) {
    if (!sequence.measured_stamps || sequence.size() < 3) return;
    std::vector<double> steps;
    for (std::size_t i = 1; i < sequence.size(); ++i) {
        steps.push_back(sequence.stamps[i] - sequence.stamps[i - 1]);
    }
    const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
    std::nth_element(steps.begin(), middle, steps.end());
    constexpr double kLongest = 20.0, kShortest = 1e-3;  // [s] between scans
    if (*middle<kLongest&& * middle> kShortest) return;
    for (const auto& [unit, seconds] : {std::pair{"ms", 1e-3}, {"us", 1e-6}, {"ns", 1e-9}}) {
        if (*middle * seconds > 0.5 * kLongest || *middle * seconds < 10.0 * kShortest) continue;
        result.findings.push_back({fmt::format("the stamps are not in seconds: scans are {:.4g} "
                                               "apart, which are {:.3g} s if it is {}",
                                               *middle, *middle * seconds, unit),
                                   fmt::format("--time-unit {}", unit)});
        return;
    }
    result.findings.push_back({fmt::format("scans are {:.3g} s apart", *middle),
                               "look at the stamps; they should be in seconds"});
}

}  // namespace

Preflight check_recording(const Sequence& sequence, std::size_t places) {
    const std::vector<Pair> pairs = choose_pairs(sequence.size(), places);
    const Samples samples = read_samples(sequence, pairs);
    Preflight result;
    result.scans = samples.size();
    result.overlays = compare(samples, pairs);
    judge_stamps(result, sequence);
    judge_points(result, samples);
    if (!result.overlays.empty()) judge_poses(result, sequence, samples, pairs);
    return result;
}

}  // namespace dynamic_filter::io
