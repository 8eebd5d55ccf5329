// SPDX-License-Identifier: MIT
#include "online/maps.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>

#include "dynamic_filter/error.hpp"
#include "dynamic_filter/parallel.hpp"
#include "support/outcome.hpp"

namespace dynamic_filter {
namespace maps_test {

using test::drive;
using test::expect_same;
using test::Outcome;
using test::RoomScan;
using test::run;
using test::share;
using test::small_windows;

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

Maps::Judged push(Maps& maps, const Scan& scan, bool restarts = false) {
    Maps::Judged judged = maps.judge(scan, restarts ? Maps::Follows::restarts : Maps::Follows::on);
    for (Verdict& verdict : maps.catch_up()) judged.settled.push_back(std::move(verdict));
    return judged;
}

/// Pushes scans, a new map before each of `breaks`.
void fill(Maps& maps, const std::vector<RoomScan>& scans, const std::vector<std::size_t>& breaks) {
    for (const RoomScan& s : scans) {
        push(maps, s.scan, std::find(breaks.begin(), breaks.end(), s.scan.index) != breaks.end());
    }
}

TEST(Maps, AScanIsJudgedByTheMapItWentTo) {
    const auto scans = drive(12, true);
    Maps maps(every_scan(), with_horizon(0.0));
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

TEST(Maps, WithAHorizonTheMapBeforeABreakIsForgotten) {
    const auto scans = drive(12, true);
    Maps maps(every_scan(), with_horizon(200.0));
    fill(maps, scans, {6});
    maps.finish();
    EXPECT_EQ(maps.size(), 1U);
    EXPECT_TRUE(test::all_are({maps.verdict(scans[3].scan)}, Label::unknown));
    EXPECT_FALSE(test::all_are({maps.verdict(scans[8].scan)}, Label::unknown));
}

TEST(Maps, ABreakReturnsTheVerdictsOfAWindowThatIsNotFull) {
    const auto scans = drive(6, true);
    for (const double horizon : {0.0, 200.0}) {
        Maps maps(small_windows(), with_horizon(horizon));
        fill(maps, {scans.begin(), scans.begin() + 5}, {});
        const Maps::Judged judged = push(maps, scans[5].scan, true);
        EXPECT_EQ(judged.instant.size(), 5U);
        ASSERT_TRUE(judged.notice);
        EXPECT_EQ(judged.notice->kind, NoticeKind::restart);
        EXPECT_EQ(judged.notice->index, 5U);
    }
}

TEST(Maps, AJumpOfThePoseBeginsANewMap) {
    auto scans = drive(8, true);
    for (std::size_t i = 4; i < 8; ++i) scans[i].scan.T_world_sensor.translation().x() += 500.0;
    Maps maps(every_scan(), with_horizon(0.0));
    for (const RoomScan& s : scans) {
        const Maps::Judged judged = push(maps, s.scan);
        EXPECT_EQ(judged.notice.has_value(), s.scan.index == 4) << s.scan.index;
        ASSERT_EQ(judged.instant.size(), 1U);
    }
    EXPECT_EQ(maps.size(), 2U);
}

TEST(Maps, TheMapIsCutAsTheSensorGoesOn) {
    const auto scans = drive(40, false);  // through a hall of 15 m by 10 m
    Maps whole(every_scan(), with_horizon(0.0)), cut(every_scan(), with_horizon(4.0));
    fill(whole, scans, {});
    fill(cut, scans, {});
    EXPECT_LT(cut.contents().voxels, whole.contents().voxels);
    EXPECT_GT(cut.contents().voxels, 100U);
}

TEST(Maps, ScansAreSettledInOrderAndOnce) {
    const auto scans = drive(6, false);
    OnlineOptions options = with_horizon(0.0);
    options.settle_after = 2;
    Maps maps(every_scan(), options);
    std::vector<std::size_t> settled;
    for (const RoomScan& s : scans) {
        for (const Verdict& verdict : push(maps, s.scan).settled) settled.push_back(verdict.index);
    }
    EXPECT_EQ(settled, (std::vector<std::size_t>{0, 1, 2, 3}));
    for (const Verdict& verdict : maps.finish().settled) settled.push_back(verdict.index);
    EXPECT_EQ(settled, (std::vector<std::size_t>{0, 1, 2, 3, 4, 5}));
}

TEST(Maps, PlacesNameVoxelsOfTheirOwnMap) {
    const auto scans = drive(8, true);
    Maps maps(every_scan(), with_horizon(0.0));
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

class StaticLocalMap : public testing::TestWithParam<Config> {};

TEST_P(StaticLocalMap, HoldsTheVoxelsAroundAnyPose) {
    const Eigen::Vector3d far_away(4e5, -2e5, 128.0);
    auto scans = drive(6, false, far_away);
    Maps filter(GetParam(), with_horizon(0.0));
    EXPECT_TRUE(filter.local_static_map(Pose::Identity(), {}).empty());
    for (auto& s : scans) push(filter, s.scan);
    filter.finish();
    Pose query = scans[0].scan.T_world_sensor;
    const auto voxels = filter.local_static_map(query, {});
    ASSERT_FALSE(voxels.empty());
    for (const StaticVoxel& v : voxels) {
        EXPECT_GT(v.probability, 0.0F);
        EXPECT_LE(v.probability, 1.0F);
        const auto is_near = [&](const Point& p) {
            return (scans[0].scan.T_world_sensor * p.cast<double>() - v.center).norm() < 1.0;
        };
        const Points& points = scans[0].scan.points;
        EXPECT_TRUE(std::any_of(points.begin(), points.end(), is_near)) << v.center.transpose();
    }
    query.translation().x() += 1e4;
    EXPECT_TRUE(filter.local_static_map(query, {}).empty());
    EXPECT_EQ(filter.local_static_map(query, 1e6).empty(), !filter.judges_each_scan());
}

TEST(Maps, NothingIsSettledWhereScansDoNotObserve) {
    Config no_back_end = small_windows();
    no_back_end.back_end.enabled = false;
    for (const Config& config : {small_windows(), no_back_end}) {
        Maps filter(config, with_horizon(0.0));
        auto scans = drive(6, false);
        for (auto& s : scans) push(filter, s.scan);
        const Labels labels = filter.settled(scans[0].scan).labels;
        EXPECT_EQ(labels, Labels(scans[0].scan.points.size(), Label::unknown));
    }
}

TEST_P(StaticLocalMap, MergedHoldsTheStaticPointsOfAllScans) {
    auto scans = drive(6, true);
    Maps filter(GetParam(), with_horizon(0.0));
    EXPECT_TRUE(filter.static_map().empty());
    for (auto& s : scans) push(filter, s.scan);
    filter.finish();
    const auto map = filter.static_map();
    ASSERT_FALSE(map.empty());
    const auto cell = [&](const Eigen::Vector3d& at) {
        const Eigen::Vector3d steps = (at - map[0].center) / GetParam().map.voxel_size;
        return std::array{std::lround(steps.x()), std::lround(steps.y()), std::lround(steps.z())};
    };
    std::set<std::array<long, 3>> cells;
    for (const StaticVoxel& v : map) cells.insert(cell(v.center));
    EXPECT_EQ(cells.size(), map.size());
    std::size_t still = 0, held = 0;
    for (auto& s : scans) {
        const Labels labels = filter.verdict(s.scan).labels;
        for (std::size_t i = 0; i < labels.size(); ++i) {
            if (labels[i] != Label::static_) continue;
            ++still;
            held += cells.count(cell(s.scan.T_world_sensor * s.scan.points[i].cast<double>()));
        }
    }
    EXPECT_GT(still, 10000U);
    EXPECT_GT(held, still - still / 200);  // contacts, and points on a voxel's face
}

INSTANTIATE_TEST_SUITE_P(Observers, StaticLocalMap, testing::Values(small_windows(), Config{}),
                         [](const auto& test) { return test.index == 0 ? "submaps" : "scans"; });

std::vector<RoomScan> without_poses(std::size_t count) {
    auto scans = drive(count, true);
    for (RoomScan& s : scans) {
        s.scan.has_pose = false;
        s.scan.T_world_sensor.translation().setConstant(std::nan(""));
    }
    return scans;
}

TEST(Maps, ScansWithoutPosesAreToldWhereTheyWereTaken) {
    const auto truth = drive(20, true), scans = without_poses(20);
    const Pose first = truth[0].scan.T_world_sensor;
    for (const Config& config : {Config{}, small_windows()}) {
        const Outcome result = run(scans, config);
        ASSERT_EQ(result.instant.size(), scans.size());
        for (const Verdict& v : result.instant) {
            ASSERT_TRUE(v.tracked) << v.index;
            const Pose expected = first.inverse() * truth[v.index].scan.T_world_sensor;
            const Pose off = expected.inverse() * v.tracked->T_world_sensor;
            EXPECT_LT(off.translation().norm(), 0.03) << v.index;
        }
    }
    for (const Verdict& v : run(truth, Config{}).instant) EXPECT_FALSE(v.tracked);
}

TEST(Maps, WithoutPosesVerdictsAreThoseOfTheTrackedPoses) {
    auto scans = without_poses(20);
    Maps filter(Config{}, with_horizon(0.0));
    std::vector<Verdict> instant;
    for (const RoomScan& s : scans) {
        for (Verdict& v : push(filter, s.scan).instant) instant.push_back(std::move(v));
    }
    filter.finish();
    EXPECT_EQ(filter.times().at("odometry").count(), 2 * scans.size());
    for (std::size_t i = 0; i < scans.size(); ++i) {
        scans[i].scan.T_world_sensor = instant[i].tracked->T_world_sensor;
        scans[i].scan.has_pose = true;
    }
    const Outcome again = run(scans, Config{});
    std::vector<Verdict> final;
    for (const RoomScan& s : scans) final.push_back(filter.verdict(s.scan));
    expect_same(instant, again.instant);
    expect_same(final, again.final);
    EXPECT_GT(share(scans, final, Label::dynamic, Label::dynamic), 0.8);
    EXPECT_GT(share(scans, final, Label::static_, Label::static_), 0.9);
}

TEST(Maps, WithoutPosesAnyNumberOfThreadsGivesTheSameBits) {
    const auto scans = without_poses(12);
    Outcome one, four;
    with_threads(1, [&] { one = run(scans, Config{}); });
    with_threads(4, [&] { four = run(scans, Config{}); });
    expect_same(one.instant, four.instant);
    for (std::size_t i = 0; i < scans.size(); ++i) {
        EXPECT_EQ(one.instant[i].tracked->T_world_sensor.matrix(),
                  four.instant[i].tracked->T_world_sensor.matrix());
    }
}

TEST(Maps, PosesForSomeScansOnlyAreAnErrorThatNamesTheScan) {
    auto scans = drive(4, false);
    scans[2].scan.has_pose = false;
    Maps filter(Config{}, with_horizon(0.0));
    push(filter, scans[0].scan);
    push(filter, scans[1].scan);
    try {
        push(filter, scans[2].scan);
        ADD_FAILURE() << "nothing was thrown";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("scan 2 has no pose"), std::string::npos);
    }
}

TEST(Maps, RefinedPosesAreTold) {
    const auto scans = drive(8, true);
    Config config;
    config.odometry.refine = true;
    const Outcome result = run(scans, config);
    for (const Verdict& v : result.instant) {
        ASSERT_TRUE(v.tracked);
        const Pose off = scans[v.index].scan.T_world_sensor.inverse() * v.tracked->T_world_sensor;
        EXPECT_LT(off.translation().norm(), 0.01);
    }
}

TEST(Maps, TimesThatAreNotOnePerPointAreAnError) {
    auto scans = without_poses(1);
    scans[0].scan.times.assign(3, 0.0F);
    Maps filter(Config{}, with_horizon(0.0));
    EXPECT_THROW(push(filter, scans[0].scan), Error);
}

}  // namespace maps_test
}  // namespace dynamic_filter
