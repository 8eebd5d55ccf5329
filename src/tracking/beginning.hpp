// SPDX-License-Identifier: MIT
/// Finds how fast the sensor moves when a recording begins.
#pragma once

#include <optional>
#include <span>

#include "dynamic_filter/motion.hpp"
#include "dynamic_filter/settings.hpp"
#include "dynamic_filter/types.hpp"

namespace dynamic_filter {

/// Number of scans that show how a recording begins.
constexpr std::size_t kBeginning = 10;

/// The velocity of the sensor at the first scans; empty if there are fewer than three. From two
/// scans alone, a sensor with few beams seems to stand still: its rings on the ground look the same
/// from everywhere, and so do cars that drive along. So several velocities are tried over all
/// scans, and the one wins with which the upright structures overlay best. Poses inside the scans
/// are not used.
std::optional<Twist> initial_velocity(std::span<const Scan> first, const OdometryConfig& config);

}  // namespace dynamic_filter
