// SPDX-License-Identifier: MIT
/// The meshes of people, cyclists and vehicles. Limbs hang from their joint along -z; vehicles
/// stand on z = 0 and look along x.
#pragma once

#include <vector>

#include "mesh.hpp"

namespace dynamic_filter::sim {

enum class Prototype { torso, torso_with_pack, leg, arm, bicycle, thigh, shin, car, van, bus };

constexpr double thigh_length = 0.44;  ///< [m] of a cyclist
constexpr double shin_length = 0.46;

/// One mesh for each value of Prototype, in that order. People are 1.75 m tall.
std::vector<Mesh> prototypes();

Mesh car_mesh();
Mesh van_mesh();
Mesh bus_mesh();

}  // namespace dynamic_filter::sim
