// SPDX-License-Identifier: MIT
/// Traffic lights at a crossing for people: red for vehicles, and in the first part of it free for
/// those on foot.
#pragma once

namespace dynamic_filter::sim {

struct Signal {
    double at = 0.0;      ///< [m] along x
    double cycle = 75.0;  ///< [s] from one red to the next
    double red = 48.0;    ///< [s]
    double first = 0.0;   ///< [s] when one of the reds begins
    double settle = 3.0;  ///< [s] from red on, till the last vehicle is across
    double release =
        22.0;  ///< [s] from red on, till which people may set out; the rest clears the road
};

constexpr double stop_line = 3.5;  ///< [m] vehicles halt this far before the middle of the crossing

bool is_red(const Signal& signal, double t);

/// When somebody who stands at the kerb at a time may set out [s].
double may_walk(const Signal& signal, double t);

}  // namespace dynamic_filter::sim
