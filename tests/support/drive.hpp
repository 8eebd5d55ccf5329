// SPDX-License-Identifier: MIT
/// Scans with the poses at which they were taken, tracked without, and how far that leads astray.
#pragma once

#include <vector>

#include "dynamic_filter/tracking.hpp"
#include "dynamic_filter/types.hpp"

namespace dynamic_filter::test {

struct Drive {
    std::vector<Scan> scans;  ///< without poses
    std::vector<Pose> truth;
};

inline std::vector<Tracked> track(const std::vector<Scan>& scans,
                                  const OdometryConfig& config = {}) {
    Odometry odometry(config);
    std::vector<Tracked> tracked;
    for (const Scan& scan : scans) {
        tracked.push_back(odometry.track(scan.points, scan.times, scan.stamp));
        odometry.learn({});
    }
    return tracked;
}

/// How far the motion from scan i to scan k is off.
inline Twist off_between(const Drive& drive, const std::vector<Tracked>& tracked, std::size_t i,
                         std::size_t k) {
    const Pose moved = drive.truth[i].inverse() * drive.truth[k];
    return log(moved.inverse() * tracked[i].T_world_sensor.inverse() * tracked[k].T_world_sensor);
}

/// Mean error of position at the end of each piece of so many metres, divided by its length.
/// Negative: the drive is shorter than a piece.
inline double drift(const Drive& drive, const std::vector<Tracked>& tracked, double piece = 10.0) {
    std::vector<double> way(drive.truth.size(), 0.0);
    for (std::size_t i = 1; i < way.size(); ++i) {
        way[i] =
            way[i - 1] + (drive.truth[i].translation() - drive.truth[i - 1].translation()).norm();
    }
    double sum = 0.0, count = 0.0;
    for (std::size_t i = 0, k = 0; i < way.size(); ++i) {
        while (k < way.size() && way[k] < way[i] + piece) ++k;
        if (k == way.size()) break;
        sum += off_between(drive, tracked, i, k).head<3>().norm() / (way[k] - way[i]);
        count += 1.0;
    }
    return count > 0.0 ? sum / count : -1.0;
}

inline std::size_t lost(const std::vector<Tracked>& tracked) {
    std::size_t count = 0;
    for (const Tracked& t : tracked) count += t.status == TrackStatus::lost;
    return count;
}

}  // namespace dynamic_filter::test
