// SPDX-License-Identifier: MIT
#include "base/numbers.hpp"

#include <gtest/gtest.h>

#include <array>
#include <set>

namespace dynamic_filter {
namespace numbers_test {

TEST(Numbers, TheMedianIsTheUpperMiddle) {
    EXPECT_EQ(median(std::vector<double>{}), 0.0);
    EXPECT_EQ(median(std::vector<float>{3.0F}), 3.0F);
    EXPECT_EQ(median(std::vector<int>{4, 1, 3, 2}), 3);
    EXPECT_EQ(median(std::vector<int>{5, 1, 4, 2, 3}), 3);
}

TEST(Numbers, OneInAHundredMayBeAboveTheUsualMost) {
    EXPECT_EQ(usual_most(std::vector<int>{}), 0);
    EXPECT_EQ(usual_most(std::vector<int>{7}), 7);
    std::vector<int> values;
    for (int i = 100; i >= 0; --i) values.push_back(i);
    EXPECT_EQ(usual_most(values), 99);
    values.front() = 1'000'000;
    EXPECT_EQ(usual_most(values), 99);
}

TEST(Numbers, CellsNextToEachOtherHaveDifferentHashes) {
    std::set<std::size_t> hashes;
    for (int x = -5; x <= 5; ++x) {
        for (int y = -5; y <= 5; ++y) hashes.insert(NumbersHash{}(std::array{x, y, 0}));
    }
    EXPECT_EQ(hashes.size(), 121U);
    EXPECT_EQ(NumbersHash{}(std::array<std::int32_t, 2>{-1, 7}),
              NumbersHash{}(std::array<std::int64_t, 2>{-1, 7}));
}

}  // namespace numbers_test
}  // namespace dynamic_filter
