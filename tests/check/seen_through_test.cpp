// SPDX-License-Identifier: MIT
#include "check/seen_through.hpp"

#include <gtest/gtest.h>

namespace dynamic_filter::io {
namespace seen_through_test {

/// A wall across the x axis, 10 m high and 20 m wide.
Points wall(float x) {
    Points points;
    for (float y = -10.0F; y <= 10.0F; y += 0.05F) {
        for (float z = -2.0F; z <= 4.0F; z += 0.05F) points.emplace_back(x, y, z);
    }
    return points;
}

TEST(SeenThrough, WhatIsThereWasHit) { EXPECT_EQ(seen_through(wall(12.0F), wall(12.1F)), 0.0); }

TEST(SeenThrough, WhatStandsInFrontWasSeenThrough) {
    EXPECT_GT(seen_through(wall(20.0F), wall(12.0F)), 0.9);
}

TEST(SeenThrough, WhatLiesBehindTellsNothing) {
    EXPECT_EQ(seen_through(wall(12.0F), wall(20.0F)), 0.0);
}

TEST(SeenThrough, SharesAreOfBoth) {
    Points both = wall(20.0F);
    for (const Point& p : wall(12.0F)) {
        if (p.y() > 0.0F) both.push_back(p);
    }
    const double share = seen_through(wall(20.0F), both);
    EXPECT_GT(share, 0.1);
    EXPECT_LT(share, 0.45);
}

TEST(SeenThrough, NothingTellsNothing) {
    EXPECT_EQ(seen_through({}, wall(5.0F)), 0.0);
    EXPECT_EQ(seen_through(wall(5.0F), {}), 0.0);
}

}  // namespace seen_through_test
}  // namespace dynamic_filter::io
