// SPDX-License-Identifier: MIT
/// Vehicles that follow each other along a straight street, halt at lights and kerbs, and start one
/// after another: the Intelligent Driver Model (Treiber, Hennecke & Helbing, Phys. Rev. E 62,
/// 2000).
#pragma once

#include <vector>

#include "sim/bodies.hpp"
#include "sim/signal.hpp"

namespace dynamic_filter::sim {

/// A change to another distance from the middle of the street, between two positions along it.
struct Swerve {
    double from = 0.0, until = 0.0;  ///< [m] positions along the street
    double to = 0.0;                 ///< [m] y from `until` on
};

struct Halt {
    double at = 0.0;           ///< [m] position of the middle of the vehicle along the street
    double time = 0.0;         ///< [s] duration; 0: goes on at once if the way is free
    double not_before = -1e9;  ///< [s] earliest time to go on
    bool gives_way = false;    ///< goes on only if no vehicle comes where it will swerve
};

/// A driver. Its position along the street is `way` * x, which always increases.
struct Driver {
    VehicleKind kind = VehicleKind::car;
    double way = 1.0;                  ///< towards +x or -x
    double start = 0.0;                ///< [m] position along the street when the traffic begins
    double y = 0.0;                    ///< [m] y of the lane
    double speed = 7.0;                ///< [m/s] desired
    double gap = 2.0;                  ///< [m] to the vehicle ahead when both stand
    bool moving = true;                ///< at the start
    std::vector<Swerve> swerves = {};  ///< in the order of their positions
    std::vector<Halt> halts = {};      ///< in the order of their positions
};

/// y of the vehicle of a driver at a position along the street.
double lateral(const Driver& driver, double u);

/// Motion of all vehicles between two times [s]; parallel to the drivers.
std::vector<Ride> drive(const std::vector<Driver>& drivers, const std::vector<Signal>& signals,
                        double from, double until);

}  // namespace dynamic_filter::sim
