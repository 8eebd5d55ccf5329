// SPDX-License-Identifier: MIT
#include "sim/strongest_return.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace dynamic_filter::sim::strongest_return_test {

namespace {

/// A pane in the plane y = 4, a white wall at y = 8 behind it, and another at x = 9 across it.
Mesh room(Gloss gloss) {
    Mesh mesh;
    add_quad(mesh, {-20, 4, -5}, {40, 0, 0}, {0, 0, 10}, {0.002F, Kind::structure, gloss});
    add_quad(mesh, {-20, 8, -5}, {40, 0, 0}, {0, 0, 10}, {0.8F, Kind::vegetation});
    add_quad(mesh, {9, -20, -5}, {0, 23.9, 0}, {0, 0, 10}, {0.8F, Kind::thin});
    return mesh;
}

Hit look(Gloss gloss, const Eigen::Vector3f& towards) {
    const Caster caster(room(gloss), {}, {});
    return strongest_return(caster, Eigen::Vector3f::Zero(), towards.normalized(), 100.0F);
}

}  // namespace

TEST(StrongestReturn, AMirrorShowsWhatLiesBeforeItAtTheWholeLengthOfTheWay) {
    const Hit hit = look({.reflects = 0.9F, .transmits = 0.0F}, {6, 4, 0});
    ASSERT_TRUE(hit.found);
    EXPECT_EQ(hit.kind, Kind::reflection);
    // The beam meets the mirror at x = 6, and the wall at x = 9 half as far again.
    EXPECT_NEAR(hit.range, 1.5F * std::hypot(6.0F, 4.0F), 1e-2F);
}

TEST(StrongestReturn, APaneReturnsItselfHeadOn) {
    for (const Gloss gloss : {Gloss{0.9F, 0.0F}, Gloss{0.08F, 0.9F}}) {
        const Hit hit = look(gloss, {0.1F, 4, 0});
        ASSERT_TRUE(hit.found);
        EXPECT_EQ(hit.kind, Kind::structure);
        EXPECT_NEAR(hit.range, 4.0F, 1e-2F);
    }
}

TEST(StrongestReturn, AClearPaneShowsWhatLiesBehindItAndReflectsBeamsThatGrazeIt) {
    const Gloss glass{.reflects = 0.08F, .transmits = 0.9F};
    const Hit steep = look(glass, {2, 4, 0});
    EXPECT_EQ(steep.kind, Kind::vegetation);
    EXPECT_NEAR(steep.range, 2.0F * std::hypot(2.0F, 4.0F), 1e-2F);
    const Caster caster(room(glass), {}, {});
    const Hit grazing =
        strongest_return(caster, {0, 3.7F, 0}, Eigen::Vector3f(4, 0.3F, 0).normalized(), 100.0F);
    EXPECT_EQ(grazing.kind, Kind::reflection);
}

TEST(StrongestReturn, WithoutPanesItIsTheNearestHit) {
    Mesh mesh;
    add_quad(mesh, {-1, 4, -1}, {2, 0, 0}, {0, 0, 2}, {0.3F, Kind::thin});
    const Caster caster(mesh, {}, {});
    const Hit hit = strongest_return(caster, {0, 0, 0}, Eigen::Vector3f::UnitY(), 50.0F);
    EXPECT_EQ(hit.range, 4.0F);
    EXPECT_EQ(hit.reflectivity, 0.3F);
    EXPECT_EQ(hit.kind, Kind::thin);
    EXPECT_FALSE(strongest_return(caster, {0, 0, 0}, Eigen::Vector3f::UnitX(), 50.0F).found);
}

}  // namespace dynamic_filter::sim::strongest_return_test
