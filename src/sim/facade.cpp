// SPDX-License-Identifier: MIT
#include <algorithm>

#include "sim/props.hpp"
#include "sim/random.hpp"

namespace dynamic_filter::sim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double wall_thickness = 0.3;
constexpr double floor_height = 3.0;
constexpr double door_half_width = 0.9;
constexpr double door_height = 2.3;
constexpr float plaster = 0.5F, timber = 0.3F, pane = 0.15F, stone = 0.4F;

/// Places the boxes of one facade, given in the frame of the facade.
struct Front {
    Scene& scene;
    const Facade& facade;
    Eigen::Affine3d T;

    void box(const Vector3d& low, const Vector3d& high, float reflectivity) const {
        add_box(scene.still, T, {low, high}, reflectivity);
    }
    /// A box from the floor up, through which people cannot walk.
    void solid(const Vector2d& low, const Vector2d& high, double top, float reflectivity) const {
        box({low.x(), low.y(), 0}, {high.x(), high.y(), top}, reflectivity);
        const Vector2d middle = (low + high) / 2;
        scene.obstacles.push_back({.centre = (T * Vector3d(middle.x(), middle.y(), 0)).head<2>(),
                                   .half = (high - low) / 2,
                                   .axis = facade.spot.axis});
    }
};

/// Adds the room behind x0..x1: back and side walls, ceiling, and furniture at the back.
void add_room(const Front& front, double x0, double x1, Random& random) {
    const double depth = front.facade.room_depth, top = front.facade.ground_floor;
    front.solid({x0, depth}, {x1, depth + wall_thickness}, top, plaster);
    front.solid({x0, 0}, {x0 + 0.1, depth}, top, plaster);
    front.solid({x1 - 0.1, 0}, {x1, depth}, top, plaster);
    front.box({x0, 0, top - 0.1}, {x1, depth, top}, plaster);
    for (const double x : row(x0 + 0.3, x1 - 0.9, 1.0)) {  // shelves
        const double height = random.uniform(1.2, 2.6);
        for (const double z : row(0.1, height, 0.45)) {
            front.box({x, depth - 0.4, z}, {x + 0.9, depth, z + 0.04}, timber);
            const double goods = random.uniform(0.3, 0.85);
            front.box({x + 0.05, depth - 0.3, z + 0.04},
                      {x + goods, depth - 0.05, z + random.uniform(0.1, 0.35)}, stone);
        }
    }
}

void add_shop(const Front& front, double x0, double x1, Random& random) {
    add_room(front, x0, x1, random);
    // Below the window pane, which a LiDAR does not see.
    front.solid({x0, 0}, {x1, 0.15}, 0.45, stone);
    front.box({x0, 0, 2.7}, {x1, 0.3, front.facade.ground_floor}, plaster);
    for (const double x : {x0, (x0 + x1) / 2 - 0.04, x1 - 0.08}) {
        front.box({x, 0.02, 0.45}, {x + 0.08, 0.1, 2.7}, stone);
    }
    if (random.chance(0.6))
        front.box({x0 + 0.2, -0.9, 2.75}, {x1 - 0.2, 0, 2.85}, timber);  // awning
    for (int i = 0; i < 3; ++i) {                                        // displays
        const double x = x0 + 0.4 + (x1 - x0 - 1.2) * i / 2.0;
        front.box({x, 0.5, 0}, {x + random.uniform(0.3, 0.6), 1.0, random.uniform(0.7, 1.6)},
                  timber);
    }
}

void add_door(const Front& front, double x0, double x1) {
    const double middle = (x0 + x1) / 2, depth = front.facade.room_depth,
                 top = front.facade.ground_floor;
    front.solid({x0, 0}, {middle - door_half_width, wall_thickness}, top, plaster);
    front.solid({middle + door_half_width, 0}, {x1, wall_thickness}, top, plaster);
    front.box({middle - door_half_width, 0, door_height},
              {middle + door_half_width, wall_thickness, top}, plaster);
    front.solid({x0, depth}, {x1, depth + wall_thickness}, top, plaster);
    front.solid({x0, 0}, {x0 + 0.1, depth}, top, plaster);
    front.solid({x1 - 0.1, 0}, {x1, depth}, top, plaster);
    front.box({x0, 0, top - 0.1}, {x1, depth, top}, plaster);
    for (const double side : {-1.0, 1.0}) {
        const double x = middle + side * (door_half_width + 0.1);
        front.box({x - 0.12, -0.08, 0}, {x + 0.12, 0, door_height + 0.2}, stone);
    }
}

