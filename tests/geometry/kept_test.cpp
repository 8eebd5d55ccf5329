// SPDX-License-Identifier: MIT
#include "geometry/kept.hpp"

#include <gtest/gtest.h>

namespace dynamic_filter {
namespace kept_test {

TEST(Kept, WhatMovedIsRemovedUnlessItStays) {
    for (const bool keep_unknown : {false, true}) {
        EXPECT_EQ(where(Label::dynamic, false, keep_unknown), Kept::removed);
        EXPECT_EQ(where(Label::dynamic, true, keep_unknown), Kept::in_map);
        EXPECT_EQ(where(Label::static_, false, keep_unknown), Kept::in_map);
    }
}

TEST(Kept, UnknownPointsAreKeptIfWanted) {
    EXPECT_EQ(where(Label::unknown, false, true), Kept::in_map);
    EXPECT_EQ(where(Label::unknown, false, false), Kept::nowhere);
}

}  // namespace kept_test
}  // namespace dynamic_filter
