// SPDX-License-Identifier: MIT
/// What is done about a sensor that is not at the origin of the frame of the points.
#pragma once

#include <Eigen/Core>
#include <string>

#include "dynamic_filter/recording.hpp"

namespace dynamic_filter::app {

/// Finds the place of the sensor if it is not known yet (Info::sensor_at), and gives it to the
/// recording. Returns what was found, a sentence, or "" if the sensor is at the origin or if its
/// place cannot be seen.
std::string choose_sensor_place(io::Recording& recording);

}  // namespace dynamic_filter::app
