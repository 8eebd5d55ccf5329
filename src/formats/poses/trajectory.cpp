// SPDX-License-Identifier: MIT
#include "dynamic_filter/poses.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "formats/clouds/time_field.hpp"

namespace dynamic_filter::io {
namespace {

/// Interpolates: share 0 gives a, 1 gives b; values outside extrapolate.
Pose between(const Pose& a, const Pose& b, double share) {
    const Eigen::Quaterniond from(a.linear()), to(b.linear());
    Pose pose = Pose::Identity();
    const Eigen::AngleAxisd turn(from.conjugate() * to);
    const Eigen::AngleAxisd part(share * turn.angle(), turn.axis());
    pose.linear() = (from * Eigen::Quaterniond(part)).normalized().toRotationMatrix();
    pose.translation() = (1.0 - share) * a.translation() + share * b.translation();
    return pose;
}

struct Span {
    double least = std::numeric_limits<double>::infinity();
    double most = -std::numeric_limits<double>::infinity();
};
Span span_of(const std::vector<double>& values) {
    Span span;
    for (const double v : values) {
        if (!std::isfinite(v)) continue;
        span.least = std::min(span.least, v);
        span.most = std::max(span.most, v);
    }
    return span;
}

/// The largest unit [s] in which the scan takes at most 1 s. A scan takes at least 1 ms.
std::optional<double> unit_of(double duration) {
    for (const double unit : {1.0, 1e-3, 1e-6, 1e-9}) {
        const double seconds = duration * unit;
        if (seconds <= 1.0) return seconds >= 1e-3 ? std::optional(unit) : std::nullopt;
    }
    return std::nullopt;
}

}  // namespace

const Field* time_field(const Cloud& cloud) {
    for (const char* name : {"t", "time", "timestamp", "offset_time", "time_offset", "timeOffset",
                             "time_stamp", "ts"}) {
        if (const Field* field = cloud.find(name)) return field;
    }
    return nullptr;
}

void put_in_order(Trajectory& trajectory) {
    const auto& stamps = trajectory.stamps;
    const auto not_before = [](double a, double b) { return a >= b; };
    const bool in_order =
        std::adjacent_find(stamps.begin(), stamps.end(), not_before) == stamps.end();
    if (in_order) return;
    std::vector<std::size_t> order(stamps.size());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return stamps[a] < stamps[b]; });
    Trajectory sorted;
    for (const std::size_t i : order) {
        if (!sorted.stamps.empty() && stamps[i] == sorted.stamps.back()) continue;
        sorted.stamps.push_back(stamps[i]);
        sorted.poses.push_back(trajectory.poses[i]);
    }
    trajectory = std::move(sorted);
}

std::optional<Pose> pose_at(const Trajectory& trajectory, double stamp, double gap, double beyond) {
    const auto& stamps = trajectory.stamps;
    if (stamps.empty() || !(stamp >= stamps.front() - beyond && stamp <= stamps.back() + beyond)) {
        return std::nullopt;
    }
    auto after = static_cast<std::size_t>(std::lower_bound(stamps.begin(), stamps.end(), stamp) -
                                          stamps.begin());
    if (after < stamps.size() && stamps[after] == stamp) return trajectory.poses[after];
    if (stamps.size() == 1) return trajectory.poses.front();
    after = std::clamp<std::size_t>(after, 1, stamps.size() - 1);
    const double step = stamps[after] - stamps[after - 1];
    if (step > gap) return std::nullopt;
    return between(trajectory.poses[after - 1], trajectory.poses[after],
                   (stamp - stamps[after - 1]) / step);
}

std::vector<float> point_times(const Cloud& cloud, double stamp) {
    const Field* field = time_field(cloud);
    if (field == nullptr) return {};
    const std::vector<double> raw = values(cloud, *field);
    const Span span = span_of(raw);
    if (!(span.most > span.least)) return {};
    const auto unit = unit_of(span.most - span.least);
    if (!unit) return {};
    // Offsets are small; large values are absolute times. If they do not fit the stamp of the scan,
    // they are of another clock, such as the sensor's own, and count from the first.
    const bool absolute = std::abs(span.least * *unit) > 10.0;
    const bool is_of_other_clock = absolute && std::abs(span.least * *unit - stamp) > 10.0;
    const double zero = is_of_other_clock ? span.least * *unit : absolute ? stamp : 0.0;
    std::vector<float> times(raw.size());
    for (std::size_t i = 0; i < raw.size(); ++i) {
        times[i] = static_cast<float>(raw[i] * *unit - zero);
    }
    return times;
}

void undo_motion(Points& points, const std::vector<float>& times, double stamp,
                 const Trajectory& T_world_sensor) {
    constexpr double kBeyond = 0.2, kGap = 1.0;  // [s]
    constexpr float kStep = 2e-5F;               // [s] points within this time share a pose
    const auto at_stamp = pose_at(T_world_sensor, stamp, kGap, kBeyond);
    if (!at_stamp) return;
    float of = std::numeric_limits<float>::quiet_NaN();
    Eigen::Isometry3f T_stamp_then = Eigen::Isometry3f::Identity();
    for (std::size_t i = 0; i < points.size() && i < times.size(); ++i) {
        if (!std::isfinite(times[i])) continue;
        const float time = std::round(times[i] / kStep) * kStep;
        if (time != of) {
            of = time;
            const auto then = pose_at(T_world_sensor, stamp + time, kGap, kBeyond);
            T_stamp_then = Eigen::Isometry3f::Identity();
            if (then) T_stamp_then = (at_stamp->inverse() * *then).cast<float>();
        }
        if (is_measured(points[i])) points[i] = T_stamp_then * points[i];
    }
}

}  // namespace dynamic_filter::io
