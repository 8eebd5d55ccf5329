// SPDX-License-Identifier: MIT
/// Poses of the rigid parts of people, cyclists and vehicles at a given time.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "sim/caster.hpp"
#include "sim/crowd.hpp"
#include "sim/path.hpp"

namespace dynamic_filter::sim {

enum class VehicleKind { car, van, bus, cyclist, wagon, gate, load };

struct Vehicle {
    VehicleKind kind = VehicleKind::car;
    Ride ride;
    float brightness = 1.0F;
};

/// Half of the length and half of the width [m].
Eigen::Vector2d half_footprint(VehicleKind kind);

std::vector<Part> walker_parts(std::size_t index, bool luggage = false);
std::vector<Part> vehicle_parts(const Vehicle& vehicle);

using Placements = std::vector<Placement>;

/// Appends the placements of the parts of a walker, in the order of walker_parts(); `ground` is the
/// height of the floor there.
void place_walker(const Walker& walker, const Stride& stride, double ground, Placements& out);

/// The same for vehicle_parts(), at a time [s].
void place_vehicle(const Vehicle& vehicle, double t, Placements& out);

/// How far the doors of a wagon are open, 0 to 1. They open only while the wagon stands.
double door_opening(const Ride& ride, double t);

/// Appends discs that cover the vehicle, to which people on foot yield. Wagons get none: people
/// stay on the platform anyway, and must be able to get in.
void add_movers(const Vehicle& vehicle, double t, std::vector<Mover>& out);

}  // namespace dynamic_filter::sim
