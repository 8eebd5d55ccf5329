// SPDX-License-Identifier: MIT
/// Records what the live filter judged, and makes of it the folder that `run` makes.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "dynamic_filter/io/bag_writer.hpp"
#include "intake.hpp"

namespace dynamic_filter::live {

/// The bag beside the folder `output`: output.mcap, or output.bag in the encoding of ROS 1.
std::filesystem::path recording_of(const std::filesystem::path& output,
                                   io::MessageEncoding encoding);

/// Writes scans and their poses to a bag. Single caller.
class Recorder {
public:
    explicit Recorder(const std::filesystem::path& bag);
    void add(const LiveScan& scan);
    void commit();  ///< without it, nothing is left

private:
    std::unique_ptr<io::BagWriter> writer_;
    double last_pose_ = -1.0;  // [s]
};

/// The command that makes the folder of the bag, with the settings of the live filter.
int finish_recording(const std::filesystem::path& bag, const std::filesystem::path& output,
                     const LiveConfig& config, bool without_poses, bool overwrite, bool quiet);

}  // namespace dynamic_filter::live
