// SPDX-License-Identifier: MIT
/// Meshes of people, cyclists and vehicles. Limbs hang from their joint along -z. Vehicles stand on
/// z = 0 and look along x.
#pragma once

#include <vector>

#include "sim/mesh.hpp"

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
    fore_doors,  ///< the door leaves that slide forward to open
    aft_doors,   ///< the door leaves that slide backward to open
    gate,        ///< slides along x
    load         ///< hangs from ropes, just above the ground
};

constexpr float cloth = 0.45F, paint = 0.6F, metal = 0.4F;  ///< reflectivities

constexpr double thigh_length = 0.44;  ///< [m] of a cyclist
constexpr double shin_length = 0.46;

/// The floor of a wagon is at z = 0, level with the platform, which is on the right side.
constexpr double wagon_half_length = 9.5, wagon_half_width = 1.4;
constexpr double wagon_doors[] = {-6.0, 0.0, 6.0};  ///< [m] along x
constexpr double door_leaf = 0.7;                   ///< [m] half the width of a door

inline const Eigen::Vector2d gate_size{3.0, 0.2}, load_size{2.4, 1.6};  ///< [m] along x, along y

/// One mesh per value of Prototype, in that order. People are 1.75 m tall.
std::vector<Mesh> prototypes();

Mesh car_mesh();
Mesh van_mesh();
Mesh bus_mesh();
Mesh wagon_mesh();  ///< with open doorways on the right and windows without panes
Mesh gate_mesh();   ///< closed below, of bars above
Mesh load_mesh();
/// +1: the leaves in front of the middle of each door; -1: those behind it.
Mesh doors_mesh(double forward);

}  // namespace dynamic_filter::sim
