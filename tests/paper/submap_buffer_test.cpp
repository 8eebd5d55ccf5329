// SPDX-License-Identifier: MIT
#include "paper/submap_buffer.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/random.hpp"

namespace dynamic_filter {
namespace submap_buffer_test {

std::vector<BufferedSubmap> at(const std::vector<Eigen::Vector3d>& places) {
    std::vector<BufferedSubmap> buffer(places.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
        buffer[i].submap.T_map_submap.translation() = places[i];
    }
    return buffer;
}

std::size_t apart(std::size_t a, std::size_t b) { return a > b ? a - b : b - a; }

TEST(SearchRadius, AgreesWithBruteForce) {
    test::Random random(1);
    for (int repeat = 0; repeat < 200; ++repeat) {
        std::vector<Eigen::Vector3d> places;
        const std::size_t count = random.below(40);
        for (std::size_t i = 0; i < count; ++i) {  // a coarse lattice: many equal distances
            places.push_back(random.point(4.0).array().round().matrix().cast<double>());
        }
        const Eigen::Vector3d query = random.point(3.0).array().round().matrix().cast<double>();
        const double radius = random.uniform(0.0, 6.0);
        const std::size_t most = 1 + random.below(20), anchor = random.below(40);
        std::vector<std::size_t> expected;
        for (std::size_t i = 0; i < count; ++i) {
            if ((places[i] - query).norm() <= radius) expected.push_back(i);
        }
        std::stable_sort(expected.begin(), expected.end(), [&](std::size_t a, std::size_t b) {
            const double da = (places[a] - query).norm(), db = (places[b] - query).norm();
            return da != db ? da < db : apart(a, anchor) < apart(b, anchor);
        });
        expected.resize(std::min(expected.size(), most));
        EXPECT_EQ(search_radius(at(places), query, radius, most, anchor), expected);
    }
}

TEST(SearchRadius, TheRadiusIsInclusive) {
    const auto buffer = at({{3, 0, 0}, {0, 4, 0}});
    EXPECT_EQ(search_radius(buffer, {0, 0, 0}, 3.0, 9, 0), (std::vector<std::size_t>{0}));
    EXPECT_TRUE(search_radius(buffer, {0, 0, 0}, 2.999, 9, 0).empty());
    EXPECT_EQ(search_radius(buffer, {3, 0, 0}, 0.0, 9, 0), (std::vector<std::size_t>{0}));
}

TEST(SearchRadius, EqualDistancesGoByTheAgeApartFromTheAnchor) {
    const auto buffer = at({{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, 0, 1}});
    using Found = std::vector<std::size_t>;
    EXPECT_EQ(search_radius(buffer, {0, 0, 0}, 9.0, 3, 0), (Found{0, 1, 2}));
    EXPECT_EQ(search_radius(buffer, {0, 0, 0}, 9.0, 3, 3), (Found{3, 2, 1}));
    EXPECT_EQ(search_radius(buffer, {0, 0, 0}, 9.0, 1, 2), (Found{2}));
}

TEST(SearchRadius, AnEmptyBufferHasNothing) {
    EXPECT_TRUE(search_radius({}, {0, 0, 0}, 9.0, 3, 0).empty());
}

}  // namespace submap_buffer_test
}  // namespace dynamic_filter
