// SPDX-License-Identifier: MIT
/// Simulates pedestrians by the social force model (Helbing & Molnar, Phys. Rev. E 51, 1995), with
/// the contact term of Helbing, Farkas & Vicsek (Nature 407, 2000).
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "sim/obstacles.hpp"
#include "sim/social_force.hpp"

namespace dynamic_filter::sim {

struct Waypoint {
    Eigen::Vector2d at = Eigen::Vector2d::Zero();
    double reach = 0.8;  ///< [m] distance at which the waypoint counts as reached
    double pause = 0.0;  ///< [s] pause there
    bool gated = false;  ///< true: from here on, the walker waits until no vehicle comes
    /// Direction to look in during the pause; zero: none.
    Eigen::Vector2d face = Eigen::Vector2d::Zero();
    /// Earliest time at which a walker who could go on at a given time may do so (because of a
    /// light or of the doors of a train). Empty: at that time.
    std::function<double(double)> release = {};
};

struct Walker {
    double height = 1.75;         ///< [m]
    double radius = 0.22;         ///< [m]
    double speed = 1.2;           ///< [m/s] desired
    std::vector<Waypoint> route;  ///< closed: after the last waypoint comes the first
    std::size_t next = 0;         ///< index of the first target
    Eigen::Vector2d start = Eigen::Vector2d::Zero();
    int company = -1;      ///< walkers with the same number stay together
    bool luggage = false;  ///< pulls a suitcase on wheels with the right hand
};

struct CrowdPlan {
    std::vector<Walker> walkers;
    DistanceField field;
    /// State at a time [s], also beyond the duration.
    std::function<std::vector<Mover>(double)> movers;
};

/// The state of a walker at one time.
struct Stride {
    Eigen::Vector2f position = Eigen::Vector2f::Zero();
    Eigen::Vector2f heading = Eigen::Vector2f::UnitX();  ///< unit vector
    float phase = 0.0F;                                  ///< [rad] phase of the gait, not wrapped
    float swing = 0.0F;                                  ///< [rad] largest angle of the legs
    float speed = 0.0F;                                  ///< [m/s] of the real motion
};

constexpr double crowd_step = 0.05;  ///< [s]
constexpr double leg_length = 0.5;   ///< share of the height

struct Crowd {
    std::size_t walkers = 0;
    std::vector<Stride> strides;  ///< time after time: the state of each walker
};

/// States at the times 0, crowd_step, ... up to `duration` [s]. Before time 0, the crowd walks 15 s
/// until its motion is natural.
Crowd simulate_crowd(const CrowdPlan& plan, double duration);

Stride stride_at(const Crowd& crowd, std::size_t walker, double t);

}  // namespace dynamic_filter::sim
