// SPDX-License-Identifier: MIT
#include "filter/mirror_cells.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <vector>

namespace dynamic_filter::mirror_cells_test {

namespace {

const UprightPlane kPlane = {.normal = Eigen::Vector2f::UnitX(), .from = 0.0F, .until = 10.0F};

/// A place every 5 cm of a plane of 10 m by 2 m, at depths of 1 to 9 m behind it.
struct Seen {
    std::vector<Crossing> at;
    std::vector<Likeness> likeness;
};

Seen seen(const std::function<Likeness(const Crossing&)>& what, int angle = 0) {
    Seen out;
    for (int column = 0; column < 200; ++column) {
        for (int row = 0; row < 40; ++row) {
            const float depth = 1.0F + static_cast<float>((7 * column + 3 * row) % 9);
            const float along = 0.05F * static_cast<float>(column) + 0.02F;
            out.at.push_back({along, 0.05F * static_cast<float>(row) + 0.02F, depth, angle});
            out.likeness.push_back(what(out.at.back()));
        }
    }
    return out;
}

bool is_mirror(const Crossing& at) { return at.along > 3.0F && at.along < 6.0F; }
Likeness of_mirror(const Crossing& at) { return is_mirror(at) ? Likeness::like : Likeness::unlike; }

MarkedMirror marked(const Seen& s) { return mark_mirror(kPlane, s.at, s.likeness, 0.4, 20); }

bool reflects(const Mirror& m, float along, float z, int angle = 0) {
    return m.reflects[*m.cell(along, z, angle)];
}

}  // namespace

TEST(MirrorCells, PlacesWithTheirLikeMakeAMirrorAndOthersDoNot) {
    const MarkedMirror found = marked(seen(of_mirror));
    EXPECT_EQ(found.like, 60 * 40);
    for (float along = 0.1F; along < 9.9F; along += 0.25F) {
        EXPECT_EQ(reflects(found.mirror, along, 1.0F), along > 3.0F && along < 6.0F) << along;
    }
}

TEST(MirrorCells, PlacesWithoutTheirLikeCountAgainstTheMirror) {
    const MarkedMirror found = marked(seen([](const Crossing& at) {
        const bool is_unlike = is_mirror(at) && at.z < 0.05F;
        return is_unlike ? Likeness::unlike : of_mirror(at);
    }));
    EXPECT_EQ(found.like, 60 * 39 - 4 * 60);
}

TEST(MirrorCells, OneSurfaceAtOneDepthIsNoMirror) {
    Seen s = seen(of_mirror);
    for (Crossing& at : s.at) at.depth = 4.2F;
    const MarkedMirror found = marked(s);
    EXPECT_EQ(found.like, 0);
    EXPECT_FALSE(reflects(found.mirror, 4.5F, 1.0F));
}

TEST(MirrorCells, AFloorWithItsLikeBelongsToTheMirrorAboveIt) {
    const auto with_floor = [](const Crossing& at) {
        return at.z < 0.5F ? Likeness::plain : of_mirror(at);
    };
    const MarkedMirror found = marked(seen(with_floor));
    EXPECT_TRUE(reflects(found.mirror, 4.5F, 0.1F));
    EXPECT_FALSE(reflects(found.mirror, 8.0F, 0.1F));
}

TEST(MirrorCells, WhatReflectsAtOneAngleReflectsAtMoreGrazingOnes) {
    const Mirror steep = marked(seen(of_mirror, 0)).mirror;
    EXPECT_TRUE(reflects(steep, 4.5F, 1.0F, 1));
    EXPECT_TRUE(reflects(steep, 4.5F, 1.0F, 2));
    const Mirror grazing = marked(seen(of_mirror, 2)).mirror;
    EXPECT_FALSE(reflects(grazing, 4.5F, 1.0F, 1));
    EXPECT_TRUE(reflects(grazing, 4.5F, 1.0F, 2));
}

TEST(MirrorCells, WhatIsNotKnownMakesNoMirror) {
    EXPECT_EQ(marked(seen([](const Crossing&) { return Likeness::unknown; })).like, 0);
    EXPECT_EQ(marked(seen([](const Crossing&) { return Likeness::plain; })).like, 0);
}

}  // namespace dynamic_filter::mirror_cells_test
