// SPDX-License-Identifier: MIT
/// Traffic lights at a pedestrian crossing: red for vehicles; people may cross in the first part of
/// the red.
#pragma once

namespace dynamic_filter::sim {

struct Signal {
    double at = 0.0;        ///< [m] along x
    double cycle = 75.0;    ///< [s] from one red to the next
    double red = 48.0;      ///< [s]
    double first = 0.0;     ///< [s] start of one of the reds
    double settle = 3.0;    ///< [s] from the start of red until the last vehicle has passed
    double release = 22.0;  ///< [s] from the start of red until which people may start to cross
};

/// [m] distance of the stop line from the middle of the crossing.
constexpr double stop_line = 3.5;

bool is_red(const Signal& signal, double t);

/// Time [s] at which a person who is at the kerb at a given time may start to cross.
double may_walk(const Signal& signal, double t);

}  // namespace dynamic_filter::sim
