// SPDX-License-Identifier: MIT
/// How far the odometry is off the poses of recordings.
///   odometry RECORDING...
#include <fmt/format.h>

#include <ctime>
#include <string>
#include <vector>

#include "dynamic_filter/io/sequence.hpp"
#include "dynamic_filter/odometry/odometry.hpp"

using namespace dynamic_filter;

namespace {

struct Off {
    double shift = 0.0, turn = 0.0;  // share of the way [%], [deg/m]
    std::size_t count = 0;
};

/// Mean error of all pieces of the way that are so long.
Off error_over(const std::vector<Pose>& truth, const std::vector<Pose>& found, double length) {
    Off off;
    std::vector<double> way(truth.size(), 0.0);
    for (std::size_t i = 1; i < truth.size(); ++i) {
        way[i] = way[i - 1] + (truth[i].translation() - truth[i - 1].translation()).norm();
    }
    for (std::size_t i = 0, j = 0; i < truth.size(); ++i) {
        while (j < truth.size() && way[j] - way[i] < length) ++j;
        if (j == truth.size()) break;
        const Pose error =
            (truth[i].inverse() * truth[j]).inverse() * (found[i].inverse() * found[j]);
        off.shift += 100.0 * error.translation().norm() / (way[j] - way[i]);
        off.turn += 57.2957795 * Eigen::AngleAxisd(error.linear()).angle() / (way[j] - way[i]);
        ++off.count;
    }
    if (off.count > 0) {
        off.shift /= static_cast<double>(off.count);
        off.turn /= static_cast<double>(off.count);
    }
    return off;
}

}  // namespace

int main(int argc, char** argv) {
    for (int a = 1; a < argc; ++a) {
        const io::Sequence sequence = io::open_sequence(argv[a]);
        Odometry odometry{OdometryConfig{}};
        std::vector<Pose> truth, found;
        std::size_t weak = 0, lost = 0;
        double worst = 0.0, inliers = 0.0;
        std::clock_t clocks = 0;
        for (std::size_t i = 0; i < sequence.size(); ++i) {
            const io::Frame frame = io::read_frame(sequence, i);
            const std::clock_t start = std::clock();
            const auto times = io::point_times(frame.cloud, frame.stamp);
            const Tracked tracked = odometry.track(frame.points, times, frame.stamp);
            odometry.learn({});
            clocks += std::clock() - start;
            truth.push_back(frame.T_world_sensor);
            found.push_back(tracked.T_world_sensor);
            inliers += tracked.inliers;
            weak += tracked.status == TrackStatus::weak ? 1 : 0;
            lost += tracked.status == TrackStatus::lost ? 1 : 0;
            if (i > 0) {
                const Pose step = (truth[i - 1].inverse() * truth[i]).inverse() *
                                  (found[i - 1].inverse() * found[i]);
                worst = std::max(worst, step.translation().norm());
            }
        }
        const Off ten = error_over(truth, found, 10.0), hundred = error_over(truth, found, 100.0);
        const Pose end = truth.front().inverse() * truth.back();
        const Pose end_found = found.front().inverse() * found.back();
        fmt::print(
            "{:<28} {:5} scans  10 m: {:.3f} % {:.4f} deg/m  100 m: {:.3f} % {:.4f} deg/m ({})  "
            "end {:.2f} m  worst step {:.3f} m  weak {} lost {}  inliers {:.2f}  {:.1f} ms\n",
            argv[a], sequence.size(), ten.shift, ten.turn, hundred.shift, hundred.turn,
            hundred.count, (end.translation() - end_found.translation()).norm(), worst, weak, lost,
            inliers / static_cast<double>(sequence.size()),
            1e3 * static_cast<double>(clocks) / CLOCKS_PER_SEC /
                static_cast<double>(sequence.size()));
    }
}
