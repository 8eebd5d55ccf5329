// SPDX-License-Identifier: MIT
#include "check/samples.hpp"

#include <tsl/robin_map.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <set>

#include "base/numbers.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/poses.hpp"
#include "formats/clouds/time_field.hpp"
#include "geometry/angle.hpp"
#include "geometry/voxel.hpp"
#include "recording/recording_parts.hpp"
#include "tracking/upright.hpp"

namespace dynamic_filter::io {
namespace {

constexpr float kNearest = 2.0F, kFarthest = 30.0F;  // [m]

/// Share of pairs of points in nearly the same direction that have different ranges. From one
/// place, one direction has one range. Two returns of one beam have exactly the same direction and
/// are not counted.
double share_of_doubles(const Points& points) {
    constexpr float kPixel = 0.2F * std::numbers::pi_v<float> / 180.0F, kSame = 0.02F * kPixel;
    struct Direction {
        float azimuth, elevation, range;
    };
    tsl::robin_map<VoxelKey, Direction, VoxelHash> first;
    std::size_t pairs = 0, doubles = 0;
    for (const Point& p : points) {
        const float range = p.norm();
        if (!is_measured(p) || range < kNearest || range > kFarthest) continue;
        const Direction d{angle_of(p.y(), p.x()), angle_of_sine(p.z() / range), range};
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
    constexpr double kEnough = 0.015;  // seams, edges and windows cause a few
    const bool many = static_cast<double>(doubles) > kEnough * static_cast<double>(points.size());
    return many ? static_cast<double>(doubles) / static_cast<double>(pairs) : 0.0;
}

std::size_t count_near(const Points& points, const Point& place) {
    constexpr float kNear = 6.0F;  // [m] a LiDAR on a car or robot sees the ground at this range
    return static_cast<std::size_t>(std::count_if(
        points.begin(), points.end(),
        [&](const Point& p) { return is_measured(p) && (p - place).norm() < kNear; }));
}

/// Start of the scan in seconds since 1970, also from nanoseconds in a field that is wide enough.
/// Smaller numbers may be relative to a start that differs between scans.
std::optional<double> began_of(const Cloud& cloud) {
    constexpr double kLeast = 1e8, kMost = 1e10, kNanosecond = 1e-9;
    const Field* field = time_field(cloud);
    if (field == nullptr || size_of(field->type) < 8) return std::nullopt;
    std::optional<double> began;
    for (const double raw : values(cloud, *field)) {
        const double time = raw > kMost ? raw * kNanosecond : raw;
        if (time > kLeast && time < kMost) began = std::min(time, began.value_or(time));
    }
    return began;
}

/// The points without motion compensation, after which they are seen from several places and
/// naturally lie behind each other.
Points as_measured(const Recording& recording, const FullScan& scan) {
    const Info& info = recording.info();
    if (info.points_in_world) return scan.points;
    return seen_from(info.sensor_at.value_or(Eigen::Vector3d::Zero()),
                     in_metres(positions(scan.cloud), info));
}

Eigen::Vector2f middle_of(const Points& points) {
    std::vector<float> x, y;
    for (const Point& p : points) {
        if (!is_measured(p)) continue;
        x.push_back(p.x());
        y.push_back(p.y());
    }
    return {median(std::move(x)), median(std::move(y))};
}

double step_of(const Cloud& cloud) {
    double step = 0.0;
    for (const char* axis : {"x", "y"}) {
        const Field* const field = cloud.find(axis);
        if (field == nullptr || field->type != FieldType::f32) continue;
        std::vector<double> sizes;
        for (const double value : values(cloud, *field)) {
            if (std::isfinite(value)) sizes.push_back(std::abs(value));
        }
        if (sizes.empty()) continue;
        const auto typical = static_cast<float>(median(std::move(sizes)));
        const float next = std::nextafter(typical, std::numeric_limits<float>::infinity());
        step = std::max(step, static_cast<double>(next) - static_cast<double>(typical));
    }
    return step;
}

Sample sample_of(const Recording& recording, const FullScan& scan) {
    const Point said = scan.T_world_sensor.translation().cast<float>();
    return {upright_points(scan.points),
            scan.T_world_sensor,
            scan.T_world_sensor,
            share_of_doubles(as_measured(recording, scan)),
            count_near(scan.points, Point::Zero()),
            count_near(scan.points, said),
            middle_of(scan.points),
            typical_range(scan.points),
            step_of(scan.cloud),
            began_of(scan.cloud)};
}

}  // namespace

float typical_range(const Points& points) {
    std::vector<float> ranges;
    for (const Point& p : points) {
        if (is_measured(p)) ranges.push_back(p.norm());
    }
    return median(std::move(ranges));
}

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

Samples read_samples(const Recording& recording, const std::vector<Pair>& pairs,
                     std::map<std::size_t, std::string>& unusable) {
    std::set<std::size_t> chosen = {0};
    for (const Pair& pair : pairs) chosen.insert({pair.from, pair.from + pair.apart});
    const std::vector<Pose> poses = chained(recording.info().T_world_sensor);
    Samples samples;
    std::vector<Field> fields;
    for (const std::size_t i : chosen) {
        try {
            const FullScan scan = recording.read(i);
            if (fields.empty()) fields = scan.cloud.fields;
            if (scan.cloud.fields != fields) unusable[i] = kOtherFields;
            Sample& sample = samples.emplace(i, sample_of(recording, scan)).first->second;
            if (!poses.empty()) sample.T_world_chained = poses[i];
        } catch (const InputError& error) {
            unusable[i] = error.what();
        }
    }
    return samples;
}

std::vector<Pair> comparable(const Samples& samples, const std::vector<Pair>& pairs) {
    constexpr double kFar = 20.0;  // [m]
    std::vector<Pair> near;
    for (const Pair& pair : pairs) {
        const auto a = samples.find(pair.from), b = samples.find(pair.from + pair.apart);
        if (a == samples.end() || b == samples.end()) continue;
        const Eigen::Vector3d way =
            b->second.T_world_sensor.translation() - a->second.T_world_sensor.translation();
        if (way.norm() <= kFar) {
            near.push_back(pair);
        } else if (pair.apart == kApart.front()) {
            return pairs;
        }
    }
    return near;
}

}  // namespace dynamic_filter::io
