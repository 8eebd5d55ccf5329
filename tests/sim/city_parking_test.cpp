// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "sim/city.hpp"

namespace dynamic_filter::sim::city {
namespace city_parking_test {

constexpr std::uint64_t seed = 4;

/// Calls `use` with some blocks.
template <typename Use>
void for_blocks(const Use& use) {
    for (int x = -reserve; x < 5; ++x) {
        for (int y = -reserve; y < 5; ++y) use(Block{x, y});
    }
}

using Matrix = std::array<float, 16>;
Matrix key(const Fixture& fixture) {
    Matrix out;
    Eigen::Map<Eigen::Matrix4f>(out.data()) = fixture.placement.T_world_part.matrix();
    return out;
}

/// Where things of a block are, and their numbers.
std::map<Matrix, int> where(const Block& block, int drive, int drives) {
    std::map<Matrix, int> out;
    for (const Fixture& f : parked(seed, block, {drive, drives})) out[key(f)] = f.part.instance;
    return out;
}

TEST(CityParking, NumbersAreThoseOfThingsThatAreAbsentFromAnotherDrive) {
    std::size_t stay = 0, change = 0;
    for_blocks([&](const Block& block) {
        std::map<Matrix, int> days[] = {where(block, 1, 3), where(block, 2, 3), where(block, 3, 3)};
        for (const auto& day : days) {
            for (const auto& [at, number] : day) {
                const bool always =
                    days[0].contains(at) && days[1].contains(at) && days[2].contains(at);
                EXPECT_EQ(number == 0, always);
                for (const auto& other : days)
                    EXPECT_EQ(other.contains(at) ? other.at(at) : number, number);
                (always ? stay : change) += 1;
            }
        }
    });
    EXPECT_GT(stay, 500U);
    EXPECT_GT(change, 500U);
    EXPECT_LT(static_cast<double>(change), 1.5 * static_cast<double>(stay));
}

TEST(CityParking, ANumberIsThatOfOneCarOrSite) {
    std::map<int, std::set<std::pair<int, int>>> blocks;
    std::map<int, std::set<Matrix>> cars;
    for_blocks([&](const Block& block) {
        for (int drive = 1; drive <= 4; ++drive) {
            for (const Fixture& f : parked(seed, block, {drive, 4})) {
                if (f.part.instance == 0) continue;
                EXPECT_FALSE(f.part.is_still);
                EXPECT_EQ(f.placement.kind, Kind::temporary);
                blocks[f.part.instance].insert({block.x, block.y});
                if (f.part.prototype < slab) cars[f.part.instance].insert(key(f));
            }
        }
    });
    for (const auto& [number, at] : blocks) EXPECT_EQ(at.size(), 1U) << number;
    for (const auto& [number, at] : cars) EXPECT_EQ(at.size(), 1U) << number;
}

TEST(CityParking, ADriveHasTheSameCarsHoweverManyDrivesThereAre) {
    for_blocks([&](const Block& block) {
        const auto few = parked(seed, block, {2, 2}), many = parked(seed, block, {2, 7});
        ASSERT_EQ(few.size(), many.size());
        for (std::size_t i = 0; i < few.size(); ++i) EXPECT_EQ(key(few[i]), key(many[i]));
        for (const Fixture& f : parked(seed, block, {1, 1})) EXPECT_EQ(f.part.instance, 0);
    });
}

TEST(CityParking, SitesComeLaterAndTakeThePlacesOfCars) {
    int sites = 0;
    for_blocks([&](const Block& block) {
        for (int side = 0; side < 4; ++side) {
            const Site site = site_at(seed, block, side);
            if (site.first_drive == 0) continue;
            ++sites;
            EXPECT_GE(site.first_drive, 2);
            EXPECT_LE(site.first_place + site.places, places(side_of(block, side)));
            for (int i = 0; i < site.places; ++i) {
                EXPECT_EQ(car_at(seed, block, side, site.first_place + i, site.first_drive), 0);
            }
        }
        std::size_t before = 0, after = 0;
        for (const Fixture& f : parked(seed, block, {1, 3})) before += f.part.prototype == fence;
        for (const Fixture& f : parked(seed, block, {3, 3})) after += f.part.prototype == fence;
        EXPECT_EQ(before, 0U);
        EXPECT_GT(site_at(seed, block, 0).first_drive > 0 ? after : 5U, 4U);
    });
    EXPECT_GT(sites, 5);
}

TEST(CityParking, CarsStandBetweenLaneAndKerb) {
    for_blocks([&](const Block& block) {
        for (const Fixture& f : parked(seed, block, {1, 1})) {
            const Eigen::Vector2d p =
                f.placement.T_world_part.translation().head<2>().cast<double>();
            EXPECT_DOUBLE_EQ(ground(p), 0.0);
            EXPECT_EQ(f.placement.T_world_part.translation().z(), 0.0F);
        }
    });
}

}  // namespace city_parking_test
}  // namespace dynamic_filter::sim::city
