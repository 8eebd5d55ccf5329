// SPDX-License-Identifier: MIT
/// The meshes of people, cyclists and vehicles. Limbs hang from their joint along -z; vehicles
/// stand on z = 0 and look along x.
#pragma once

#include <vector>

#include "mesh.hpp"

namespace dynamic_filter::sim {

enum class Prototype {
    torso,
    torso_with_pack,
    leg,
    arm,
    bicycle,
    thigh,
    shin,
    car,
    van,
    bus,
    suitcase,
    wagon,
    fore_doors,  ///< the leaves that slide forward to open ...
    aft_doors    ///< ... and backward
};

constexpr double thigh_length = 0.44;  ///< [m] of a cyclist
constexpr double shin_length = 0.46;

/// A wagon's floor is at z = 0, level with the platform, which is on its right.
constexpr double wagon_half_length = 9.5, wagon_half_width = 1.4;
constexpr double wagon_doors[] = {-6.0, 0.0, 6.0};  ///< [m] along x
constexpr double door_leaf = 0.7;                   ///< [m] half the width of a door

/// One mesh for each value of Prototype, in that order. People are 1.75 m tall.
std::vector<Mesh> prototypes();

Mesh car_mesh();
Mesh van_mesh();
Mesh bus_mesh();
Mesh wagon_mesh();                ///< with open doorways on the right and windows without panes
Mesh doors_mesh(double forward);  ///< +1: the leaves in front of the doors' middles; -1: behind

}  // namespace dynamic_filter::sim
