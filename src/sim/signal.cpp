// SPDX-License-Identifier: MIT
#include "sim/signal.hpp"

#include <cmath>

namespace dynamic_filter::sim {
namespace {

/// Time [s] since the latest red began.
double into_cycle(const Signal& signal, double t) {
    const double since = t - signal.first;
    return since - signal.cycle * std::floor(since / signal.cycle);
}

}  // namespace

bool is_red(const Signal& signal, double t) { return into_cycle(signal, t) < signal.red; }

double may_walk(const Signal& signal, double t) {
    const double since = into_cycle(signal, t);
    if (since < signal.settle) return t + signal.settle - since;
    if (since < signal.release) return t;
    return t + signal.cycle + signal.settle - since;
}

}  // namespace dynamic_filter::sim
