// SPDX-License-Identifier: MIT
#include "recording/poses_at_scans.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/numbers.hpp"
#include "formats/poses/rigid.hpp"

namespace dynamic_filter::io {
namespace {

std::optional<Pose> nearest_pose(const Trajectory& published, double stamp, double most) {
    const auto& stamps = published.stamps;
    std::optional<Pose> found;
    const auto after = std::lower_bound(stamps.begin(), stamps.end(), stamp) - stamps.begin();
    for (const auto i : {after - 1, after}) {
        if (i < 0 || i >= std::ssize(stamps)) continue;
        const auto k = static_cast<std::size_t>(i);
        const double gap = std::abs(stamps[k] - stamp);
        if (gap > most) continue;
        most = gap;
        found = published.poses[k];
    }
    return found;
}

/// "1 of 10", of scans that have poses.
std::string share_text(std::size_t with, std::size_t all) {
    // From the first scan with a pose to the last one; of a single pose, there is no next one.
    const double scans_per_pose = with > 1
                                      ? static_cast<double>(all - 1) / static_cast<double>(with - 1)
                                      : static_cast<double>(all);
    if (scans_per_pose < 2.5) return fmt::format("{} of {}", with, all);
    return fmt::format("1 of {:.0f}", scans_per_pose);
}

}  // namespace

PoseLimits limits_for(const std::vector<double>& stamps) {
    std::vector<double> steps;
    for (std::size_t i = 1; i < stamps.size(); ++i) steps.push_back(stamps[i] - stamps[i - 1]);
    const double step = median(std::move(steps));
    constexpr double jitter = 1.05;  // stamps are not even
    PoseLimits limits;
    if (step > 0.0) limits.nearest = std::min(limits.nearest, 0.5 * jitter * step);
    limits.apart = jitter * std::max(limits.apart, 2.0 * step);
    return limits;
}

PosesAtScans poses_at_scans(const std::vector<double>& stamps, const Trajectory& published,
                            const std::function<std::optional<Pose>(double)>& known) {
    const PoseLimits limits = limits_for(stamps);
    PosesAtScans found;
    std::size_t with = 0;
    for (const double stamp : stamps) {
        auto pose = known(stamp);
        if (!pose) pose = nearest_pose(published, stamp, limits.nearest);
        with += pose ? 1 : 0;
        found.are_sparse |= !pose && !published.stamps.empty() &&
                            stamp > published.stamps.front() && stamp < published.stamps.back();
        found.T_world_sensor.push_back(pose.value_or(lost_pose()));
    }
    found.are_sparse &= with > 0;
    if (found.are_sparse) {
        found.note =
            fmt::format("poses at {} scans: the others are placed by odometry that is tied to them",
                        share_text(with, stamps.size()));
    }
    return found;
}

}  // namespace dynamic_filter::io
