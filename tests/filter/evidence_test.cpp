// SPDX-License-Identifier: MIT
#include "filter/evidence.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <tuple>
#include <vector>

#include "support/random.hpp"

namespace dynamic_filter {
namespace evidence_test {

const DynamicScore score(ScansConfig{}.evidence);
constexpr unsigned kRun = 16;
void look(Evidence& e, Sight sight, unsigned weight = 1, bool hit = false) {
    record(e, {sight, weight, hit}, kRun);
}

/// 'o' occupied, 'O' and hit, '-' free with a beam through the voxel, '=' without, '.' weakly free,
/// ' ' unknown.
void observe(Evidence& e, std::string_view sights) {
    for (const char c : sights) {
        const Sight sight = c == 'o' || c == 'O' ? Sight::occupied
                            : c == '-'           ? Sight::passed
                            : c == '='           ? Sight::free
                            : c == '.'           ? Sight::weak_free
                                                 : Sight::unknown;
        look(e, sight, 1, c == 'O');
    }
}
Evidence after(std::string_view sights) {
    Evidence e;
    e.n_own = 1;
    observe(e, sights);
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
        look(e, i % 3 == 0 ? Sight::occupied : Sight::free);
        record_owner(e, static_cast<std::uint32_t>(i));
    }
    EXPECT_GT(e.free, 32000);
    EXPECT_NEAR(e.n_occ, e.n_own / 3.0, 10.0);
    EXPECT_NEAR(e.n_free, 2.0 * e.n_own / 3.0, 10.0);
    EXPECT_NEAR(e.n_switch, 2.0 * e.n_own / 3.0, 10.0);
    EXPECT_NEAR(e.free, 8.0 * e.n_free, 50.0);
}

TEST(Record, AScanOwnsAVoxelOnce) {
    Evidence e;
    for (const std::uint32_t scan : {0U, 0U, 3U, 3U, 4U}) record_owner(e, scan);
    EXPECT_EQ(e.n_own, 3);
    EXPECT_EQ(e.last_owner, 4U);
}

TEST(Record, AnObserverMayStandForOthers) {
    Evidence e = after("o");
    look(e, Sight::free, 4);
    look(e, Sight::unknown, 8);
    look(e, Sight::free, 2);
    EXPECT_EQ(e.n_occ, 1);
    EXPECT_EQ(e.n_free, 6);
    EXPECT_EQ(e.n_switch, 4);
    look(e, Sight::occupied, 100000);  // more than a counter holds
    EXPECT_GT(e.n_occ, 4000);
}

TEST(Record, AWeakSightCountsAnEighth) {
    const Evidence e = after("........-");
    EXPECT_EQ(e.n_free, 9);
    EXPECT_EQ(e.free, 2 * kSure);
    Evidence surface;
    look(surface, Sight::weak_occupied, 8);
    EXPECT_EQ(surface.n_occ, 8);
    EXPECT_EQ(surface.occupied, kSure);
    EXPECT_EQ(surface.last, Sight::occupied);
}

TEST(Record, ALongRunTellsNoMoreThanItsBeginning) {
    const std::string stay(kRun, 'O'), longer(10 * kRun, 'O');
    const Evidence brief = after(stay), parked = after(longer), twice = after(stay + "-" + longer);
    EXPECT_EQ(parked.n_occ, 10 * kRun);
    EXPECT_EQ(parked.occupied, brief.occupied);
    EXPECT_EQ(parked.hits, brief.hits);
    EXPECT_EQ(twice.hits, 2 * brief.hits);
    Evidence at_once;
    look(at_once, Sight::occupied, 10 * kRun, true);
    EXPECT_EQ(at_once.hits, brief.hits);
}

TEST(Record, ARunBeginsWithTheFirstPointAfterTheVoxelWasEmpty) {
    Evidence e;
    for (const std::uint32_t scan : {3U, 4U}) record_owner(e, scan);
    EXPECT_EQ(e.since, 3U);
    look(e, Sight::weak_free);
    record_owner(e, 5U);
    EXPECT_EQ(e.since, 3U);  // perhaps it was not empty
    look(e, Sight::free);
    EXPECT_TRUE(e.seen_empty);
    for (const std::uint32_t scan : {9U, 10U}) record_owner(e, scan);
    EXPECT_EQ(e.since, 9U);
    EXPECT_FALSE(e.seen_empty);
}

TEST(Record, HoursOfRestLeaveRoom) {
    Evidence e;
    for (std::uint32_t scan = 0; scan < 100; ++scan) record_owner(e, scan);
    record_moved(e, 50);
    EXPECT_EQ(e.moved, 50);
    record_moved(e, 1000000);
    record_moved(e, 1000000);
    EXPECT_GT(e.moved, 30000);
    EXPECT_LT(e.n_own, 100);
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
    for (const int n : {1, 3, 6, 12}) {
        const float value = score(after(std::string(static_cast<std::size_t>(n), 'o')));
        EXPECT_LT(value, last);
        last = value;
    }
    EXPECT_GE(last, -static_cast<float>(ScansConfig{}.evidence.static_limit));
}

// A busy place does not become static because the recording goes on: the same traffic ten or a
// hundred times as long gives the same score.
TEST(DynamicScore, IsTheSameHoweverLongTheSameGoesOn) {
    for (const std::string_view traffic :
         {"OO------o-------", "OOoO-ooO-ooooo-o", "OoOoOooooooooooo"}) {
        std::vector<float> scores;
        for (const int times : {10, 100, 1000}) {
            Evidence e;
            for (int i = 0; i < times; ++i) observe(e, traffic);
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
    const Evidence left = after("OOOOOOOOOOOO------------");
    const Evidence leaf = after("O-O-O-O-O-O-O-O-O-O-O-O-");
    EXPECT_EQ(left.n_occ, leaf.n_occ);
    EXPECT_EQ(left.n_free, leaf.n_free);
    EXPECT_GT(score(left), 0.0F);  // stood there half of the time, and left
    EXPECT_LT(score(leaf), 0.0F);
}

// A bar under a ceiling: few scans have a beam at its height, all others see free space.
TEST(DynamicScore, WhatIsThinIsStatic) {
    std::string bar, crossed;
    for (int i = 0; i < 10; ++i) {
        bar += "==O==-===";
        crossed += "==-==-==-";
    }
    EXPECT_LT(score(after(bar)), 0.0F);
    EXPECT_GT(score(after(crossed + "OO" + crossed)), 0.5F);
    EXPECT_GT(score(after("O==========")), 0.0F);  // one hit is too few for that
}

// A car at a light for five minutes, seen through for 2 s after it left.
TEST(DynamicScore, WhatLeavesIsDynamicHoweverLongItRested) {
    for (const std::size_t rested : {20U, 200U, 2000U}) {
        EXPECT_GT(score(after(std::string(rested, 'O') + "--------")), 0.0F) << rested;
    }
}

TEST(DynamicScore, WeakSightsDoNotOutweighSureOnes) {
    EXPECT_LT(score(after("OOOO....")), 0.0F);
    EXPECT_GT(score(after("OOOO" + std::string(12, '-'))), 0.0F);
}

TEST(DynamicScore, GrowsWithEveryPassAndFallsWithEveryReturn) {
    for (int n = 1; n < 40; ++n) {
        const std::string passes(static_cast<std::size_t>(n), '-');
        EXPECT_LE(score(after("oooo" + passes)), score(after("oooo" + passes + "-")));
        EXPECT_GE(score(after("oooo" + passes)), score(after("oooO" + passes)));
        EXPECT_GE(score(after("oooO" + passes)), score(after("oooOo" + passes)));
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

TEST(Record, ReturnsWhetherTheScoreMayHaveChanged) {
    const auto counters = [](const Evidence& e) {
        return std::tuple(e.occupied, e.free, e.hits, e.passes, e.n_switch, e.n_flicker,
                          is_unknown(e));
    };
    test::Random random(1);
    constexpr std::array kSights{Sight::unknown,    Sight::occupied, Sight::weak_occupied,
                                 Sight::free,       Sight::passed,   Sight::weak_free,
                                 Sight::weak_passed};
    int changed = 0, same = 0;
    for (int sequence = 0; sequence < 200; ++sequence) {
        Evidence e;
        Sight sight = Sight::unknown;
        for (int i = 0; i < 60; ++i) {
            if (random.chance(0.1)) sight = kSights[random.below(kSights.size())];
            const auto before = counters(e);
            const Observation o{sight, 1, random.chance(0.3)};
            const bool is_changed = record(e, o, kRun);
            ASSERT_EQ(is_changed, counters(e) != before);
            ++(is_changed ? changed : same);
        }
    }
    EXPECT_GT(changed, 1000);
    EXPECT_GT(same, 1000);
}

TEST(Record, OnlyARunThatGoesOnLeavesTheScoreAsItIs) {
    Evidence e;
    EXPECT_FALSE(record(e, {Sight::unknown}, kRun));
    for (unsigned i = 0; i < kRun; ++i) EXPECT_TRUE(record(e, {Sight::occupied, 1, true}, kRun));
    for (int i = 0; i < 5; ++i) EXPECT_FALSE(record(e, {Sight::occupied, 1, true}, kRun));
    EXPECT_TRUE(record(e, {Sight::weak_free}, kRun));
    EXPECT_TRUE(record(e, {Sight::passed}, kRun));
    Evidence once;
    EXPECT_TRUE(record(once, {Sight::weak_occupied}, kRun));
    once.run = kRun;  // nothing but that the voxel is known now changes
    EXPECT_TRUE(is_unknown(once));
    EXPECT_TRUE(record(once, {Sight::weak_occupied}, kRun));
    EXPECT_FALSE(is_unknown(once));
}

TEST(Record, ACounterAboveZeroStaysSoHoweverOftenItIsHalved) {
    Evidence e = after("-");
    for (std::uint32_t scan = 1; scan < 300000; ++scan) record_owner(e, scan);
    EXPECT_EQ(e.n_free, 1);
    EXPECT_EQ(e.passes, 1);
    EXPECT_EQ(e.n_flicker, 0);
}

TEST(Record, TheFirstScanMayHaveAnyNumber) {
    for (const std::uint32_t scan : {0U, 3U}) {
        Evidence e;
        record_owner(e, scan);
        record_owner(e, scan);
        EXPECT_EQ(e.n_own, 1);
        EXPECT_EQ(e.since, scan);
    }
}

// The formula of the header, for counters that are not scaled down.
TEST(DynamicScore, IsTheSmallerOfBothLogarithms) {
    const ScansConfig::Evidence c;
    Evidence e;
    e.n_occ = 10;
    e.occupied = 10 * kSure;
    e.hits = 10;
    e.free = 25 * kSure;
    e.n_switch = 3;
    e.n_flicker = 3;
    for (const unsigned passes : {3U, 5U, 8U, 25U}) {
        e.passes = static_cast<std::uint16_t>(passes);
        const double expected = c.flicker * std::pow(4.0, c.switch_power) *
                                std::pow(10.0, c.occupied_power) * std::pow(10.0, c.hit_power);
        const double all = std::log((25.0 + c.offset) / (expected + c.offset));
        const double thin = c.thin_flicker * std::pow(4.0, c.switch_power) *
                            std::pow(10.0, c.occupied_power + c.hit_power);
        const double near =
            std::log((passes + c.thin_offset) / (thin + c.thin_offset)) + c.thin_benefit;
        const double least = -c.static_limit;
        EXPECT_NEAR(score(e), std::clamp(c.gain * std::min(all, near), least, 1.0), 1e-3);
        EXPECT_NEAR(score.expected_free(e), expected, 1e-3);
    }
}

}  // namespace evidence_test
}  // namespace dynamic_filter
