// SPDX-License-Identifier: MIT
/// Where the rigid parts of people, cyclists and vehicles are at a moment.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "caster.hpp"
#include "crowd.hpp"
#include "path.hpp"

namespace dynamic_filter::sim {

enum class VehicleKind { car, van, bus, cyclist };

struct Vehicle {
    VehicleKind kind = VehicleKind::car;
    Ride ride;
    float brightness = 1.0F;
};

/// Half the length and half the width [m].
Eigen::Vector2d half_footprint(VehicleKind kind);

std::vector<Part> walker_parts(std::size_t index);
std::vector<Part> vehicle_parts(const Vehicle& vehicle);

using Placements = std::vector<Placement>;

/// Appends the placements of the parts, in the order of walker_parts(); `ground` is the height of
/// the floor there.
void place_walker(const Walker& walker, const Stride& stride, double ground, Placements& out);

/// The same for vehicle_parts(), at a time [s].
void place_vehicle(const Vehicle& vehicle, double t, Placements& out);

/// Discs that cover the vehicle, for those on foot to yield to.
void add_movers(const Vehicle& vehicle, double t, std::vector<Mover>& out);

}  // namespace dynamic_filter::sim
