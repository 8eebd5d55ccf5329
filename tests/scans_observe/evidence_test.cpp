// SPDX-License-Identifier: MIT
#include "dynamic_filter/scans_observe/evidence.hpp"

#include <gtest/gtest.h>

#include <string_view>

namespace dynamic_filter {
namespace {

const DynamicScore score(ScansConfig{}.evidence);

/// 'o' occupied, '-' free, ' ' unknown.
Evidence after(std::string_view sights, std::uint16_t owned = 1) {
    Evidence e;
    for (const char c : sights) {
        record(e, c == 'o' ? Sight::occupied : c == '-' ? Sight::free : Sight::unknown);
    }
    e.n_own = owned;
    return e;
}

TEST(Record, CountsObserversAndChanges) {
    const Evidence e = after(" oo -- o ---o");
    EXPECT_EQ(e.n_occ, 4);
    EXPECT_EQ(e.n_free, 5);
    EXPECT_EQ(e.n_switch, 4);
    EXPECT_EQ(e.last, Sight::occupied);
}

TEST(Record, CountersStopAtTheirLargestValue) {
    Evidence e;
    for (int i = 0; i < 70000; ++i) record(e, i % 2 == 0 ? Sight::occupied : Sight::free);
    for (int i = 0; i < 70000; ++i) record(e, i % 2 == 0 ? Sight::occupied : Sight::free);
    EXPECT_EQ(e.n_occ, 65535);
    EXPECT_EQ(e.n_free, 65535);
    EXPECT_EQ(e.n_switch, 65535);
}

TEST(Record, AnObserverMayStandForOthers) {
    Evidence e = after("o");
    record(e, Sight::free, 4);
    record(e, Sight::unknown, 8);
    record(e, Sight::free, 2);
    EXPECT_EQ(e.n_occ, 1);
    EXPECT_EQ(e.n_free, 6);
    EXPECT_EQ(e.n_switch, 4);
    record(e, Sight::occupied, 100000);
    EXPECT_EQ(e.n_occ, 65535);
}

TEST(IsUnknown, UntilItIsPassedOrSeenTwice) {
    EXPECT_TRUE(is_unknown(after("")));
    EXPECT_TRUE(is_unknown(after("o  ")));
    EXPECT_FALSE(is_unknown(after(" -")));
    EXPECT_FALSE(is_unknown(after("o -")));
    EXPECT_FALSE(is_unknown(after("oo")));
}

TEST(DynamicScore, NeverPassedIsStaticAndTheMoreSoTheMoreLooked) {
    float last = 0.0F;
    for (const int n : {1, 3, 10, 100}) {
        const float value = score(after(std::string(static_cast<std::size_t>(n), 'o')));
        EXPECT_LT(value, last);
        last = value;
    }
    EXPECT_GE(last, -1.0F);
}

TEST(DynamicScore, ReturnedOnceAndPassedEverAfterIsDynamic) {
    EXPECT_GT(score(after("o----------")), 0.5F);
    EXPECT_GT(score(after("-----o-----")), 0.5F);
    EXPECT_LE(score(after("o" + std::string(1000, '-'))), 1.0F);
}

TEST(DynamicScore, OneLongRunSaysMoreThanTheSameNumberOfShortOnes) {
    const Evidence left = after("oooooooooooo------------", 12);
    const Evidence leaf = after("o-o-o-o-o-o-o-o-o-o-o-o-", 12);
    EXPECT_EQ(left.n_occ, leaf.n_occ);
    EXPECT_EQ(left.n_free, leaf.n_free);
    EXPECT_GT(score(left), 0.0F);  // stood there half of the time, and left
    EXPECT_LT(score(leaf), 0.0F);
}

TEST(DynamicScore, GrowsWithEveryPassAndFallsWithEveryReturn) {
    for (int n = 1; n < 40; ++n) {
        const std::string passes(static_cast<std::size_t>(n), '-');
        EXPECT_LE(score(after("oooo" + passes)), score(after("oooo" + passes + "-")));
        EXPECT_GE(score(after("oooo" + passes, 1)), score(after("oooo" + passes, 2)));
    }
}

Evidence owned_between(std::uint32_t first, std::uint32_t last) {
    Evidence e;
    e.first_owner = first;
    e.last_owner = last;
    return e;
}

TEST(CoPresence, IsTheOverlapOfTheirTimes) {
    EXPECT_FLOAT_EQ(co_presence(owned_between(3, 7), owned_between(3, 7)), 1.0F);
    EXPECT_FLOAT_EQ(co_presence(owned_between(0, 9), owned_between(5, 5)), 0.1F);
    EXPECT_FLOAT_EQ(co_presence(owned_between(5, 5), owned_between(0, 9)), 0.1F);
    EXPECT_FLOAT_EQ(co_presence(owned_between(0, 3), owned_between(2, 5)), 2.0F / 6.0F);
    EXPECT_FLOAT_EQ(co_presence(owned_between(0, 3), owned_between(4, 5)), 0.0F);
    EXPECT_FLOAT_EQ(co_presence(owned_between(9, 9), owned_between(0, 8)), 0.0F);
}

}  // namespace
}  // namespace dynamic_filter
