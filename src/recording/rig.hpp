// SPDX-License-Identifier: MIT
/// One recording of the sensors of a vehicle, each with recordings of its own.
#pragma once

#include <filesystem>

#include "dynamic_filter/recording.hpp"
#include "recording/recording_parts.hpp"

namespace dynamic_filter::io {

/// The scans of all sensors of a rig file, in the order of their stamps, each in the frame and with
/// the pose of its own sensor. The poses are, in this order: those of the vehicle, by
/// `options.poses` or the rig file, and the places of the sensors on it; those of each sensor's own
/// recording; those of the first recording that has some, and the places. Clouds have the fields
/// that all sensors have, `t` [s] if points have times, and `sensor`, its number in the rig file
/// from 0. Boxes of the own body are in the frame of the vehicle. Throws InputError and
/// ConfigError.
RecordingParts open_rig(const std::filesystem::path& file, const OpenOptions& options);

}  // namespace dynamic_filter::io
