// SPDX-License-Identifier: MIT
/// Follows a beam through panes and off mirrors.
#pragma once

#include "sim/caster.hpp"

namespace dynamic_filter::sim {

/// The return that a sensor reports for a beam. Where the beam meets a smooth surface, the
/// strongest of three counts: that of the surface itself (its dirt, and its glare near normal
/// incidence), that of what the beam meets behind it, and that of what it meets in the mirror. The
/// range of the last is the length of the whole way, so the sensor takes the point to lie behind
/// the surface; its kind is Kind::reflection. `direction` is a unit vector; ways longer than
/// `reach` [m] are not found.
Hit strongest_return(const Caster& caster, const Eigen::Vector3f& origin,
                     const Eigen::Vector3f& direction, float reach);

}  // namespace dynamic_filter::sim
