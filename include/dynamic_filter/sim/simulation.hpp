// SPDX-License-Identifier: MIT
/// @file
/// Scenes with exact labels: a crowd (Sec. IV-A), a street, a square, a hall, a jam, a platform;
/// rays cast by Embree.
///
/// - Units: [m], [s], [deg].
/// - Frames: points in the sensor's, poses T_world_sensor; world: z up.
/// - Shapes: arrays of a scan are parallel.
/// - Ownership: values.
/// - Threads: a Simulation has a single caller (it uses parallel_for inside).
/// - Errors: ConfigError.
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

/// What to simulate.
struct SimulationOptions {
    std::string scene = "crowd";        ///< one of scene_names()
    std::string sensor = "vlp16";       ///< one of sensor_names()
    int pedestrians = -1;               ///< -1: the scene's own number (crowd: 100)
    std::uint64_t seed = 1;             ///< same seed, same bytes
    std::optional<std::size_t> frames;  ///< empty: the scene's full length (crowd: two rounds)
    double rate_hz = 0.0;               ///< [Hz] scans per second; 0: the scene's own
    double pose_noise_m = 0.0;          ///< [m] standard deviation of each axis of the written pose
    double pose_noise_deg = 0.0;        ///< [deg] standard deviation of each rotation axis
    /// Points are measured one after the other, in the time between two scans (0.2 s at most),
    /// while the sensor and all else move on: as a real sensor measures. Otherwise all at once.
    bool sweep = false;
    int rounds = 0;  ///< of the robot, where it goes in rounds; 0: the scene's own
};

/// One sweep, with all that is known of it.
struct SimulatedScan {
    Points points;                 ///< [m] sensor frame (of a sweep: where the sensor was when
                                   ///< it measured the point), returns only
    std::vector<float> intensity;  ///< 0..1, parallel
    Labels labels;                 ///< exact, parallel: still or dynamic
    std::vector<Kind> kinds;       ///< parallel
    std::vector<std::uint16_t> instances;  ///< parallel: the person or vehicle, from 1; 0: neither
    Pose T_world_sensor;       ///< as a SLAM would report it (with pose noise, if asked)
    double stamp = 0.0;        ///< [s] since the scene began; a sweep begins then
    std::vector<float> times;  ///< of a sweep: [s] from the stamp, parallel; else empty
};

std::vector<std::string> scene_names();   ///< what SimulationOptions::scene may be
std::vector<std::string> sensor_names();  ///< what SimulationOptions::sensor may be

/// Same options, same bytes. Throws ConfigError (unknown scene or sensor, naming the choices; more
/// frames than the scene has scans at its rate; rounds where the robot does not go in rounds).
/// scan() may be called in any order.
class Simulation {
public:
    explicit Simulation(const SimulationOptions& options);  ///< builds the scene
    ~Simulation();
    Simulation(Simulation&&) noexcept;  ///< the other one can only be destroyed

    [[nodiscard]] std::size_t size() const;           ///< scans
    [[nodiscard]] SimulatedScan scan(std::size_t i);  ///< scan i < size()

private:
    struct World;
    std::unique_ptr<World> world_;
};

}  // namespace dynamic_filter::sim
