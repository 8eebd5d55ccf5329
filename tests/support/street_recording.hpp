// SPDX-License-Identifier: MIT
/// A recording of a simulated street on disk, with any poses.
#pragma once

#include <array>
#include <optional>

#include "dynamic_filter/simulation.hpp"
#include "support/drive.hpp"
#include "support/recording.hpp"

namespace dynamic_filter::io {

constexpr std::size_t kStreetScans = 30;

/// kStreetScans of a simulation; without times, as KITTI's scans are.
inline test::Drive simulated_drive(const sim::SimulationOptions& options, std::size_t first) {
    sim::Simulation simulation(options);
    test::Drive drive;
    for (std::size_t i = 0; i < kStreetScans; ++i) {
        sim::SimulatedScan s = simulation.scan(first + i);
        drive.truth.push_back(s.T_world_sensor);
        drive.scans.push_back({std::move(s.points), Pose::Identity(), s.stamp, i, false});
    }
    return drive;
}

/// From the middle of the street.
inline const test::Drive& street(bool sweep) {
    static std::array<std::optional<test::Drive>, 2> drives;
    auto& drive = drives[sweep ? 1 : 0];
    if (drive) return *drive;
    sim::SimulationOptions options;
    options.scene = "street";
    options.sensor = "hdl32";
    options.rate_hz = 5.0;  // 1 m between scans
    options.sweep = sweep;
    return drive.emplace(simulated_drive(options, 30));
}

class StreetRecording : public RecordingFiles {
protected:
    void put(const test::Drive& drive, const std::vector<Pose>& poses) const {
        std::filesystem::create_directories(data / "velodyne");
        std::vector<double> stamps;
        for (const Scan& scan : drive.scans) {
            write_bin(data / ("velodyne/" + number(scan.index) + ".bin"), scan.points,
                      std::vector<float>(scan.points.size(), 0.5F));
            stamps.push_back(scan.stamp);
        }
        write_times(data / "times.txt", stamps);
        if (!poses.empty()) write_poses_kitti(data / "poses.txt", poses);
    }
};

}  // namespace dynamic_filter::io
