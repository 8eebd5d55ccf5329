// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "sim/props.hpp"

namespace dynamic_filter::sim::facade_test {

using Eigen::Vector2d;

namespace {

Facade front(const Vector2d& axis) {
    return {.spot = {.at = {1.0, 2.0}, .axis = axis},
            .bays = {Bay::wall, Bay::recess, Bay::shop, Bay::door},
            .bay_width = 4.0,
            .seed = 3};
}

}  // namespace

TEST(Facade, OnlyDoorsLetPeopleIn) {
    for (const Vector2d& axis : {Vector2d(1, 0), Vector2d(-1, 0), Vector2d(0.6, 0.8)}) {
        const Facade facade = front(axis);
        const Vector2d inward(-axis.y(), axis.x());
        Scene scene;
        add_facade(scene, facade);
        const DistanceField field = distance_field(scene.obstacles, {-25, -25}, {25, 25});
        for (std::size_t bay = 0; bay < facade.bays.size(); ++bay) {
            const Vector2d door = doorway(facade, bay), street = door - 2.0 * inward;
            const bool open = facade.bays[bay] == Bay::door;
            EXPECT_EQ(is_clear(field, street, behind_door(facade, bay), 0.22), open) << bay;
            EXPECT_FALSE(is_clear(field, street, door + 5.0 * inward, 0.1)) << bay;
        }
    }
}

TEST(Facade, ReachesFromTheGroundToTheEaves) {
    Scene scene;
    const Facade facade = front({1, 0});
    add_facade(scene, facade);
    Eigen::AlignedBox3f box;
    for (const auto& v : scene.still.vertices) box.extend(v);
    EXPECT_NEAR(box.min().z(), 0.0F, 1e-6F);
    EXPECT_NEAR(box.max().z(), 3.4F + 2 * 3.0F + 0.2F, 0.01F);
    EXPECT_NEAR(box.min().x(), 1.0F, 0.01F);
    EXPECT_NEAR(box.max().x(), 17.0F, 0.01F);
}

}  // namespace dynamic_filter::sim::facade_test
