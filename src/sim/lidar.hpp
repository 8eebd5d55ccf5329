// SPDX-License-Identifier: MIT
/// One scan: rays, noise, lost returns. A snapshot, or one part after another while things move.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "caster.hpp"
#include "dynamic_filter/types.hpp"
#include "sensors.hpp"

namespace dynamic_filter::sim {

struct Returns {
    Points points;  ///< sensor frame
    std::vector<float> intensity;
    Labels labels;
    std::vector<Kind> kinds;
    std::vector<std::uint16_t> instances;  ///< 0: stands still
    std::vector<float> shares;             ///< 0..1: which part of the sweep had passed
};

/// Everything at once.
Returns sense(const Caster& caster, const Sensor& sensor, const Pose& T_world_sensor,
              std::uint64_t seed, std::size_t scan);

/// The sensor while its rays turn: T_world_sensor of a share of the sweep, 0..1.
using SweepPose = std::function<Pose(double)>;

/// In slices of equal duration, in each of which the sensor moves evenly; `begin_slice` is told the
/// share of the sweep in its middle, and puts things where they are then. Points are in the sensor
/// frame of their own moment.
Returns sweep(const Caster& caster, const Sensor& sensor, const SweepPose& T_world_sensor,
              const std::function<void(double)>& begin_slice, std::uint64_t seed, std::size_t scan);

}  // namespace dynamic_filter::sim
