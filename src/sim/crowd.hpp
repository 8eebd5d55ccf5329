// SPDX-License-Identifier: MIT
/// Walking people by the social force model (Helbing & Molnar, Phys. Rev. E 51, 1995) with the
/// contact term of Helbing, Farkas & Vicsek (Nature 407, 2000).
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "obstacles.hpp"
#include "social_force.hpp"

namespace dynamic_filter::sim {

struct Waypoint {
    Eigen::Vector2d at = Eigen::Vector2d::Zero();
    double reach = 0.8;  ///< [m] counts as reached within
    double pause = 0.0;  ///< [s] to stand there
    bool gated = false;  ///< on the way from here on, wait until no vehicle comes
    Eigen::Vector2d face = Eigen::Vector2d::Zero();  ///< look here while standing; zero: nowhere
    /// When somebody who could go on at a time may do so (a light, a train's doors); empty: then.
    std::function<double(double)> release = {};
};

struct Walker {
    double height = 1.75;         ///< [m]
    double radius = 0.22;         ///< [m]
    double speed = 1.2;           ///< [m/s] desired
    std::vector<Waypoint> route;  ///< walked round and round
    std::size_t next = 0;         ///< waypoint ahead at the start
    Eigen::Vector2d start = Eigen::Vector2d::Zero();
    int company = -1;      ///< walkers of one company keep together
    bool luggage = false;  ///< a suitcase on wheels at the right hand
};

struct CrowdPlan {
    std::vector<Walker> walkers;
    DistanceField field;
    std::function<std::vector<Mover>(double)> movers;  ///< at a time [s], also beyond the duration
};

/// A walker at one moment.
struct Stride {
    Eigen::Vector2f position = Eigen::Vector2f::Zero();
    Eigen::Vector2f heading = Eigen::Vector2f::UnitX();  ///< unit vector
    float phase = 0.0F;                                  ///< [rad] of the gait, never wrapped
    float swing = 0.0F;                                  ///< [rad] largest angle of the legs
    float speed = 0.0F;                                  ///< [m/s] as really moved
};

constexpr double crowd_step = 0.05;  ///< [s]
constexpr double leg_length = 0.5;   ///< of the height

struct Crowd {
    std::size_t walkers = 0;
    std::vector<Stride> strides;  ///< step after step, walkers within
};

/// Strides for times 0, crowd_step, ... up to `duration` [s]; before that the crowd walks 15 s to
/// settle.
Crowd simulate_crowd(const CrowdPlan& plan, double duration);

Stride stride_at(const Crowd& crowd, std::size_t walker, double t);

}  // namespace dynamic_filter::sim
