// SPDX-License-Identifier: MIT
#include <dynamic_filter/simulation.hpp>

int main() {
    dynamic_filter::sim::SimulationOptions options;
    options.frames = 1;
    return dynamic_filter::sim::Simulation(options).scan(0).points.empty() ? 1 : 0;
}
