// SPDX-License-Identifier: MIT
#include <map>
#include <set>

#include "sim/city.hpp"
#include "sim/scene_checks.hpp"

namespace dynamic_filter::sim {
namespace scene_city_test {

Scene small(const Trip& trip = {.km = 0.1}) { return entry("city").make_trip(5, 1, trip); }

std::size_t count(const std::vector<Part>& parts, std::size_t prototype) {
    return static_cast<std::size_t>(std::count_if(
        parts.begin(), parts.end(), [&](const Part& part) { return part.prototype == prototype; }));
}

TEST(SceneCity, LevelBeamsAreOffTheBoundaries) { expect_off_boundaries(small()); }

TEST(SceneCity, HoldsWhatIsNearAndNothingElse) {
    const Scene scene = small();
    const Surroundings near = scene.around(5.0, 60.0), far = scene.around(5.0, 100.0);
    EXPECT_GT(count(near.parts, city::lamp), 5U);
    EXPECT_GT(count(far.parts, city::lamp), count(near.parts, city::lamp));
    EXPECT_LT(far.parts.size(), 3000U);
    const Eigen::Vector2d p = at(scene.robot.path, travelled(scene.robot, 5.0)).position;
    const Placements placements = near.placements(5.0);
    ASSERT_EQ(placements.size(), near.parts.size());
    for (std::size_t i = 0; i < placements.size(); ++i) {
        EXPECT_LT(near.parts[i].prototype, scene.prototypes.size());
        if (near.parts[i].prototype == city::slab || !near.parts[i].is_still) continue;
        const auto at = placements[i].T_world_part.translation().head<2>().cast<double>();
        EXPECT_LT((at - p).norm(), 60.0 + 30.0);
    }
}

TEST(SceneCity, WhatStaysIsTheSameInAllDrives) {
    const auto fixed = [](const city::Block& block) {
        std::vector<float> out;
        for (const city::Fixture& f : city::block_fixtures(1, block)) {
            const auto& m = f.placement.T_world_part.matrix();
            out.insert(out.end(), m.data(), m.data() + 16);
            EXPECT_TRUE(f.part.is_still);
        }
        return out;
    };
    EXPECT_EQ(fixed({0, 0}), fixed({0, 0}));
    EXPECT_NE(fixed({0, 0}), fixed({1, 0}));
    EXPECT_NE(fixed({0, 1}), fixed({1, 0}));
}

TEST(SceneCity, HousesFillTheSidesOfABlock) {
    std::map<std::size_t, double> lengths;
    const auto meshes = city::library(1);
    EXPECT_EQ(meshes.size(), static_cast<std::size_t>(city::things));
    double length = 0.0;
    for (const city::Fixture& f : city::block_fixtures(1, {2, 1})) {
        const std::size_t p = f.part.prototype;
        if (p < city::house || p >= city::tree) continue;
        float least = 1e9F, most = -1e9F;
        for (const auto& v : meshes[p].vertices) {
            least = std::min(least, v.x()), most = std::max(most, v.x());
        }
        length += city::bay_width * std::round(static_cast<double>(most - least) / city::bay_width);
    }
    const double sides = 2.0 * (city::bays_along[0] + city::bays_along[1]) * city::bay_width;
    EXPECT_NEAR(length, sides, 1e-6);
}

TEST(SceneCity, NothingOfTheFurnitureStandsInTheStreetOrFloats) {
    for (const city::Fixture& f : city::block_fixtures(7, {-1, 3})) {
        if (f.part.prototype == city::slab) continue;
        const Eigen::Vector3f at = f.placement.T_world_part.translation();
        EXPECT_DOUBLE_EQ(city::ground(at.head<2>().cast<double>()), city::pavement);
        EXPECT_FLOAT_EQ(at.z(), static_cast<float>(city::pavement));
    }
}

TEST(SceneCity, PeopleAndTheVehicleKeepClearOfTheFurniture) {
    const Scene scene = small({.km = 0.4, .drive = 2});
    for (double t = 0.0; t < scene.duration; t += 1.0) {
        const Surroundings here = scene.around(t, 80.0);
        const Placements placements = here.placements(t);
        const Eigen::Vector2f robot =
            at(scene.robot.path, travelled(scene.robot, t)).position.cast<float>();
        for (std::size_t i = 0; i < placements.size(); ++i) {
            const std::size_t p = here.parts[i].prototype;
            const bool thing = p >= city::tree && p < city::things;
            if (!thing) continue;
            const Eigen::Vector2f at = placements[i].T_world_part.translation().head<2>();
            EXPECT_GT((at - robot).norm(), 1.2F);
            for (std::size_t k = 0; k < placements.size(); ++k) {
                const bool person =
                    here.parts[k].prototype <= static_cast<std::size_t>(Prototype::torso_with_pack);
                if (!person) continue;
                const Eigen::Vector2f q = placements[k].T_world_part.translation().head<2>();
                EXPECT_GT((at - q).norm(), 0.3F) << p << " " << at.transpose();
            }
        }
    }
}

}  // namespace scene_city_test
}  // namespace dynamic_filter::sim
