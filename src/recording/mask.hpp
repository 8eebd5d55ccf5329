// SPDX-License-Identifier: MIT
/// The own body: what moves with the sensor, such as the vehicle that carries it, and is left out.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "dynamic_filter/recording.hpp"

namespace dynamic_filter::io {

/// Boxes from a text file: each line has the lowest and the highest corner, six numbers [m] in the
/// sensor frame; `#` begins a comment. Throws InputError that names the line.
Boxes read_boxes(const std::filesystem::path& file);

/// The boxes of a file, or those in the mesh of an .stl file. Throws InputError.
Boxes read_mask(const std::filesystem::path& file);

/// Moves the points in the boxes to the origin, where points are no measurements. Returns 1 for
/// each of them, parallel to the points, or nothing if there are none. The boxes are in the frame
/// into which `T_body_sensor` leads.
std::vector<std::uint8_t> take_out(const Boxes& boxes, const Pose& T_body_sensor, Points& points);
inline std::vector<std::uint8_t> take_out(const Boxes& boxes, Points& points) {
    return take_out(boxes, Pose::Identity(), points);
}

/// Labels the points of the own body, which must not stay in a map, as dynamic. `own`: as in
/// FullScan.
void label_own_body(const std::vector<std::uint8_t>& own, Labels& labels);

/// The recording with this own body.
Recording with_own_body(const Recording& recording, Boxes boxes);

}  // namespace dynamic_filter::io
