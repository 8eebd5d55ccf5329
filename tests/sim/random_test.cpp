// SPDX-License-Identifier: MIT
#include "sim/random.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace dynamic_filter::sim::random_test {

TEST(Random, UnitHasMeanAndVarianceOfTheUniform) {
    constexpr int n = 100000;
    double sum = 0.0, squares = 0.0;
    for (std::uint64_t i = 0; i < n; ++i) {
        const double u = unit(hash(7, i));
        ASSERT_GE(u, 0.0);
        ASSERT_LT(u, 1.0);
        sum += u;
        squares += u * u;
    }
    EXPECT_NEAR(sum / n, 0.5, 0.005);
    EXPECT_NEAR(squares / n, 1.0 / 3.0, 0.005);
}

TEST(Random, NormalHasItsMoments) {
    constexpr int n = 100000;
    double sum = 0.0, squares = 0.0, fourth = 0.0;
    for (std::uint64_t i = 0; i < n; ++i) {
        const double x = normal(hash(3, i));
        sum += x;
        squares += x * x;
        fourth += x * x * x * x;
    }
    EXPECT_NEAR(sum / n, 0.0, 0.015);
    EXPECT_NEAR(squares / n, 1.0, 0.02);
    EXPECT_NEAR(fourth / n, 3.0, 0.2);
}

TEST(Random, SameKeySameDraws) {
    Random a{5}, b{5}, c{6};
    EXPECT_EQ(a.bits(), b.bits());
    EXPECT_EQ(a.uniform(2.0, 3.0), b.uniform(2.0, 3.0));
    EXPECT_NE(a.bits(), c.bits());
    for (int i = 0; i < 100; ++i) EXPECT_LT(a.below(3), 3);
}

}  // namespace dynamic_filter::sim::random_test
