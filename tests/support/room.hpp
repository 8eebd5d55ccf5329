// SPDX-License-Identifier: MIT
/// A room of plain walls, a box that walks through it, and a spinning sensor; rays are cast by
/// formula.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "dynamic_filter/types.hpp"

namespace dynamic_filter::test {

struct Box {
    Eigen::Vector3d low, high;
};

struct RoomScan {
    Scan scan;
    Labels truth;
};

/// Distances at which the ray enters and leaves the box; enter > leave: it misses.
inline std::pair<double, double> cross(const Box& box, const Eigen::Vector3d& from,
                                       const Eigen::Vector3d& ray) {
    const Eigen::Array3d a = (box.low - from).array() / ray.array();
    const Eigen::Array3d b = (box.high - from).array() / ray.array();
    return {a.min(b).maxCoeff(), a.max(b).minCoeff()};
}

struct Sensor {
    int rings = 16, columns = 240;
    double lowest_deg = -25.0, highest_deg = 25.0;
};

/// What a sensor at `pose` sees of the room from inside and of the walker, if there is one.
inline RoomScan scan_room(const Pose& pose, const Box& room, const std::vector<Box>& walkers,
                          const Sensor& sensor = {}) {
    RoomScan out;
    out.scan.T_world_sensor = pose;
    constexpr double kDeg = std::numbers::pi / 180.0;
    for (int c = 0; c < sensor.columns; ++c) {
        for (int r = 0; r < sensor.rings; ++r) {
            const double azimuth = (360.0 * c / sensor.columns + 0.1) * kDeg;
            const double elevation = (sensor.lowest_deg + (sensor.highest_deg - sensor.lowest_deg) *
                                                              r / (sensor.rings - 1)) *
                                     kDeg;
            const Eigen::Vector3d beam(std::cos(elevation) * std::cos(azimuth),
                                       std::cos(elevation) * std::sin(azimuth),
                                       std::sin(elevation));
            const Eigen::Vector3d from = pose.translation(), ray = pose.linear() * beam;
            double range = cross(room, from, ray).second;
            Label truth = Label::static_;
            for (const Box& walker : walkers) {
                const auto [enter, leave] = cross(walker, from, ray);
                if (enter > 0.0 && enter < leave && enter < range) {
                    range = enter;
                    truth = Label::dynamic;
                }
            }
            out.scan.points.push_back((range * beam).cast<float>());
            out.truth.push_back(truth);
        }
    }
    return out;
}

/// A drive of `count` scans, 2 per second, along x through a hall, turning slowly, while a person
/// crosses in front. Positions are multiples of 1/64 m, so that far origins do not round them.
inline std::vector<RoomScan> drive(std::size_t count, bool with_walker,
                                   const Eigen::Vector3d& origin = Eigen::Vector3d::Zero()) {
    const Box room{origin + Eigen::Vector3d(-6.03, -5.03, 0.02),
                   origin + Eigen::Vector3d(9.03, 5.03, 3.1)};
    std::vector<RoomScan> scans;
    for (std::size_t i = 0; i < count; ++i) {
        const auto t = static_cast<double>(i);
        Pose pose = Pose::Identity();
        pose.translation() = origin + Eigen::Vector3d(t / 16.0, 0.25, 1.25);
        pose.linear() = Eigen::AngleAxisd(0.01 * t, Eigen::Vector3d::UnitZ()).toRotationMatrix();
        std::vector<Box> walkers;
        if (with_walker) {
            const Eigen::Vector3d feet = origin + Eigen::Vector3d(5.5, 0.4 * t - 4.5, 0.02);
            walkers.push_back(
                {feet - Eigen::Vector3d(0.25, 0.25, 0.0), feet + Eigen::Vector3d(0.25, 0.25, 1.7)});
        }
        scans.push_back(scan_room(pose, room, walkers));
        scans.back().scan.stamp = 0.5 * t;
        scans.back().scan.index = i;
    }
    return scans;
}

}  // namespace dynamic_filter::test
