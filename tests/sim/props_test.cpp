// SPDX-License-Identifier: MIT
#include "sim/props.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <set>

namespace dynamic_filter::sim::props_test {

namespace {

const std::vector<std::function<void(Scene&, const Spot&)>>& all_props() {
    static const std::vector<std::function<void(Scene&, const Spot&)>> props = {
        [](Scene& s, const Spot& p) {
            add_block(s, p, {1.0, 0.5, 0.8}, 0.4F);
        },
        [](Scene& s, const Spot& p) { add_column(s, p, 0.2, 3.0); },
        [](Scene& s, const Spot& p) { add_bench(s, p); },
        [](Scene& s, const Spot& p) { add_planter(s, p, 1); },
        [](Scene& s, const Spot& p) { add_sign(s, p); },
        [](Scene& s, const Spot& p) { add_railing(s, p, 2.0); },
        [](Scene& s, const Spot& p) { add_bin(s, p); },
        [](Scene& s, const Spot& p) { add_lamp(s, p, 5.0); },
        [](Scene& s, const Spot& p) { add_tree(s, p, 6.0, 1); },
        [](Scene& s, const Spot& p) { add_parked_car(s, p, 1.0F); },
    };
    return props;
}

}  // namespace

TEST(Props, StandOnTheirSpotAndBlockTheWay) {
    const Spot spot{.at = {3.0, -2.0}, .axis = {0.0, 1.0}, .z = 0.15};
    for (std::size_t k = 0; k < all_props().size(); ++k) {
        Scene scene;
        all_props()[k](scene, spot);
        float lowest = 1e9F;
        for (const auto& v : scene.still.vertices) lowest = std::min(lowest, v.z());
        EXPECT_NEAR(lowest, 0.15F, 0.02F) << k;
        ASSERT_FALSE(scene.obstacles.empty()) << k;
        EXPECT_LT(distance(scene.obstacles[0], spot.at), 0.0) << k;
    }
}

TEST(Props, AreOfTheKindsTheyAreMadeOf) {
    const auto structure = std::set{Kind::structure}, thin = std::set{Kind::thin};
    const auto planter = std::set{Kind::structure, Kind::vegetation};
    const auto tree = std::set{Kind::thin, Kind::vegetation};
    const std::vector<std::set<Kind>> expected = {
        structure, structure, structure, planter, thin, thin, structure, thin, tree, structure};
    ASSERT_EQ(expected.size(), all_props().size());
    for (std::size_t k = 0; k < all_props().size(); ++k) {
        Scene scene;
        all_props()[k](scene, {});
        std::set<Kind> kinds;
        for (const Material& material : scene.still.materials) kinds.insert(material.kind);
        EXPECT_EQ(kinds, expected[k]) << k;
    }
    Scene scene;
    add_ground(scene, {Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 1)}, 0.0, 0.3F);
    EXPECT_EQ(scene.still.materials[0].kind, Kind::ground);
}

TEST(Props, PeopleCannotWalkIntoWhatIsAtKneeHeight) {
    const Spot spot{.at = {0.0, 0.0}, .axis = {0.6, 0.8}};
    for (std::size_t k = 0; k < all_props().size(); ++k) {
        Scene scene;
        all_props()[k](scene, spot);
        for (const auto& v : scene.still.vertices) {
            if (v.z() > 0.5F) continue;
            double nearest = 1e9;
            for (const auto& o : scene.obstacles)
                nearest = std::min(nearest, distance(o, v.head<2>().cast<double>()));
            EXPECT_LT(nearest, 0.1) << k;
        }
    }
}

}  // namespace dynamic_filter::sim::props_test
