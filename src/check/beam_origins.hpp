// SPDX-License-Identifier: MIT
/// Finds where the beams of a rotating sensor begin, from the points of one scan.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "dynamic_filter/types.hpp"

namespace dynamic_filter::io {

/// The places [m], in the frame of the points, at which the beams of a scan meet: one, or two if
/// the first and the second half of the points come from different sensors. Empty if the scan does
/// not show it.
///
/// Each beam of a rotating sensor draws a cone of constant elevation, whose apex is the sensor.
/// Points that follow each other on a beam are recognised by their order in the file, whichever of
/// the usual orders that is. Seen from a wrong apex, their elevations differ. The axis of the cones
/// may be tilted. An apex that is hardly sharper than the origin, or hardly away from it, is the
/// origin: the beams of real sensors miss their common centre by up to 0.2 m.
std::vector<Eigen::Vector3d> beam_origins(const Points& points);

}  // namespace dynamic_filter::io
