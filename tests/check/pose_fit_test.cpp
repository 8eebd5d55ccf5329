// SPDX-License-Identifier: MIT
#include "check/pose_fit.hpp"

#include <gtest/gtest.h>

namespace dynamic_filter::io {
namespace pose_fit_test {

PoseFit fit(double share, double blur) { return {{share, share, 0.0, 0.0}, blur}; }

TEST(PoseFit, MoreStructuresOrAsManyMoreSharplyAreBetter) {
    EXPECT_TRUE(is_better(fit(0.7, 0.05), fit(0.5, 0.05)));
    EXPECT_TRUE(is_better(fit(0.7, 0.05), fit(0.7, 0.06)));
    EXPECT_FALSE(is_better(fit(0.7, 0.05), fit(0.7, 0.05)));
    // What stands still looks sharp, but explains less.
    EXPECT_FALSE(is_better(fit(0.5, 0.04), fit(0.7, 0.05)));
}

TEST(PoseFit, TheMeanLeavesOutSeparationsThatAreNotThere) {
    EXPECT_DOUBLE_EQ(fit(0.6, 0.1).mean_overlay(), 0.6);
    EXPECT_EQ(PoseFit{}.mean_overlay(), 0.0);
    EXPECT_EQ(to_text(fit(0.6, 0.123)), "60, 60 % (1, 5 scans apart), blur 12.3 cm");
}

}  // namespace pose_fit_test
}  // namespace dynamic_filter::io
