// SPDX-License-Identifier: MIT
/// A city without end: streets in a grid, with blocks of houses between them. Each block is made
/// from the seed and its position alone, when a vehicle comes near, so the size of the city costs
/// nothing. The same holds for the traffic, which is made around the vehicle. Streets run along x
/// and y through the nodes of the grid; traffic drives on the right.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/bodies.hpp"
#include "sim/mesh.hpp"
#include "sim/prototypes.hpp"
#include "sim/random.hpp"
#include "sim/scene.hpp"

namespace dynamic_filter::sim::city {

// [m] from the middle of a street.
constexpr double lane = 1.75, cycle_lane = 3.2, parking = 4.6, kerb = 5.7, front = 10.0;
constexpr double pavement = 0.15;       // [m] above the street
constexpr double bay_width = 3.6;       // [m] of the houses
constexpr int bays_along[] = {25, 18};  ///< of the houses of a block that look at a street along x
                                        ///< and along y
constexpr double pitch[] = {bays_along[0] * bay_width + 2.0 * front,
                            bays_along[1] * bay_width + 2.0 * front};  ///< [m] between streets
constexpr int most_blocks = 23;  ///< in x and y that have numbers for their parked cars
constexpr int reserve = 2;       ///< blocks around those of the route that can be seen from it

/// A block lies between the streets of number x and x + 1, y and y + 1.
struct Block {
    int x = 0;
    int y = 0;
};

/// One of the four sides of a block: `along` its street, whose middle is at zero `inward`.
struct Side {
    Eigen::Vector2d corner;  ///< the node where it begins
    Eigen::Vector2d along;   ///< with the block on the left
    Eigen::Vector2d inward;
    double length = 0.0;  ///< [m] to the next node
    int bays = 0;

    [[nodiscard]] Eigen::Vector2d at(double u, double v) const {
        return corner + u * along + v * inward;
    }
};
Side side_of(const Block& block, int side);

Eigen::Vector2d node(int x, int y);

/// Height of the ground.
double ground(const Eigen::Vector2d& p);

std::uint64_t block_seed(std::uint64_t seed, const Block& block);

/// Prototypes of the city, after those of prototypes(). A name is that of the first of several.
constexpr int house_bays[] = {3, 6};  ///< least and most
constexpr int houses_of_a_size = 6, trees = 8, planters = 3;
enum Thing : std::size_t {
    slab = static_cast<std::size_t>(Prototype::load) + 1,
    house,
    tree = house + static_cast<std::size_t>(houses_of_a_size * (house_bays[1] - house_bays[0] + 1)),
    planter = tree + static_cast<std::size_t>(trees),
    bench = planter + static_cast<std::size_t>(planters),
    bin,
    lamp,
    sign,
    fence,
    pallet,
    barrier,
    things
};
constexpr double fence_length = 3.5;  ///< [m] of one panel

/// All prototypes: those of prototypes() and one mesh per Thing.
std::vector<Mesh> library(std::uint64_t seed);

/// A thing that rests at its place during a drive.
struct Fixture {
    Part part;
    Placement placement;
};

/// A frame at a place; its x axis looks along `axis`.
Eigen::Affine3f standing(const Eigen::Vector2d& at, const Eigen::Vector2d& axis, double z,
                         double scale = 1.0);

/// What is there in all drives, but for parked cars.
std::vector<Fixture> block_fixtures(std::uint64_t seed, const Block& block);

/// One of several drives on different days.
struct Day {
    int drive = 1;   ///< from 1
    int drives = 1;  ///< of all
};

/// Number of places at the kerb of a side, and the distance of the middle of one from the corner.
int places(const Side& side);
double place_at(int place);

/// The car at a place in a drive: 0 none, otherwise 1 or 2.
int car_at(std::uint64_t seed, const Block& block, int side, int place, int drive);

/// A building site closes a part of the row of parked cars from one drive on.
struct Site {
    int first_drive = 0;  ///< 0: never
    int first_place = 0;
    int places = 0;
};
Site site_at(std::uint64_t seed, const Block& block, int side);

/// Parked cars and sites. Those that are not there in every drive are Kind::temporary and have a
/// number, which is the same in all drives.
std::vector<Fixture> parked(std::uint64_t seed, const Block& block, const Day& day);

/// A part of the route between two nodes.
struct Leg {
    Eigen::Vector2d from, to;  ///< nodes
    double begin = 0.0;        ///< [m] along the route
    double end = 0.0;          ///< [m]
    double enters = 0.0;       ///< [s]
    double leaves = 0.0;       ///< [s]
};

struct Route {
    Ride ride;
    std::vector<Leg> legs;
    double duration = 0.0;  ///< [s]
};

/// Blocks of the city in x and y through which routes of a length lead.
int blocks_across(double km);

/// The way of one drive. It prefers streets that it did not take before.
Route route(std::uint64_t seed, double km, int drive);

/// A vehicle or a person. Both move along a path; a person stands where the speed is zero.
struct Actor {
    Vehicle vehicle;  ///< of a person: the ride alone
    Walker walker;
    bool on_foot = false;
    double from = 0.0;   ///< [s]
    double until = 0.0;  ///< [s]
};

/// Traffic and people around the route: `people` per leg. They meet neither the vehicle nor each
/// other.
std::vector<Actor> actors(std::uint64_t seed, const Route& route, int people, int drive);

Stride stride_of(const Actor& actor, double t);

}  // namespace dynamic_filter::sim::city
