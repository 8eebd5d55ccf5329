// SPDX-License-Identifier: MIT
#include "check/place_signature.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "geometry/pose.hpp"

namespace dynamic_filter::io {
namespace place_signature_test {

/// Ground, and columns of different heights strewn over it.
Points place(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> along(-38.0F, 38.0F), height(0.5F, 4.0F);
    Points cloud;
    for (float x = -38.0F; x < 38.0F; x += 0.5F) {
        for (float y = -38.0F; y < 38.0F; y += 0.5F) cloud.emplace_back(x, y, -1.8F);
    }
    for (int column = 0; column < 60; ++column) {
        const float x = along(random), y = along(random), top = height(random);
        for (float z = 0.0F; z < top; z += 0.2F) cloud.emplace_back(x, y, z - 1.8F);
    }
    return cloud;
}

Points turned(const Points& cloud, double turn) {
    return moved(cloud, Pose(Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ())));
}

TEST(PlaceSignature, IsLikeItselfWhateverTheDirection) {
    const PlaceSignature a = signature_of(place(1));
    for (const int sectors : {0, 7, 31, 59}) {
        const double turn = sectors * 2.0 * std::numbers::pi / PlaceSignature::kSectors;
        const Likeness likeness = likeness_of(a, signature_of(turned(place(1), -turn)));
        EXPECT_LT(likeness.distance, 0.02);
        EXPECT_NEAR(likeness.turn, turn, 1e-9);
    }
}

TEST(PlaceSignature, OtherPlacesAreLessLike) {
    const PlaceSignature a = signature_of(place(1));
    const double same = likeness_of(a, signature_of(turned(place(1), 1.234))).distance;
    for (unsigned seed = 2; seed < 8; ++seed) {
        EXPECT_GT(likeness_of(a, signature_of(place(seed))).distance, 1.3 * same) << seed;
    }
}

TEST(PlaceSignature, NothingIsLikeNothing) {
    const PlaceSignature empty = signature_of({});
    EXPECT_EQ(likeness_of(empty, empty).distance, 1.0);
    EXPECT_EQ(likeness_of(signature_of(place(1)), empty).distance, 1.0);
}

TEST(PlaceSignature, HeightsCountFromTheGround) {
    const Points cloud = place(3);
    const Points raised = moved(cloud, Pose(Eigen::Translation3d(0.0, 0.0, 100.0)));
    EXPECT_TRUE(signature_of(cloud).heights.isApprox(signature_of(raised).heights, 1e-4F));
}

}  // namespace place_signature_test
}  // namespace dynamic_filter::io
