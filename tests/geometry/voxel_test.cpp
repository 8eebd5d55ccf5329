// SPDX-License-Identifier: MIT
#include "geometry/voxel.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <tuple>

#include "support/random.hpp"

namespace dynamic_filter {
namespace voxel_test {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

Cell random_cell(test::Random& random) {
    const auto axis = [&] {
        if (random.chance(0.2)) return random.chance(0.5) ? -kCellLimit : kCellLimit - 1;
        return static_cast<int>(random.below(2 * kCellLimit)) - kCellLimit;
    };
    const int x = axis(), y = axis();
    return {x, y, axis()};
}

TEST(Voxel, KeysRoundTripUpToTheLimits) {
    test::Random random(1);
    for (int i = 0; i < 10000; ++i) {
        const Cell cell = random_cell(random);
        ASSERT_TRUE(fits(cell));
        ASSERT_EQ(unpack(pack(cell)), cell);
    }
}

TEST(Voxel, KeysSortAsTheirCellsDo) {
    test::Random random(2);
    const auto triple = [](const Cell& c) { return std::make_tuple(c.x(), c.y(), c.z()); };
    for (int i = 0; i < 10000; ++i) {
        const Cell a = random_cell(random), b = random_cell(random);
        ASSERT_EQ(pack(a) < pack(b), triple(a) < triple(b));
    }
}

TEST(Voxel, CellsBeyondTheLimitsDoNotFit) {
    for (int axis = 0; axis < 3; ++axis) {
        for (const int v : {-kCellLimit - 1, kCellLimit}) {
            Cell cell = Cell::Zero();
            cell[axis] = v;
            EXPECT_FALSE(fits(cell));
        }
    }
}

TEST(Voxel, CellsAreHalfOpenAlsoBelowZero) {
    for (int k = -8; k <= 8; ++k) {
        const auto border = 0.25F * static_cast<float>(k);
        const float below = std::nextafter(border, -kInf);
        for (int axis = 0; axis < 3; ++axis) {
            Point on = Point::Constant(0.1F), under = on;
            on[axis] = border;
            under[axis] = below;
            ASSERT_EQ((*cell_of(on, 4.0F))[axis], k);
            ASSERT_EQ((*cell_of(under, 4.0F))[axis], k - 1);
        }
    }
    EXPECT_EQ(*cell_of({-0.0F, 0.0F, -1e-30F}, 5.0F), Cell(0, 0, -1));
}

TEST(Voxel, PointsThatAreNotFiniteOrTooFarHaveNoCell) {
    const auto limit = static_cast<float>(kCellLimit);
    for (const float v : {kInf, -kInf, kNan, limit, -limit, 1e30F, -1e30F}) {
        for (int axis = 0; axis < 3; ++axis) {
            Point p = Point::Zero();
            p[axis] = v;
            EXPECT_FALSE(cell_of(p, 1.0F)) << v;
        }
    }
    EXPECT_EQ(*cell_of(Point::Constant(limit - 1.0F), 1.0F), Cell::Constant(kCellLimit - 1));
    EXPECT_EQ(*cell_of(Point::Constant(1.0F - limit), 1.0F), Cell::Constant(1 - kCellLimit));
}

TEST(Voxel, TheCenterLiesInItsCellAndHalfACellFromItsCorner) {
    test::Random random(3);
    for (const float size : {0.05F, 0.2F, 0.25F, 1.0F}) {
        for (int i = 0; i < 2000; ++i) {
            const Cell cell = random_cell(random) / 8;
            const Point c = center(pack(cell), size);
            ASSERT_EQ(*cell_of(c, 1.0F / size), cell);
        }
        EXPECT_TRUE(center(pack(Cell::Zero()), size).isApprox(Point::Constant(0.5F * size)));
        EXPECT_TRUE(center(pack({-1, -1, -1}), size).isApprox(Point::Constant(-0.5F * size)));
    }
}

TEST(Voxel, TheHashSpreadsNeighboursOverSmallTables) {
    std::vector<int> load(1024, 0);
    std::set<std::size_t> hashes;
    for (int x = -16; x < 16; ++x) {
        for (int y = -16; y < 16; ++y) {
            for (int z = -16; z < 16; ++z) {
                const std::size_t hash = VoxelHash{}(pack({x, y, z}));
                hashes.insert(hash);
                ++load[hash % load.size()];
            }
        }
    }
    EXPECT_EQ(hashes.size(), 32U * 32U * 32U);
    EXPECT_LT(*std::max_element(load.begin(), load.end()), 3 * 32);
}

}  // namespace voxel_test
}  // namespace dynamic_filter
