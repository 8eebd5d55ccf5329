// SPDX-License-Identifier: MIT
#include "filter/mirror.hpp"

#include <gtest/gtest.h>

namespace dynamic_filter::mirror_test {

namespace {

/// The plane y = 2; beams come from above it. One cell of each angle reflects: the one that begins
/// 1 m along it and 0.5 m above its foot.
Mirror small_mirror() {
    Mirror m{.plane = {.normal = Eigen::Vector2f::UnitY(), .offset = 2.0F, .from = -5.0F}};
    m.plane.until = 5.0F;
    m.columns = 40;
    m.rows = 8;
    m.reflects.assign(static_cast<std::size_t>(kMirrorAngles * m.rows * m.columns), false);
    for (int angle = 0; angle < kMirrorAngles; ++angle)
        m.reflects[*m.cell(1.1F, 0.6F, angle)] = true;
    return m;
}

}  // namespace

TEST(Mirror, ABeamCrossesThePlaneWhereItIs) {
    const UprightPlane plane = small_mirror().plane;
    // Halfway between 3 m in front of the plane and 3 m behind it.
    const auto at = crossing(plane, {1.0F, 5.0F, 1.0F}, {3.0F, -1.0F, 2.0F});
    ASSERT_TRUE(at);
    EXPECT_FLOAT_EQ(at->along, plane.along({2.0F, 2.0F}));
    EXPECT_FLOAT_EQ(at->z, 1.5F);
    EXPECT_FLOAT_EQ(at->depth, 3.0F);
}

TEST(Mirror, ABeamThatDoesNotGoFarBehindThePlaneDoesNotCrossIt) {
    const UprightPlane plane = small_mirror().plane;
    const Point front(0.0F, 5.0F, 1.0F);
    EXPECT_FALSE(crossing(plane, front, {0.0F, 2.5F, 1.0F}));        // in front
    EXPECT_FALSE(crossing(plane, front, {0.0F, 1.9F, 1.0F}));        // the pane itself
    EXPECT_TRUE(crossing(plane, front, {0.0F, 1.9F, 1.0F}, 0.05F));  // if that is asked for
    EXPECT_FALSE(crossing(plane, front, {0.0F, 1.0F - kDeepInMirror, 1.0F}));  // too far
    EXPECT_FALSE(crossing(plane, {0.0F, 0.0F, 1.0F}, {0.0F, -3.0F, 1.0F}));    // from behind
}

TEST(Mirror, TheClassOfTheAngleGrowsAsTheBeamGrazes) {
    const UprightPlane plane = small_mirror().plane;
    const auto angle = [&](float aside) {
        return crossing(plane, {0.0F, 3.0F, 1.0F}, {aside, 1.0F, 1.0F})->angle;
    };
    EXPECT_EQ(angle(0.0F), 0);
    EXPECT_EQ(angle(3.0F), 1);
    EXPECT_EQ(angle(9.0F), 2);
}

TEST(Mirror, CellsEndAtTheEdges) {
    const Mirror m = small_mirror();
    EXPECT_EQ(m.cell(-5.0F, 0.0F, 0), 0U);
    EXPECT_EQ(m.cell(4.99F, 1.99F, kMirrorAngles - 1), m.reflects.size() - 1);
    EXPECT_FALSE(m.cell(-5.01F, 0.0F, 0));
    EXPECT_FALSE(m.cell(5.01F, 0.0F, 0));
    EXPECT_FALSE(m.cell(0.0F, -0.01F, 0));
    EXPECT_FALSE(m.cell(0.0F, 2.01F, 0));
}

TEST(Mirror, OnlyBeamsThroughCellsThatReflectAreReflected) {
    const Mirror m = small_mirror();
    const auto through = [&](float along, float z) {
        const Eigen::Vector2f axis(-m.plane.normal.y(), m.plane.normal.x());
        const Eigen::Vector2f foot = 2.0F * m.plane.normal + along * axis;
        return is_reflected(m, {foot.x(), 4.0F, z}, {foot.x(), 0.0F, z});
    };
    EXPECT_TRUE(through(1.1F, 0.6F));
    EXPECT_FALSE(through(0.9F, 0.6F));
    EXPECT_FALSE(through(1.1F, 0.8F));
}

TEST(Mirror, ItsOwnSurfaceIsOnIt) {
    const Mirror m = small_mirror();
    EXPECT_TRUE(is_on(m, {-1.1F, 2.1F, 0.6F}));
    EXPECT_FALSE(is_on(m, {-1.1F, 2.3F, 0.6F}));  // in front of it
    EXPECT_FALSE(is_on(m, {-3.0F, 2.0F, 0.6F}));  // another cell
    EXPECT_TRUE(is_on(std::vector{m}, {-1.1F, 2.1F, 0.6F}));
    EXPECT_FALSE(is_on(std::vector<Mirror>{}, {-1.1F, 2.1F, 0.6F}));
}

}  // namespace dynamic_filter::mirror_test
