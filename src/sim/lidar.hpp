// SPDX-License-Identifier: MIT
/// Simulates one scan: rays, noise and lost returns. All rays are cast at once, or in parts while
/// objects move.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "dynamic_filter/types.hpp"
#include "sim/caster.hpp"
#include "sim/sensors.hpp"

namespace dynamic_filter::sim {

struct Returns {
    Points points;  ///< sensor frame
    std::vector<float> intensity;
    Labels labels;
    std::vector<Kind> kinds;
    std::vector<std::uint16_t> instances;  ///< 0: static object
    std::vector<float> shares;             ///< 0..1: elapsed share of the sweep
};

/// Casts all rays at the same time.
Returns sense(const Caster& caster, const Sensor& sensor, const Pose& T_world_sensor,
              std::uint64_t seed, std::size_t scan);

/// Motion of the sensor during a sweep: T_world_sensor at a share of the sweep, 0..1.
using SweepPose = std::function<Pose(double)>;

/// Casts the rays in slices of equal duration; the sensor moves evenly in each slice. `begin_slice`
/// gets the share of the sweep at the middle of the slice, and moves the objects to that time. Each
/// point is in the sensor frame at its own time.
Returns sweep(const Caster& caster, const Sensor& sensor, const SweepPose& T_world_sensor,
              const std::function<void(double)>& begin_slice, std::uint64_t seed, std::size_t scan);

}  // namespace dynamic_filter::sim
