// SPDX-License-Identifier: MIT
#include "sim/signal.hpp"

#include <gtest/gtest.h>

namespace dynamic_filter::sim::signal_test {

TEST(Signal, IsRedForItsPartOfEveryCycle) {
    const Signal signal{.cycle = 75.0, .red = 48.0, .first = 10.0};
    for (const double cycle : {-75.0, 0.0, 75.0, 750.0}) {
        EXPECT_FALSE(is_red(signal, cycle + 9.9));
        EXPECT_TRUE(is_red(signal, cycle + 10.1));
        EXPECT_TRUE(is_red(signal, cycle + 57.9));
        EXPECT_FALSE(is_red(signal, cycle + 58.1));
    }
}

TEST(Signal, PeopleSetOutEarlyInTheRedOnly) {
    const Signal signal{.cycle = 75.0, .red = 48.0, .first = 0.0, .settle = 3.0, .release = 22.0};
    EXPECT_DOUBLE_EQ(may_walk(signal, 0.0), 3.0);
    EXPECT_DOUBLE_EQ(may_walk(signal, 3.0), 3.0);
    EXPECT_DOUBLE_EQ(may_walk(signal, 21.0), 21.0);
    EXPECT_DOUBLE_EQ(may_walk(signal, 22.0), 78.0);
    EXPECT_DOUBLE_EQ(may_walk(signal, 60.0), 78.0);
    EXPECT_DOUBLE_EQ(may_walk(signal, -10.0), 3.0);
}

}  // namespace dynamic_filter::sim::signal_test
