// SPDX-License-Identifier: MIT
/// The scans of a rig: those of each sensor's recording, with common fields, in the frame of their
/// sensor.
#pragma once

#include <string>
#include <vector>

#include "dynamic_filter/recording.hpp"
#include "recording/common_fields.hpp"
#include "recording/rig_file.hpp"

namespace dynamic_filter::io {

/// A scan of the rig: which sensor made it, and its number among the scans of that sensor.
struct OneOf {
    std::size_t sensor, scan;
};

struct Rig {
    RigFile file;
    std::vector<Recording> recordings;  // by sensor
    std::vector<OneOf> scans;           // in the order of their stamps
    CommonFields fields;
};

/// The fields that all sensors have; a note names those that are left out. Reads a cloud of each.
/// Throws InputError.
CommonFields fields_of(const Rig& rig, std::vector<std::string>& notes);

/// The cloud of a scan; `unit`: [m] per unit of its coordinates. Throws InputError.
Cloud read_cloud_of(const Rig& rig, OneOf one, double unit);

/// The ground truth of a scan, whose cloud it is. Throws InputError.
Labels read_truth_of(const Rig& rig, OneOf one, const Cloud& cloud);

}  // namespace dynamic_filter::io
