// SPDX-License-Identifier: MIT
#include "filter/line_of_sight_scalar.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

namespace dynamic_filter {
namespace line_of_sight_scalar_test {

constexpr float kDeg = std::numbers::pi_v<float> / 180.0F;
const SightMargins margins = margins_of(ScansConfig{}.sight, 0.2);

/// A beam that returned, relative to the place: [deg] to the left and up, and its range [m].
struct Return {
    float left, up, range;
};

/// What an image with pixels of one degree and these returns sees at a range straight ahead.
Sight sight_at(float range, const std::vector<Return>& returns) {
    Points points;
    for (const Return& r : returns) {
        const float a = r.left * kDeg, e = r.up * kDeg;
        points.push_back(r.range *
                         Point(std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e)));
    }
    return line_of_sight(BeamImage(points, {kDeg, kDeg}), {0.0F, 0.0F, range}, margins);
}

/// One return in each quadrant, 0.4 degrees away along both axes.
std::vector<Return> around(float below, float above) {
    return {{-0.4F, -0.4F, below}, {0.4F, -0.4F, below}, {-0.4F, 0.4F, above}, {0.4F, 0.4F, above}};
}

// The margins at 10 m: touch and surface 0.22 and 0.17 m, beyond 0.2 m, clear 0.3 m; 0.4 degrees
// are 0.07 m there, less than `beside`.
TEST(LineOfSightScalar, TheGapBehindThePlaceDecides) {
    const auto gap = [](float metres) {
        return sight_at(10.0F, around(10.0F + metres, 10.0F + metres));
    };
    EXPECT_EQ(gap(0.0F), Sight::occupied);
    EXPECT_EQ(gap(0.15F), Sight::occupied);
    EXPECT_EQ(gap(-0.15F), Sight::occupied);
    EXPECT_EQ(gap(0.25F), Sight::weak_passed);
    EXPECT_EQ(gap(0.35F), Sight::passed);
    EXPECT_EQ(gap(-0.5F), Sight::unknown);
}

TEST(LineOfSightScalar, FarAwayTheBeamsGoBesideThePlace) {
    EXPECT_EQ(sight_at(20.0F, around(30.0F, 30.0F)), Sight::free);  // 0.14 m beside it
    EXPECT_EQ(sight_at(20.0F, around(20.31F, 20.31F)), Sight::free);
    // There the surface margin is 0.24 m, and the space behind it is short.
    EXPECT_EQ(sight_at(20.0F, around(20.27F, 20.27F)), Sight::weak_free);
}

TEST(LineOfSightScalar, ABeamThatEndsBeforeThePlaceHidesIt) {
    auto returns = around(30.0F, 30.0F);
    returns[0].range = 5.0F;
    EXPECT_EQ(sight_at(10.0F, returns), Sight::unknown);
    // Not if it is farther up or down than `beside`; but then the line to it must pass behind.
    EXPECT_EQ(sight_at(20.0F, {{-0.4F, -0.4F, 20.1F},
                               {-0.4F, 0.4F, 30.0F},
                               {0.4F, -0.4F, 30.0F},
                               {0.4F, 0.4F, 30.0F}}),
              Sight::occupied);
}

TEST(LineOfSightScalar, GroundBetweenTwoRingsIsWeaklyOccupied) {
    EXPECT_EQ(sight_at(20.0F, around(19.0F, 21.0F)), Sight::weak_occupied);
    EXPECT_EQ(sight_at(20.0F, around(22.0F, 23.0F)), Sight::free);
    // The line between 20.5 m and 23 m comes too near, though both beams go on behind the place.
    EXPECT_EQ(sight_at(20.0F, around(20.5F, 23.0F)), Sight::unknown);
    auto wall = around(17.0F, 17.0F);  // a wall that ends at the place
    wall[1].range = wall[3].range = 21.0F;
    EXPECT_EQ(sight_at(20.0F, wall), Sight::unknown);
}

TEST(LineOfSightScalar, OneBeamTellsNothingAndTwoOnlyIfTheyPassVeryClose) {
    EXPECT_EQ(sight_at(10.0F, {{0.1F, 0.1F, 30.0F}}), Sight::unknown);
    // Close is half of `beside`, 0.29 degrees at 10 m, or 0.3 pixels.
    EXPECT_EQ(sight_at(10.0F, {{-0.4F, 0.25F, 30.0F}, {0.4F, 0.25F, 30.0F}}), Sight::passed);
    EXPECT_EQ(sight_at(10.0F, {{-0.4F, 0.4F, 30.0F}, {0.4F, 0.4F, 30.0F}}), Sight::unknown);
    // Not on all sides: so the space behind must be 2 m deep to be sure.
    EXPECT_EQ(sight_at(10.0F, {{-0.4F, 0.25F, 12.1F}, {0.4F, 0.25F, 12.1F}}), Sight::passed);
    EXPECT_EQ(sight_at(10.0F, {{-0.4F, 0.25F, 11.9F}, {0.4F, 0.25F, 11.9F}}), Sight::weak_passed);
}

TEST(LineOfSightScalar, ABeamMoreThanAPixelAwayIsLeftOut) {
    auto returns = around(30.0F, 30.0F);
    returns.push_back({-1.1F, -0.8F, 15.0F});
    EXPECT_EQ(sight_at(20.0F, returns), Sight::free);
    returns.back() = {-0.6F, -0.8F, 15.0F};  // nearer than the other one of its quadrant
    returns.front() = {-0.9F, -0.9F, 30.0F};
    EXPECT_EQ(sight_at(20.0F, returns), Sight::weak_occupied);
}

TEST(LineOfSightScalar, JudgesFromTheNearestToTheFarthestRange) {
    const auto returns = around(100.0F, 100.0F);
    EXPECT_TRUE(is_free(sight_at(margins.nearest, returns)));
    EXPECT_TRUE(is_free(sight_at(margins.farthest, returns)));
    EXPECT_EQ(sight_at(0.99F * margins.nearest, returns), Sight::unknown);
    EXPECT_EQ(sight_at(1.01F * margins.farthest, returns), Sight::unknown);
    EXPECT_EQ(sight_at(std::nanf(""), returns), Sight::unknown);
}

}  // namespace line_of_sight_scalar_test
}  // namespace dynamic_filter
