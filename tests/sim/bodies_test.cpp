// SPDX-License-Identifier: MIT
#include "sim/bodies.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "sim/prototypes.hpp"

namespace dynamic_filter::sim::bodies_test {

namespace {

float lowest(const std::vector<Part>& parts, const Placements& placements) {
    const auto meshes = prototypes();
    float z = 1e9F;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        for (const auto& v : meshes[parts[i].prototype].vertices)
            z = std::min(z, (placements[i].T_world_part * v).z());
    }
    return z;
}

}  // namespace

TEST(Bodies, FeetStayOnTheGroundThroughTheGait) {
    for (const double height : {1.1, 1.75, 1.95}) {
        Walker walker;
        walker.height = height;
        for (float phase = 0.0F; phase < 6.3F; phase += 0.3F) {
            Stride stride;
            stride.phase = phase;
            stride.swing = 0.45F;
            Placements placements;
            place_walker(walker, stride, 0.15, placements);
            const auto parts = walker_parts(3);
            ASSERT_EQ(parts.size(), placements.size());
            EXPECT_NEAR(lowest(parts, placements), 0.15F, 0.09F);
        }
    }
}

TEST(Bodies, LegsSwingApartAndRestTogether) {
    Stride stride;
    stride.swing = 0.4F;
    stride.phase = 1.57F;
    Placements walking, standing;
    place_walker({}, stride, 0.0, walking);
    stride.swing = 0.0F;
    place_walker({}, stride, 0.0, standing);
    const Eigen::Vector3f foot(0, 0, -0.85F);
    const auto apart = [&](const Placements& p) {
        return (p[1].T_world_part * foot - p[2].T_world_part * foot).x();
    };
    EXPECT_GT(std::abs(apart(walking)), 0.5F);
    EXPECT_NEAR(apart(standing), 0.0F, 1e-5F);
}

TEST(Bodies, CyclistsFeetTurnWithThePedals) {
    const Vehicle cyclist{
        .kind = VehicleKind::cyclist,
        .ride = {.path = smooth_path({{0, 0}, {50, 0}, {100, 0}}, false), .speed = 4.0}};
    for (double t = 0.0; t < 3.0; t += 0.1) {
        Placements placements;
        place_vehicle(cyclist, t, placements);
        ASSERT_EQ(placements.size(), vehicle_parts(cyclist).size());
        const Eigen::Vector3f knee =
            placements[1].T_world_part * Eigen::Vector3f(0, 0, -static_cast<float>(thigh_length));
        EXPECT_NEAR((knee - placements[2].T_world_part.translation()).norm(), 0.0F, 1e-3F);
        const Eigen::Vector3f foot =
            placements[2].T_world_part * Eigen::Vector3f(0, 0, -static_cast<float>(shin_length));
        EXPECT_GT(foot.z(), 0.1F);
        EXPECT_LT(foot.z(), 0.6F);
    }
}

TEST(Bodies, KindFollowsTheSpeed) {
    for (const auto& [speed, kind] :
         {std::pair(0.0F, Kind::standing), std::pair(0.19F, Kind::standing),
          std::pair(0.21F, Kind::walking), std::pair(1.2F, Kind::walking)}) {
        Stride stride;
        stride.speed = speed;
        Placements placements;
        place_walker({}, stride, 0.0, placements);
        for (const Placement& placement : placements) EXPECT_EQ(placement.kind, kind) << speed;
    }
}

TEST(Bodies, HaltedVehiclesAndCyclistsAreVehicles) {
    const Path path = smooth_path({{0, 0}, {50, 0}, {100, 0}}, false);
    for (const auto kind : {VehicleKind::car, VehicleKind::van, VehicleKind::bus,
                            VehicleKind::cyclist, VehicleKind::gate, VehicleKind::load}) {
        Placements placements;
        place_vehicle({.kind = kind, .ride = {.path = path, .speed = 0.0}}, 1.0, placements);
        for (const Placement& placement : placements) EXPECT_EQ(placement.kind, Kind::vehicle);
    }
}

TEST(Bodies, LuggageStandsBesideItsOwner) {
    Walker walker;
    walker.luggage = true;
    const auto parts = walker_parts(3, true);
    Placements placements;
    place_walker(walker, {}, 0.15, placements);
    ASSERT_EQ(placements.size(), parts.size());
    ASSERT_EQ(parts.size(), walker_parts(3).size() + 1);
    EXPECT_EQ(parts.back().prototype, static_cast<std::size_t>(Prototype::suitcase));
    EXPECT_EQ(placements.back().kind, placements.front().kind);
    const Eigen::Vector3f at = placements.back().T_world_part.translation();
    EXPECT_NEAR(at.z(), 0.15F, 1e-5F);
    EXPECT_GT(at.head<2>().norm(), 0.3F);
    EXPECT_LT(at.head<2>().norm(), 0.6F);
}

TEST(Bodies, DoorsOpenOnlyWhileTheWagonStands) {
    const Path path = smooth_path({{0, 0}, {100, 0}, {200, 0}}, false);
    const Vehicle wagon{.kind = VehicleKind::wagon,
                        .ride = {.path = path, .speed = 10.0, .stop_at = 100.0, .stop_time = 30.0}};
    const double came = halts_at(wagon.ride);
    std::vector<Mover> movers;
    add_movers(wagon, came, movers);
    EXPECT_TRUE(movers.empty());
    for (double t = 0.0; t < came + 60.0; t += 0.1) {
        const double open = door_opening(wagon.ride, t);
        if (t < came || t > came + 30.0) {
            EXPECT_EQ(open, 0.0) << t;
        } else if (t > came + 2.6 && t < came + 27.4) {
            EXPECT_EQ(open, 1.0) << t;
        }
        Placements placements;
        place_vehicle(wagon, t, placements);
        ASSERT_EQ(placements.size(), vehicle_parts(wagon).size());
        const auto x = [&](std::size_t i) { return placements[i].T_world_part.translation().x(); };
        EXPECT_NEAR(x(1) - x(0), door_leaf * open, 1e-4);
        EXPECT_NEAR(x(2) - x(0), -door_leaf * open, 1e-4);
    }
}

TEST(Bodies, MoversCoverTheVehicle) {
    const Vehicle bus{
        .kind = VehicleKind::bus,
        .ride = {
            .path = smooth_path({{0, 0}, {50, 0}, {100, 0}}, false), .start = 20.0, .speed = 7.0}};
    std::vector<Mover> movers;
    add_movers(bus, 0.0, movers);
    for (double x = 14.2; x < 25.8; x += 0.1) {
        const bool covered = std::any_of(movers.begin(), movers.end(), [&](const Mover& m) {
            return (m.centre - Eigen::Vector2d(x, 0.0)).norm() < m.radius;
        });
        EXPECT_TRUE(covered) << x;
    }
    EXPECT_NEAR(movers[0].velocity.x(), 7.0, 1e-6);
}

}  // namespace dynamic_filter::sim::bodies_test
