// SPDX-License-Identifier: MIT
#include "check/replaced_poses.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/numbers.hpp"
#include "check/overlay.hpp"
#include "dynamic_filter/poses.hpp"
#include "recording/recording_parts.hpp"

namespace dynamic_filter::io {
namespace {

/// The reading whose finding this is; nullptr if it is another finding.
const Reading* reading_of(const Finding& finding) {
    const std::string fix = "--pose-fix ";
    const std::string name = is_of_points(finding)             ? kPointsInFeet
                             : finding.advice.starts_with(fix) ? finding.advice.substr(fix.size())
                                                               : "";
    const auto& all = readings();
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const Reading& r) { return r.name == name; });
    return found == all.end() ? nullptr : &*found;
}

/// Median difference of motions over ten scans, relative to the motion; rotations count as at 1 m.
double disagreement(const Info& given, const Info& used, const Reading& reading) {
    constexpr std::size_t kScansApart = 10;
    constexpr double kLeastWay = 0.2;  // [m]
    const std::vector<Pose> poses =
        reading.is_chained ? chained(given.T_world_sensor) : given.T_world_sensor;
    std::vector<double> differences;
    for (std::size_t i = kScansApart; i < used.T_world_sensor.size(); ++i) {
        const Pose went = used.T_world_sensor[i - kScansApart].inverse() * used.T_world_sensor[i];
        const Pose said = reading.pose(poses[i - kScansApart]).inverse() * reading.pose(poses[i]);
        if (!went.matrix().allFinite() || !said.matrix().allFinite()) continue;
        const Pose off = went.inverse() * said;
        const double length = std::max(went.translation().norm(), kLeastWay);
        const double turn = Eigen::AngleAxisd(off.linear()).angle();
        differences.push_back(off.translation().norm() / length + turn);
    }
    return differences.empty() ? 0.0 : median(std::move(differences));
}

}  // namespace

bool is_of_points(const Finding& finding) { return finding.advice.starts_with("--point-unit "); }

std::vector<Finding> mistakes_in_replaced(const Recording& given, const Recording& used) {
    constexpr double kMuchBetter = 0.3;
    constexpr double kGross = 0.2;  // of the way; smaller errors are no misreading
    std::vector<Finding> mistakes;
    for (const Finding& finding : check_recording(given, Depth::quick).findings) {
        const Reading* const reading = reading_of(finding);
        if (reading == nullptr || given.info().T_world_sensor.size() != used.size()) continue;
        const Recording before = by_sensor(given).front(), after = by_sensor(used).front();
        const double as_given = disagreement(before.info(), after.info(), readings().front());
        const double as_read = disagreement(before.info(), after.info(), *reading);
        if (as_given > kGross && as_read < kMuchBetter * as_given) mistakes.push_back(finding);
    }
    return mistakes;
}

}  // namespace dynamic_filter::io