void add_recess(const Front& front, double x0, double x1) {
    const double top = front.facade.ground_floor;
    front.solid({x0, 0}, {x0 + 0.4, 1.2}, top, plaster);
    front.solid({x1 - 0.4, 0}, {x1, 1.2}, top, plaster);
    front.solid({x0, 1.2}, {x1, 1.5}, top, plaster);
    front.box({x0 + 0.9, 1.1, 0}, {x1 - 0.9, 1.2, 2.2}, timber);
    front.box({x0, 0, 2.8}, {x1, 1.2, top}, plaster);
}

void add_wall(const Front& front, double x0, double x1) {
    front.solid({x0, 0}, {x1, wall_thickness}, front.facade.ground_floor, plaster);
    front.solid({x0, -0.12}, {x0 + 0.5, 0}, front.facade.ground_floor, stone);  // pilaster
    front.box({x0 + 0.5, -0.06, 0}, {x1, 0, 0.7}, stone);
}

/// One window of a floor, with its reveal and sill.
void add_window(const Front& front, double x0, double x1, double z) {
    const double left = x0 + 0.3 * (x1 - x0), right = x1 - 0.3 * (x1 - x0);
    const double bottom = z + 0.9, top = z + 2.4;
    front.box({x0, 0, z}, {left, wall_thickness, z + floor_height}, plaster);
    front.box({right, 0, z}, {x1, wall_thickness, z + floor_height}, plaster);
    front.box({left, 0, z}, {right, wall_thickness, bottom}, plaster);
    front.box({left, 0, top}, {right, wall_thickness, z + floor_height}, plaster);
    front.box({left, wall_thickness, bottom}, {right, wall_thickness + 0.05, top}, pane);
    front.box({left - 0.1, -0.15, bottom - 0.08}, {right + 0.1, 0, bottom}, stone);
}

Vector2d in_front(const Facade& facade, double x, double y) {
    const Vector2d& a = facade.spot.axis;
    return facade.spot.at + x * a + y * Vector2d(-a.y(), a.x());
}

}  // namespace

void add_facade(Scene& scene, const Facade& facade) {
    Eigen::Affine3d T = Eigen::Affine3d::Identity();
    const Vector2d& a = facade.spot.axis;
    T.linear() << a.x(), -a.y(), 0, a.y(), a.x(), 0, 0, 0, 1;
    T.translation() = Vector3d(facade.spot.at.x(), facade.spot.at.y(), facade.spot.z);
    const Front front{scene, facade, T};
    Random random{hash(facade.seed, 0xfacade)};
    const double width = facade.bay_width;
    for (std::size_t i = 0; i < facade.bays.size(); ++i) {
        const double x0 = width * static_cast<double>(i), x1 = x0 + width;
        switch (facade.bays[i]) {
            case Bay::wall:
                add_wall(front, x0, x1);
                break;
            case Bay::recess:
                add_recess(front, x0, x1);
                break;
            case Bay::shop:
                add_shop(front, x0, x1, random);
                break;
            case Bay::door:
                add_door(front, x0, x1);
                break;
        }
        for (int floor = 0; floor < facade.upper_floors; ++floor) {
            add_window(front, x0, x1, facade.ground_floor + floor * floor_height);
        }
    }
    const double length = width * static_cast<double>(facade.bays.size());
    const double top = facade.ground_floor + facade.upper_floors * floor_height;
    if (facade.upper_floors > 0)
        front.box({0, -0.2, facade.ground_floor - 0.1}, {length, 0, facade.ground_floor + 0.1},
                  stone);
    front.box({0, -0.3, top}, {length, wall_thickness, top + 0.2}, stone);
}

Vector2d doorway(const Facade& facade, std::size_t bay) {
    return in_front(facade, facade.bay_width * (static_cast<double>(bay) + 0.5), 0.15);
}

Vector2d behind_door(const Facade& facade, std::size_t bay) {
    return in_front(facade, facade.bay_width * (static_cast<double>(bay) + 0.5),
                    facade.room_depth - 0.8);
}

}  // namespace dynamic_filter::sim
