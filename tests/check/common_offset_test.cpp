// SPDX-License-Identifier: MIT
#include "check/common_offset.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/random.hpp"

namespace dynamic_filter::io {
namespace common_offset_test {

constexpr double kDegree = 3.14159265358979 / 180.0;

FlatInformation precise() {
    const Eigen::Vector4d deviations(0.03, 0.03, 0.03, 0.06 * kDegree);
    return deviations.cwiseAbs2().cwiseInverse().asDiagonal();
}

/// Places 50 m apart with the correction "turn about `pivot`, then shift".
std::vector<PlaceOffset> places(const Eigen::Vector3d& pivot, const Eigen::Vector3d& shift,
                                double yaw, std::size_t count = 8) {
    const Eigen::AngleAxisd turn(yaw, Eigen::Vector3d::UnitZ());
    std::vector<PlaceOffset> all;
    for (std::size_t i = 0; i < count; ++i) {
        const double along = 50.0 * static_cast<double>(i);
        const Eigen::Vector3d at = pivot + Eigen::Vector3d(along - 100.0, 0.2 * along, 0.0);
        all.push_back({at, turn * (at - pivot) + pivot + shift - at, yaw, precise(), 0.8});
    }
    return all;
}

TEST(CommonOffset, IsFoundExactly) {
    const auto all = places({5e5, -4e6, 100.0}, {0.3, -1.2, 0.4}, 1.5 * kDegree);
    const CommonOffset common = fit_common(all);
    EXPECT_EQ(common.agreeing(), 8U);
    EXPECT_TRUE(common.is_agreed());
    EXPECT_NEAR(common.yaw, 1.5 * kDegree, 1e-9);
    for (const PlaceOffset& place : all) {
        const Eigen::AngleAxisd turn(common.yaw, Eigen::Vector3d::UnitZ());
        const Eigen::Vector3d arm = place.at - common.pivot;
        EXPECT_LT((turn * arm - arm + common.shift - place.shift).norm(), 1e-6);
    }
    EXPECT_FALSE(no_offset(all).is_agreed());
}

TEST(CommonOffset, SinglePlacesThatDifferDoNotSpoilIt) {
    auto all = places({0, 0, 0}, {1.5, -2.0, 0.0}, 0.0);
    all[2].shift = {-4.0, 1.0, 0.3};
    all[7].shift = {5.0, 5.0, 0.0};
    const CommonOffset common = fit_common(all);
    EXPECT_EQ(common.agreeing(), 6U);
    EXPECT_TRUE(common.is_agreed());
    EXPECT_LT((common.shift - Eigen::Vector3d(1.5, -2.0, 0.0)).norm(), 0.02);
    EXPECT_GT(common.differences[2], 3.0);
}

TEST(CommonOffset, DriftIsNoCommonOffset) {
    test::Random random(3);
    auto all = places({0, 0, 0}, {0, 0, 0}, 0.0);
    for (PlaceOffset& place : all) place.shift += random.pose(0.4, 0.0).translation();
    EXPECT_FALSE(fit_common(all).is_agreed());
    EXPECT_FALSE(no_offset(all).is_agreed());
}

TEST(CommonOffset, SmallOffsetsAreNone) {
    EXPECT_TRUE(no_offset(places({0, 0, 0}, {0.05, 0.03, -0.05}, 0.0)).is_agreed());
    EXPECT_FALSE(no_offset(places({0, 0, 0}, {0.12, 0.0, 0.0}, 0.0)).is_agreed());
    EXPECT_FALSE(no_offset(places({0, 0, 0}, {0.0, 0.0, 0.12}, 0.0)).is_agreed());
    EXPECT_FALSE(no_offset(places({0, 0, 0}, {0.0, 0.0, 0.0}, 0.3 * kDegree, 1)).is_agreed());
}

TEST(CommonOffset, DirectionsThatAPlaceDoesNotShowDoNotCount) {
    auto all = places({0, 0, 0}, {0.5, 0.0, 0.0}, 0.0);
    for (std::size_t i = 1; i < all.size(); ++i) {
        all[i].shift.x() = -3.0;  // along a tunnel any value is as good
        all[i].information(0, 0) = 1.0 / (10.0 * 10.0);
    }
    const CommonOffset common = fit_common(all);
    EXPECT_EQ(common.agreeing(), 8U);
    EXPECT_NEAR(common.shift.x(), 0.5, 0.02);
}

TEST(CommonOffset, OfOnePlaceIsItsOwn) {
    const auto all = places({0, 0, 0}, {0.0, 0.0, 0.4}, 0.0, 1);
    const CommonOffset common = fit_common(all);
    EXPECT_TRUE(common.is_agreed());
    EXPECT_NEAR(common.shift.z(), 0.4, 1e-6);
}

}  // namespace common_offset_test
}  // namespace dynamic_filter::io
