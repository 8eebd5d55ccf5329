// SPDX-License-Identifier: MIT
/// Records what the live filter judged, and makes of it the folder that `run` makes.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <vector>

#include "dynamic_filter/bag.hpp"
#include "live/intake.hpp"

namespace dynamic_filter::live {

/// Writes scans and their poses to a bag beside the folder `output`: output.mcap, or output.bag in
/// the encoding of ROS 1. Stamps that go back begin the next bag, output-2.mcap, because a
/// recording has one time. Single caller.
class Recorder {
public:
    /// `several`: the scans are those of several sensors, whose poses are then written to /tf.
    /// Throws ConfigError if the folder or the bag exists and must not be replaced.
    Recorder(const std::filesystem::path& output, io::MessageEncoding encoding, bool overwrite,
             bool several = false);

    void add(const LiveScan& scan);
    /// Completes the bags; without it, the last one is not left. Returns the output folders whose
    /// bags hold scans.
    std::vector<std::filesystem::path> commit();
    [[nodiscard]] std::filesystem::path bag_of(const std::filesystem::path& output) const;

private:
    void begin();
    void write_pose(const LiveScan& scan, double stamp, const Pose& T_world_sensor);
    [[nodiscard]] bool is_taken(const std::filesystem::path& output) const;

    std::filesystem::path output_;
    io::MessageEncoding encoding_;
    bool overwrite_, several_;
    std::unique_ptr<io::BagWriter> writer_;  // null until the first scan
    std::vector<std::filesystem::path> written_;
    std::map<std::string, double> last_scan_, last_pose_;  // [s] in the current bag; keys: frames
};

/// Makes the folder `output` of its bag, with the settings of the live filter. Returns the exit
/// code of `run`.
int finish_recording(const std::filesystem::path& bag, const std::filesystem::path& output,
                     const LiveConfig& config, bool without_poses, bool overwrite, bool quiet);

}  // namespace dynamic_filter::live
