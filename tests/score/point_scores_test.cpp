// SPDX-License-Identifier: MIT
#include "dynamic_filter/scores.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace dynamic_filter::eval {
namespace point_scores_test {

TEST(PointScore, IsWorkedByHand) {
    const PointScore s =
        point_score({.still = 200, .dynamic = 50, .covered_still = 180, .covered_dynamic = 10});
    EXPECT_DOUBLE_EQ(*s.sa, 0.9);
    EXPECT_DOUBLE_EQ(*s.da, 0.8);
    EXPECT_DOUBLE_EQ(*s.aa, std::sqrt(0.72));
    EXPECT_DOUBLE_EQ(*s.ha, 2 * 0.72 / 1.7);
    EXPECT_FALSE(s.iou);
}

TEST(PointScore, IsUndefinedWithoutPointsOfAKind) {
    const PointScore s =
        point_score({.still = 10, .dynamic = 0, .covered_still = 10, .covered_dynamic = 0});
    EXPECT_DOUBLE_EQ(*s.sa, 1.0);
    EXPECT_FALSE(s.da);
    EXPECT_FALSE(s.aa);
    const PointScore none =
        point_score({.still = 1, .dynamic = 1, .covered_still = 0, .covered_dynamic = 1});
    EXPECT_DOUBLE_EQ(*none.ha, 0.0);
}

TEST(CoverCount, CountsPointsByTheirTruth) {
    CoverCount count;
    for (int i = 0; i < 5; ++i) count.add(Label::static_, i < 3);
    for (int i = 0; i < 7; ++i) count.add(Label::dynamic, i < 1);
    EXPECT_EQ(count.still, 5U);
    EXPECT_EQ(count.covered_still, 3U);
    EXPECT_EQ(count.dynamic, 7U);
    EXPECT_EQ(count.covered_dynamic, 1U);
}

TEST(Confusion, CountsTheDynamicClassOnly) {
    Confusion c;
    EXPECT_FALSE(c.iou());
    c.add(Label::static_, Label::static_);
    EXPECT_FALSE(c.iou());
    c.add(Label::dynamic, Label::dynamic);
    c.add(Label::dynamic, Label::dynamic);
    c.add(Label::dynamic, Label::static_);
    c.add(Label::dynamic, Label::unknown);  // kept, so missed
    c.add(Label::static_, Label::dynamic);
    EXPECT_DOUBLE_EQ(*c.iou(), 2.0 / 5.0);
}

}  // namespace point_scores_test
}  // namespace dynamic_filter::eval
