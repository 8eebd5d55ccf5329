// SPDX-License-Identifier: MIT
/// One scan: rays, noise, lost returns. A snapshot: everything stands still while it is taken.
#pragma once

#include <cstdint>
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
};

Returns sense(const Caster& caster, const Sensor& sensor, const Pose& T_world_sensor,
              std::uint64_t seed, std::size_t scan);

}  // namespace dynamic_filter::sim
