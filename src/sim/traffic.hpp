// SPDX-License-Identifier: MIT
/// Drivers who follow each other along a straight street, halt at lights and kerbs and pull off one
/// after another: the Intelligent Driver Model (Treiber, Hennecke & Helbing, Phys. Rev. E 62,
/// 2000).
#pragma once

#include <vector>

#include "bodies.hpp"
#include "signal.hpp"

namespace dynamic_filter::sim {

/// A change to another distance from the middle of the street, between two places of the way.
struct Swerve {
    double from = 0.0, until = 0.0;  ///< [m] of the way
    double to = 0.0;                 ///< [m] y from `until` on
};

struct Halt {
    double at = 0.0;           ///< [m] of the way, of the middle of the vehicle
    double time = 0.0;         ///< [s] to stand; 0: only to give way, and on at once if it is free
    double not_before = -1e9;  ///< [s] and not to go on earlier
    bool gives_way = false;    ///< goes on when nobody comes where it will swerve
};

/// The way of a driver is `way` * x: it always grows.
struct Driver {
    VehicleKind kind = VehicleKind::car;
    double way = 1.0;                  ///< towards +x or -x
    double start = 0.0;                ///< [m] of the way, when the traffic begins
    double y = 0.0;                    ///< [m] of the lane
    double speed = 7.0;                ///< [m/s] desired
    double gap = 2.0;                  ///< [m] to the one ahead when both stand
    bool moving = true;                ///< at the start
    std::vector<Swerve> swerves = {};  ///< in the order of the way
    std::vector<Halt> halts = {};      ///< likewise
};

/// y of the driver's vehicle at a place of its way.
double lateral(const Driver& driver, double u);

/// The rides of all, from one time to another [s]; parallel to the drivers.
std::vector<Ride> drive(const std::vector<Driver>& drivers, const std::vector<Signal>& signals,
                        double from, double until);

}  // namespace dynamic_filter::sim
