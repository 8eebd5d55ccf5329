// SPDX-License-Identifier: MIT
#include "dynamic_filter/scans_observe/evidence.hpp"

#include <gtest/gtest.h>

#include <string_view>
#include <vector>

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

TEST(Record, BeforeACounterOverflowsAllAreHalved) {
    Evidence e;
    for (int i = 0; i < 300000; ++i) {
        record(e, i % 3 == 0 ? Sight::occupied : Sight::free);
        record_owner(e, static_cast<std::uint32_t>(i));
    }
    EXPECT_GT(e.n_own, 32000);
    EXPECT_NEAR(e.n_occ, e.n_own / 3.0, 10.0);
    EXPECT_NEAR(e.n_free, 2.0 * e.n_own / 3.0, 10.0);
    EXPECT_NEAR(e.n_switch, 2.0 * e.n_own / 3.0, 10.0);
}

TEST(Record, AScanOwnsAVoxelOnce) {
    Evidence e;
    for (const std::uint32_t scan : {0U, 0U, 3U, 3U, 4U}) record_owner(e, scan);
    EXPECT_EQ(e.n_own, 3);
    EXPECT_EQ(e.last_owner, 4U);
}

TEST(Record, AnObserverMayStandForOthers) {
    Evidence e = after("o");
    record(e, Sight::free, 4);
    record(e, Sight::unknown, 8);
    record(e, Sight::free, 2);
    EXPECT_EQ(e.n_occ, 1);
    EXPECT_EQ(e.n_free, 6);
    EXPECT_EQ(e.n_switch, 4);
    record(e, Sight::occupied, 100000);  // more than a counter holds
    EXPECT_GT(e.n_occ, 30000);
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

// A busy place does not become static because the recording goes on: the same traffic ten or a
// hundred times as long gives the same score.
TEST(DynamicScore, IsTheSameHoweverLongTheSameGoesOn) {
    for (const std::string_view traffic :
         {"oo------o-------", "oooo-ooo-ooooo-o", "oooooooooooooooo"}) {
        std::vector<float> scores;
        for (const int times : {10, 100, 1000}) {
            Evidence e;
            for (int i = 0; i < times; ++i) {
                for (const char c : traffic) record(e, c == 'o' ? Sight::occupied : Sight::free);
            }
            e.n_own = e.n_occ;
            scores.push_back(score(e));
        }
        EXPECT_NEAR(scores[1], scores[0], 0.03F) << traffic;
        EXPECT_NEAR(scores[2], scores[0], 0.03F) << traffic;
    }
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
