// SPDX-License-Identifier: MIT
/// Street furniture and house facades. Each function adds a mesh to the scene, and an obstacle if
/// people could walk into the object.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/scene.hpp"

namespace dynamic_filter::sim {

/// A frame in the ground plane: the position of an object and the direction of its x axis.
struct Spot {
    Eigen::Vector2d at = Eigen::Vector2d::Zero();
    Eigen::Vector2d axis = Eigen::Vector2d::UnitX();
    double z = 0.0;
};

/// Positions of the objects in a row: first, first + step, ... below `end`.
std::vector<double> row(double first, double end, double step);

void add_ground(Scene& scene, const Eigen::AlignedBox2d& area, double z, float reflectivity);

/// A box that stands on the spot, `size` = length along the axis, width, height.
void add_block(Scene& scene, const Spot& spot, const Eigen::Vector3d& size, float reflectivity);

void add_column(Scene& scene, const Spot& spot, double radius, double height);
void add_bench(Scene& scene, const Spot& spot);
void add_planter(Scene& scene, const Spot& spot, std::uint64_t seed);
void add_sign(Scene& scene, const Spot& spot);
/// Posts and a bar along the axis.
void add_railing(Scene& scene, const Spot& spot, double length);
void add_bin(Scene& scene, const Spot& spot);
void add_lamp(Scene& scene, const Spot& spot, double height);
void add_tree(Scene& scene, const Spot& spot, double height, std::uint64_t seed);
void add_parked_car(Scene& scene, const Spot& spot, float brightness);

enum class Bay { wall, recess, shop, door };

struct Facade {
    /// Left end of the facade seen from the street; x along the facade, y into the house.
    Spot spot;
    std::vector<Bay> bays;
    double bay_width = 4.0;
    double ground_floor = 3.4;  ///< [m] its height
    int upper_floors = 2;
    double room_depth = 2.5;  ///< [m] of shops and of the rooms behind doors
    std::uint64_t seed = 0;   ///< for the furniture of the rooms
};

/// Windows have reveals and sills. Beams enter shops, but people do not; both enter doors.
void add_facade(Scene& scene, const Facade& facade);

/// The middle of the doorway of a bay, and a place in the room behind it.
Eigen::Vector2d doorway(const Facade& facade, std::size_t bay);
Eigen::Vector2d behind_door(const Facade& facade, std::size_t bay);

}  // namespace dynamic_filter::sim
