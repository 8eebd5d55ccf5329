// SPDX-License-Identifier: MIT
#include "filter/contact.hpp"

#include <gtest/gtest.h>

#include <map>

#include "support/random.hpp"

namespace dynamic_filter {
namespace contact_test {

constexpr float kSize = 0.2F;

/// Voxels with a verdict each.
struct World {
    std::map<VoxelKey, VoxelVerdict> voxels{};

    void add(const Point& p, Label label) { voxels[pack(*cell_of(p, 1.0F / kSize))] = {p, label}; }
    [[nodiscard]] std::optional<ContactSurface> contact(const Point& p) const {
        const Cell home = *cell_of(p, 1.0F / kSize);
        std::vector<VoxelVerdict> around;
        for (const auto& [key, verdict] : voxels) {
            const int distance = (unpack(key) - home).cwiseAbs().maxCoeff();
            if (distance > 2) continue;
            around.push_back(verdict);
            around.back().distance = distance;
        }
        return contact_surface(around, ScansConfig{}.contact);
    }
};

/// A patch of ground z = 0.07 + slope * x around the origin.
World patch(float slope, float noise = 0.0F) {
    test::Random random(7);
    World world;
    for (int x = -4; x <= 4; ++x) {
        for (int y = -4; y <= 4; ++y) {
            const float at = kSize * (static_cast<float>(x) + 0.5F);
            const float z = 0.07F + slope * at + random.uniform_f(-noise, noise + 1e-6F);
            world.add({at, kSize * (static_cast<float>(y) + 0.5F), z}, Label::static_);
        }
    }
    return world;
}

const Point kFoot{0.1F, 0.1F, 0.3F}, kBelow{0.1F, 0.1F, 0.1F};

TEST(ContactSurface, IsThePlaneOfTheGroundUnderAFoot) {
    for (const float slope : {0.0F, 0.3F}) {
        World world = patch(slope, 0.01F);
        world.add(kFoot, Label::dynamic);
        const auto surface = world.contact(kBelow);
        ASSERT_TRUE(surface);
        EXPECT_NEAR(surface->height({0.1F, 0.1F, 0.07F + slope * 0.1F}), 0.0F, 0.01F);
        EXPECT_GT(surface->height(kFoot), 0.1F);  // the side of the foot is up
    }
}

/// Ground high in its voxels: feet in the voxels above it were not found.
TEST(ContactSurface, IsNotLiftedByFeetThatWereNotFound) {
    World world = patch(0.0F, 0.01F);
    for (const float x : {-0.3F, -0.1F, 0.1F, 0.3F}) {
        for (const float y : {-0.3F, -0.1F, 0.1F}) world.add({x, y, 0.25F}, Label::static_);
    }
    world.add({0.1F, 0.1F, 0.35F}, Label::dynamic);
    const auto surface = world.contact(kBelow);
    ASSERT_TRUE(surface);
    EXPECT_NEAR(surface->height({0.1F, 0.1F, 0.07F}), 0.0F, 0.01F);
    EXPECT_LT(surface->roughness, 0.012F);
}

TEST(ContactSurface, NeedsSomethingDynamicThatTouches) {
    World world = patch(0.0F);
    EXPECT_FALSE(world.contact(kBelow));
    world.add({0.1F, 0.1F, 0.5F}, Label::dynamic);  // two cells up
    EXPECT_FALSE(world.contact(kBelow));
    world.add(kFoot, Label::static_);
    EXPECT_FALSE(world.contact(kBelow));
}

TEST(ContactSurface, NeedsAFlatSurface) {
    World world;
    for (int x = -4; x <= 4; ++x) {
        for (int y = -4; y <= 4; ++y) {  // a checkerboard of two heights
            const float z = (x + y) % 2 == 0 ? 0.01F : 0.19F;
            world.add(
                {kSize * (static_cast<float>(x) + 0.5F), kSize * (static_cast<float>(y) + 0.5F), z},
                Label::static_);
        }
    }
    world.add(kFoot, Label::dynamic);
    EXPECT_FALSE(world.contact(kBelow));
    World lone;
    lone.add(kBelow, Label::static_);
    lone.add(kFoot, Label::dynamic);
    EXPECT_FALSE(lone.contact(kBelow));
}

TEST(ContactSurface, IsNotForAPieceOfTheGroundThatWasMisjudged) {
    World world = patch(0.0F);
    world.add({0.3F, 0.1F, 0.075F}, Label::dynamic);
    EXPECT_FALSE(world.contact(kBelow));
}

TEST(ContactSurface, IgnoresAFewCentroidsThatWereFeetThemselves) {
    World world = patch(0.0F);
    world.add({0.3F, 0.1F, 0.17F}, Label::static_);
    world.add({0.1F, -0.1F, 0.18F}, Label::static_);
    world.add(kFoot, Label::dynamic);
    const auto surface = world.contact(kBelow);
    ASSERT_TRUE(surface);
    EXPECT_NEAR(surface->height({0.1F, 0.1F, 0.07F}), 0.0F, 0.02F);
}

}  // namespace contact_test
}  // namespace dynamic_filter
