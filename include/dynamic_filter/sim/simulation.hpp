// SPDX-License-Identifier: MIT
/// Scenes with exact labels: a crowd (Sec. IV-A), a street, a square, a hall; rays cast by Embree.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dynamic_filter/sim/kind.hpp"
#include "dynamic_filter/types.hpp"

namespace dynamic_filter::sim {

struct SimulationOptions {
    std::string scene = "crowd";   ///< one of scene_names()
    std::string sensor = "vlp16";  ///< one of sensor_names()
    int pedestrians = -1;          ///< -1: the scene's own number (crowd: 100)
    std::uint64_t seed = 1;
    std::optional<std::size_t> frames;  ///< empty: the scene's full length (crowd: two rounds)
    double rate_hz = 0.0;               ///< scans per second; 0: the scene's own
    double pose_noise_m = 0.0;          ///< [m] standard deviation of each axis of the written pose
    double pose_noise_deg = 0.0;        ///< [deg] standard deviation of each rotation axis
};

struct SimulatedScan {
    Points points;                 ///< sensor frame, returns only
    std::vector<float> intensity;  ///< 0..1, parallel
    Labels labels;                 ///< exact, parallel: still or dynamic
    std::vector<Kind> kinds;       ///< parallel
    Pose T_world_sensor;           ///< as a SLAM would report it (with pose noise, if asked)
    double stamp = 0.0;
};

std::vector<std::string> scene_names();
std::vector<std::string> sensor_names();

/// Same options, same bytes. Throws ConfigError (unknown scene or sensor, naming the choices; more
/// frames than the scene has scans at its rate).
/// scan() may be called in any order; single caller (it uses parallel_for inside).
class Simulation {
public:
    explicit Simulation(const SimulationOptions& options);
    ~Simulation();
    Simulation(Simulation&&) noexcept;

    [[nodiscard]] std::size_t size() const;
    [[nodiscard]] SimulatedScan scan(std::size_t i);

private:
    struct World;
    std::unique_ptr<World> world_;
};

}  // namespace dynamic_filter::sim
