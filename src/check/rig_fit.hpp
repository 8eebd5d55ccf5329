// SPDX-License-Identifier: MIT
/// Whether the sensors of a rig are where the rig file says.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dynamic_filter/check.hpp"
#include "dynamic_filter/recording.hpp"
#include "dynamic_filter/settings.hpp"

namespace dynamic_filter::io {

/// How the scans of a sensor lie on those of the first one.
struct SensorFit {
    std::size_t places = 0;   ///< number of places that were looked at
    std::size_t fitting = 0;  ///< number of those at which both show the same surfaces
    /// Where the sensor is by its scans, if its clock is right.
    Pose T_vehicle_sensor = Pose::Identity();
    double shift = 0.0;  ///< [m] between this place and that of the rig file
    double turn = 0.0;   ///< [rad] likewise
    double spread_of_shift = 0.0, spread_of_turn = 0.0;  ///< [m], [rad] medians, of single places
    double sharper = 1.0;  ///< blur of its points at the place of the rig file, by that at this one
    double delay = 0.0;    ///< [s] to add to its stamps, if its place is right
    /// What remains of the displacements at single places if one place, or one delay, explains
    /// them: the median [m], with 10 m for a radian.
    double left_by_place = 0.0, left_by_delay = 0.0;
    double moved_by_delay = 0.0;  ///< [m] median of what the delay explains
};

/// For each sensor of the recording but the first: registers its scans at up to 10 places to those
/// that the first sensor made around that time. Needs poses. Empty where too few places fit.
std::vector<std::optional<SensorFit>> fit_sensors(const Recording& rig,
                                                  const OdometryConfig& config);

struct RigFindings {
    std::vector<Finding> findings;
    std::vector<std::string> notes;  ///< sensors that could not be compared
};

/// Names the sensors that are not where the rig file says, or whose clock is another one, with what
/// to write in the rig file.
RigFindings misplaced_sensors(const Recording& rig, const OdometryConfig& config);

}  // namespace dynamic_filter::io
