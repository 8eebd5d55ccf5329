// SPDX-License-Identifier: MIT
#include "check/company.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace dynamic_filter::io {
namespace company_test {

constexpr double kPi = std::numbers::pi;

/// A sensor that goes 1 m from scan to scan, with dynamic points at these azimuths [deg].
std::vector<DynamicBeside> way(const std::function<std::vector<double>(std::size_t)>& azimuths,
                               double step = 1.0, std::size_t count = 40) {
    std::vector<DynamicBeside> scans;
    for (std::size_t i = 0; i < count; ++i) {
        Points points = {Point(1.0F, 0.0F, 0.0F)};  // static
        Labels labels = {Label::static_};
        for (const double azimuth : azimuths(i)) {
            for (int k = 0; k < 10; ++k) {
                const double a = (azimuth + 0.2 * k) * kPi / 180.0;
                points.emplace_back(static_cast<float>(2.5 * std::cos(a)),
                                    static_cast<float>(2.5 * std::sin(a)), 0.1F);
                labels.push_back(Label::dynamic);
            }
        }
        Pose pose = Pose::Identity();
        pose.translation().x() = step * static_cast<double>(i);
        scans.push_back(dynamic_beside(points, pose, labels));
    }
    return scans;
}

TEST(Company, APersonWhoFollowsIsNamedWithHerPlace) {
    std::mt19937 random(1);
    std::normal_distribution<double> sway(0.0, 8.0);
    const auto behind = way([&](std::size_t) { return std::vector{187.0 + sway(random)}; });
    const auto said = company_of(behind);
    ASSERT_TRUE(said);
    EXPECT_NE(said->find("around x -2.5 m, y -0.3 m from the sensor"), std::string::npos) << *said;
}

TEST(Company, WhoPassesIsNone) {
    const auto passing =
        way([](std::size_t i) { return std::vector{9.0 * static_cast<double>(i)}; });
    EXPECT_FALSE(company_of(passing));
    const auto some_of_the_way =
        way([](std::size_t i) { return i < 30 ? std::vector{180.0} : std::vector<double>{}; });
    EXPECT_FALSE(company_of(some_of_the_way));
}

TEST(Company, APartOfTheVehicleIsNone) {
    EXPECT_FALSE(company_of(way([](std::size_t) { return std::vector{180.0}; })));
}

TEST(Company, InACrowdNobodyIs) {
    const auto crowd = way([](std::size_t) {
        std::vector<double> all;
        for (int k = 0; k < 12; ++k) all.push_back(30.0 * k);
        return all;
    });
    EXPECT_FALSE(company_of(crowd));
}

TEST(Company, BesideASensorThatRestsNobodyIs) {
    const auto behind = [](std::size_t i) { return std::vector{i % 2 == 0 ? 175.0 : 185.0}; };
    EXPECT_TRUE(company_of(way(behind)));
    EXPECT_FALSE(company_of(way(behind, 0.1)));
    EXPECT_FALSE(company_of({}));
}

}  // namespace company_test
}  // namespace dynamic_filter::io
