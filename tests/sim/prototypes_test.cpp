// SPDX-License-Identifier: MIT
#include "sim/prototypes.hpp"

#include <gtest/gtest.h>

namespace dynamic_filter::sim::prototypes_test {

namespace {

Eigen::AlignedBox3f bounds(const Mesh& mesh) {
    Eigen::AlignedBox3f box;
    for (const auto& v : mesh.vertices) box.extend(v);
    return box;
}

}  // namespace

TEST(Prototypes, OneMeshForEachValue) {
    const auto all = prototypes();
    ASSERT_EQ(all.size(), static_cast<std::size_t>(Prototype::load) + 1);
    for (const Mesh& mesh : all) {
        EXPECT_FALSE(mesh.triangles.empty());
        EXPECT_EQ(mesh.triangles.size(), mesh.materials.size());
        for (const auto& [r, kind, gloss] : mesh.materials) {
            EXPECT_GT(r, 0.0F);
            EXPECT_LE(r, 1.0F);
        }
    }
}

TEST(Prototypes, VehiclesStandOnTheGround) {
    for (const auto& mesh : {car_mesh(), van_mesh(), bus_mesh()}) {
        EXPECT_NEAR(bounds(mesh).min().z(), 0.0F, 0.02F);
    }
    EXPECT_NEAR(bounds(prototypes()[static_cast<std::size_t>(Prototype::bicycle)]).min().z(), 0.0F,
                0.02F);
    EXPECT_NEAR(bounds(car_mesh()).sizes().x(), 4.3F, 0.05F);
    EXPECT_NEAR(bounds(bus_mesh()).sizes().x(), 12.0F, 0.05F);
}

TEST(Prototypes, DoorsCloseTheDoorwaysOfTheWagon) {
    const auto wagon = bounds(wagon_mesh()), fore = bounds(doors_mesh(1.0)),
               aft = bounds(doors_mesh(-1.0));
    EXPECT_NEAR(wagon.sizes().x(), 2.0F * static_cast<float>(wagon_half_length), 0.15F);
    EXPECT_LT(wagon.max().z(), 3.0F);
    EXPECT_LT(fore.max().y(), -static_cast<float>(wagon_half_width));
    EXPECT_NEAR(fore.max().x(), static_cast<float>(wagon_doors[2] + door_leaf), 1e-4F);
    EXPECT_NEAR(aft.min().x(), static_cast<float>(wagon_doors[0] - door_leaf), 1e-4F);
    EXPECT_NEAR(fore.min().x(), static_cast<float>(wagon_doors[0]), 1e-4F);
}

TEST(Prototypes, GateAndLoadHaveTheirSize) {
    const Eigen::Vector3f gate = bounds(gate_mesh()).sizes(), load = bounds(load_mesh()).sizes();
    EXPECT_TRUE(gate.head<2>().cast<double>().isApprox(gate_size, 1e-4));
    EXPECT_NEAR(load.x(), static_cast<float>(load_size.x()), 0.05F);  // and the ropes
    EXPECT_NEAR(load.y(), static_cast<float>(load_size.y()), 1e-4F);
    EXPECT_GT(bounds(load_mesh()).min().z(), 0.2F);  // it hangs
}

TEST(Prototypes, PersonReaches175Centimetres) {
    const auto all = prototypes();
    EXPECT_NEAR(bounds(all[static_cast<std::size_t>(Prototype::torso)]).max().z(), 1.75F, 1e-4F);
    EXPECT_NEAR(bounds(all[static_cast<std::size_t>(Prototype::leg)]).min().z(), -0.873F, 0.005F);
}

}  // namespace dynamic_filter::sim::prototypes_test
