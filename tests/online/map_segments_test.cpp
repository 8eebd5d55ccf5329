// SPDX-License-Identifier: MIT
#include "online/map_segments.hpp"

#include <gtest/gtest.h>

#include "support/outcome.hpp"

namespace dynamic_filter {
namespace map_segments_test {

using test::drive;
using test::RoomScan;

OnlineOptions with_horizon(double metres) {
    OnlineOptions options;
    options.horizon = metres;
    options.max_bytes = 0;
    return options;
}

Config every_scan() {
    Config config;
    config.keyframe.interval = 0.0;
    return config;
}

/// Pushes scans [from, to), a new map before each of `breaks`.
void fill(MapSegments& maps, const std::vector<RoomScan>& scans,
          const std::vector<std::size_t>& breaks) {
    for (const RoomScan& s : scans) {
        if (std::find(breaks.begin(), breaks.end(), s.scan.index) != breaks.end()) {
            maps.begin(s.scan.index);
        }
        maps.newest().push(s.scan);
    }
}

TEST(MapSegments, AScanIsJudgedByTheMapItWentTo) {
    const auto scans = drive(12, true);
    MapSegments maps(every_scan(), with_horizon(0.0));
    fill(maps, scans, {6});
    maps.finish();
    EXPECT_EQ(maps.size(), 2U);
    DynamicFilter second(every_scan());
    for (std::size_t i = 6; i < 12; ++i) second.push(scans[i].scan);
    second.finish();
    EXPECT_EQ(maps.verdict(scans[8].scan).labels, second.verdict(scans[8].scan).labels);
    EXPECT_EQ(maps.contents().observers, 12U);
    EXPECT_GT(maps.contents().voxels, second.contents().voxels);
    EXPECT_EQ(maps.times().at("judge").count(), 12U);
    EXPECT_GT(maps.static_map().size(), second.static_map().size());
}

TEST(MapSegments, WithAHorizonTheMapBeforeABreakIsForgotten) {
    const auto scans = drive(12, true);
    MapSegments maps(every_scan(), with_horizon(200.0));
    fill(maps, scans, {6});
    maps.finish();
    EXPECT_EQ(maps.size(), 1U);
    EXPECT_TRUE(test::all_are({maps.verdict(scans[3].scan)}, Label::unknown));
    EXPECT_FALSE(test::all_are({maps.verdict(scans[8].scan)}, Label::unknown));
}

TEST(MapSegments, ABreakReturnsTheVerdictsOfAWindowThatIsNotFull) {
    const auto scans = drive(5, true);
    for (const double horizon : {0.0, 200.0}) {
        MapSegments maps(test::small_windows(), with_horizon(horizon));
        fill(maps, scans, {});
        EXPECT_EQ(maps.begin(5).size(), scans.size());
    }
}

TEST(MapSegments, TheMapIsCutAfterAQuarterOfTheHorizon) {
    const auto scans = drive(2, false);  // in a hall of 15 m by 10 m
    MapSegments maps(every_scan(), with_horizon(4.0));
    maps.newest().push(scans[0].scan);
    const std::size_t whole = maps.newest().size();
    const auto forget_at = [&](double x) {
        Pose pose = scans[0].scan.T_world_sensor;
        pose.translation().x() += x;
        maps.forget_far(pose);
        return maps.newest().size();
    };
    EXPECT_EQ(forget_at(0.0), whole);  // where it begins
    EXPECT_EQ(forget_at(0.9), whole);
    const std::size_t cut = forget_at(1.1);
    EXPECT_LT(cut, whole * 8 / 10);
    EXPECT_GT(cut, 100U);
    maps.newest().push(scans[1].scan);
    const std::size_t grown = maps.newest().size();
    EXPECT_GT(grown, cut);
    EXPECT_EQ(forget_at(2.0), grown);  // 0.9 m on
    EXPECT_LT(forget_at(2.2), grown);
}

TEST(MapSegments, ScansAreSettledInOrderAndOnce) {
    const auto scans = drive(6, false);
    MapSegments maps(every_scan(), with_horizon(0.0));
    for (const RoomScan& s : scans) {
        maps.newest().push(s.scan);
        maps.keep_unsettled(s.scan);
    }
    std::vector<std::size_t> settled;
    while (const auto verdict = maps.settle_oldest(2)) settled.push_back(verdict->index);
    EXPECT_EQ(settled, (std::vector<std::size_t>{0, 1, 2, 3}));
    EXPECT_EQ(maps.settle_oldest(0)->index, 4U);
    EXPECT_EQ(maps.settle_oldest(0)->index, 5U);
    EXPECT_FALSE(maps.settle_oldest(0));
}

TEST(MapSegments, PlacesNameVoxelsOfTheirOwnMap) {
    const auto scans = drive(8, true);
    MapSegments maps(every_scan(), with_horizon(0.0));
    fill(maps, scans, {4});
    maps.finish();
    for (const std::size_t i : {2U, 6U}) {
        const auto places = maps.places_of(scans[i].scan);
        const Verdict verdict = maps.verdict(scans[i].scan);
        const auto histories = maps.histories(places);
        ASSERT_EQ(histories.size(), places.size());
        for (std::size_t p = 0; p < places.size(); ++p) {
            ASSERT_EQ(places[p] >> 32, i < 4 ? 0U : 1U);
            EXPECT_EQ(histories[p].probability.value_or(0.0F), verdict.probability[p]);
            EXPECT_EQ(histories[p].first / 4, i / 4);
        }
    }
}

}  // namespace map_segments_test
}  // namespace dynamic_filter
