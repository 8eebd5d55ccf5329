// SPDX-License-Identifier: MIT
/// Measures the error of the odometry against the poses of recordings.
///   odometry RECORDING...
#include "dynamic_filter/tracking.hpp"

#include <fmt/format.h>

#include <ctime>
#include <vector>

#include "bench/path_error.hpp"
#include "dynamic_filter/recording.hpp"

using namespace dynamic_filter;

namespace {

void measure(const char* path) {
    const io::Recording recording = io::open_recording(path);
    Odometry odometry{OdometryConfig{}};
    std::vector<Pose> truth, found;
    std::size_t weak = 0, lost = 0;
    std::clock_t clocks = 0;
    for (std::size_t i = 0; i < recording.size(); ++i) {
        const io::FullScan scan = recording.read(i);
        const std::clock_t start = std::clock();
        const auto times = io::point_times(scan.cloud, scan.stamp);
        const Tracked tracked = odometry.track(scan.points, times, scan.stamp);
        odometry.learn({});
        clocks += std::clock() - start;
        truth.push_back(scan.T_world_sensor);
        found.push_back(tracked.T_world_sensor);
        weak += tracked.status == TrackStatus::weak ? 1 : 0;
        lost += tracked.status == TrackStatus::lost ? 1 : 0;
    }
    print_errors(path, truth, found, fmt::format("weak {} lost {}", weak, lost), clocks);
}

}  // namespace

int main(int argc, char** argv) {
    for (int a = 1; a < argc; ++a) measure(argv[a]);
}
