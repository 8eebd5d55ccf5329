// SPDX-License-Identifier: MIT
#include "check/place_offset.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "dynamic_filter/motion.hpp"
#include "support/planes.hpp"

namespace dynamic_filter::io {
namespace place_offset_test {

constexpr double kDegree = 3.14159265358979 / 180.0;

/// A hall with pillars, as two drives see it: with other points each time.
Points hall(std::uint64_t seed) {
    test::Random random(seed);
    auto surfaces = test::hall();
    for (const auto& [x, y] : {std::pair{-8.0F, 4.0F}, {-3.0F, -5.5F}, {9.3F, -4.2F}}) {
        for (const auto& face : test::faces({x, y, -1.7F}, {x + 0.8F, y + 1.1F, 3.1F})) {
            surfaces.push_back(face);
        }
    }
    return test::points_on(surfaces, 25.0, 0.01, random);
}

Pose displacement(double x, double y, double z, double yaw_deg) {
    return Eigen::Translation3d(x, y, z) *
           Eigen::AngleAxisd(yaw_deg * kDegree, Eigen::Vector3d::UnitZ());
}

TEST(PlaceOffset, IsFoundUpToMetresAndDegrees) {
    const Points a = hall(1), b = hall(2);
    const Eigen::Vector3d place(5e5, 4e6, 30.0);
    for (const Pose& truth :
         {displacement(0, 0, 0, 0), displacement(0.3, 0, 0, 0), displacement(1.5, -2, 0, 0),
          displacement(0, 0, 0.4, 0), displacement(0, 0, 0, 1.5), displacement(-4, 3, 1, -4),
          displacement(2, 2, 48, 2), displacement(0.1, 0.1, -0.1, 0.2)}) {
        const auto found = register_clouds(a, moved(b, truth), place);
        ASSERT_TRUE(found);
        EXPECT_TRUE(found->fits()) << truth.matrix();
        const Pose correction = truth.inverse();
        EXPECT_LT((found->shift - correction.translation()).norm(), 0.03) << truth.matrix();
        EXPECT_NEAR(found->yaw / kDegree, std::atan2(correction(1, 0), correction(0, 0)) / kDegree,
                    0.1);
        EXPECT_EQ(found->at, place);
    }
}

TEST(PlaceOffset, ThingsThatMovedDoNotDisturbIt) {
    test::Random random(5);
    Points a = hall(1), b = hall(2);
    for (const float x :
         {-10.0F, -6.0F, -2.0F, 2.0F}) {  // parked cars of one drive, moved by 1.3 m
        const auto car = [&](float at) {
            return test::points_on(test::faces({at, -8.0F, -1.7F}, {at + 3.0F, -6.3F, -0.2F}), 25.0,
                                   0.01, random);
        };
        for (const Point& p : car(x)) a.push_back(p);
        for (const Point& p : car(x + 1.3F)) b.push_back(p);
    }
    const auto found = register_clouds(a, b, Eigen::Vector3d::Zero());
    ASSERT_TRUE(found);
    EXPECT_TRUE(found->fits());
    EXPECT_LT(found->shift.norm(), 0.03);
}

TEST(PlaceOffset, OtherSurroundingsDoNotFit) {
    test::Random random(7);
    auto surfaces = test::faces({-40, -40, -1.7F}, {40, 40, 30});
    for (int i = 0; i < 60; ++i) {
        const Point low(random.uniform_f(-30, 30), random.uniform_f(-30, 30), -1.7F);
        for (const auto& face : test::faces(low, low + Point(0.9F, 1.4F, 3.0F))) {
            surfaces.push_back(face);
        }
    }
    const Points other = test::points_on(surfaces, 10.0, 0.01, random);
    const auto found = register_clouds(hall(1), other, Eigen::Vector3d::Zero());
    ASSERT_TRUE(found);
    EXPECT_FALSE(found->fits()) << found->fit;
}

TEST(PlaceOffset, ACorridorDoesNotShowHowFarAlongItIs) {
    test::Random random(9);
    const auto corridor = test::corridor();
    const Points a = test::points_on(corridor, 20.0, 0.01, random);
    const Points b = test::points_on(corridor, 20.0, 0.01, random);
    const auto found = register_clouds(a, b, Eigen::Vector3d::Zero());
    ASSERT_TRUE(found);
    const FlatInformation covariance = found->information.inverse();
    EXPECT_GT(covariance(0, 0), 10.0 * covariance(1, 1));
}

TEST(PlaceOffset, FlatGroundAndNothingTellNothing) {
    test::Random random(11);
    const Points ground =
        test::points_on({{{-30, -30, -1.7F}, {60, 0, 0}, {0, 60, 0}}}, 10.0, 0.01, random);
    EXPECT_FALSE(register_clouds(ground, ground, Eigen::Vector3d::Zero()));
    EXPECT_FALSE(register_clouds({}, {}, Eigen::Vector3d::Zero()));
    EXPECT_FALSE(register_clouds({}, hall(1), Eigen::Vector3d::Zero()));
}

TEST(PlaceOffset, ACloudOfScansThatCannotBeReadIsEmpty) {
    Info info;
    info.scan_files = {"/nowhere/0.bin", "/nowhere/1.bin"};
    info.T_world_sensor.resize(2, Pose::Identity());
    info.stamps = {0.0, 0.1};
    EXPECT_TRUE(cloud_around(Recording(info), {0, 1, 2}, Eigen::Vector3d::Zero()).empty());
}

}  // namespace place_offset_test
}  // namespace dynamic_filter::io
