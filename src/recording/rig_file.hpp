// SPDX-License-Identifier: MIT
/// The file that lists the sensors of a vehicle, and where each of them is.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "dynamic_filter/types.hpp"

namespace dynamic_filter::io {

/// One sensor of a rig file.
struct RigEntry {
    std::string name;                 ///< part of the names of its scans
    std::filesystem::path recording;  ///< a folder or a bag
    std::string topic{};              ///< of a bag
    /// Where the sensor is on the vehicle; empty: the file does not say it.
    std::optional<Pose> T_vehicle_sensor{};
    double clock = 0.0;  ///< [s] to add to the stamps of its scans
    /// Of clouds in which the points of several sensors were merged: this sensor's are those whose
    /// `field` has the value `value`, and are in the frame of the vehicle. Empty: not merged.
    std::string field{};
    double value = 0.0;
};

struct RigFile {
    std::vector<RigEntry> sensors;                 ///< two or more
    std::optional<std::filesystem::path> poses{};  ///< of the vehicle
};

/// True for the name of a file that exists and ends in .toml.
bool is_rig_file(const std::filesystem::path& path);

/// Relative paths in it start at its folder. Throws InputError with the line.
RigFile read_rig_file(const std::filesystem::path& file);

}  // namespace dynamic_filter::io
