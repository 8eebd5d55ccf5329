// SPDX-License-Identifier: MIT
#include "sim/portable.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace dynamic_filter::sim::portable_test {

TEST(Portable, AgreesWithTheLibrary) {
    for (double x = -30.0; x < 30.0; x += 0.0137) {
        EXPECT_NEAR(portable_exp(x) / std::exp(x), 1.0, 1e-12);
        EXPECT_NEAR(portable_sincos(x).sin, std::sin(x), 1e-12);
        EXPECT_NEAR(portable_sincos(x).cos, std::cos(x), 1e-12);
    }
    for (double x = 1e-12; x < 1e6; x *= 1.37) EXPECT_NEAR(portable_log(x), std::log(x), 1e-11);
}

TEST(Portable, LargeAngles) {
    EXPECT_NEAR(portable_sincos(98765.4).sin, std::sin(98765.4), 1e-10);
    EXPECT_NEAR(portable_sincos(-98765.4).cos, std::cos(98765.4), 1e-10);
}

}  // namespace dynamic_filter::sim::portable_test
