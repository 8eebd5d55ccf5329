// SPDX-License-Identifier: MIT
#include "dynamic_filter/filter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include "dynamic_filter/error.hpp"
#include "dynamic_filter/parallel.hpp"
#include "geometry/pose.hpp"
#include "paper/front_end.hpp"
#include "paper/submap.hpp"
#include "paper/window.hpp"
#include "support/outcome.hpp"

namespace dynamic_filter {
namespace dynamic_filter_test {

using test::all_are;
using test::drive;
using test::expect_same;
using test::Outcome;
using test::RoomScan;
using test::run;
using test::share;
using test::small_windows;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

TEST(DynamicFilter, WallsAreStillAndTheWalkerIsDynamic) {
    const auto scans = drive(24, true);
    const Outcome result = run(scans, small_windows());
    EXPECT_EQ(result.submaps, 3U);
    EXPECT_GT(share(scans, result.final, Label::static_, Label::static_), 0.9);
    EXPECT_GT(share(scans, result.final, Label::dynamic, Label::dynamic), 0.9);
    EXPECT_GT(share(scans, result.instant, Label::static_, Label::static_), 0.9);
    EXPECT_GT(share(scans, result.instant, Label::dynamic, Label::dynamic), 0.8);
}

TEST(DynamicFilter, AnEmptyRoomSeenFromOnePlaceIsAllStill) {
    auto scans = drive(1, false);
    for (std::size_t i = 1; i < 20; ++i) {
        scans.push_back(scans[0]);
        scans[i].scan.index = i;
        scans[i].scan.stamp = 0.5 * static_cast<double>(i);
    }
    const Outcome result = run(scans, small_windows());
    EXPECT_EQ(result.submaps, 3U);
    EXPECT_TRUE(all_are(result.final, Label::static_));
    EXPECT_TRUE(all_are(result.instant, Label::static_));
}

TEST(DynamicFilter, AnEmptyRoomIsStillAllButAFewPoints) {
    const auto scans = drive(20, false);
    EXPECT_GT(share(scans, run(scans, small_windows()).final, Label::static_, Label::static_), 0.9);
}

TEST(DynamicFilter, EveryScanGetsOneVerdictOfItsSizeInOrder) {
    auto scans = drive(10, true);
    scans[3].scan.points.clear();
    scans[5].scan.points.resize(7);
    const Outcome result = run(scans, small_windows());
    ASSERT_EQ(result.instant.size(), scans.size());
    for (std::size_t s = 0; s < scans.size(); ++s) {
        const std::size_t size = scans[s].scan.points.size();
        EXPECT_EQ(result.instant[s].index, s);
        EXPECT_EQ(result.instant[s].labels.size(), size);
        EXPECT_TRUE(result.instant[s].probability.empty());
        EXPECT_EQ(result.final[s].index, s);
        EXPECT_EQ(result.final[s].labels.size(), size);
        EXPECT_EQ(result.final[s].probability.size(), size);
        for (const float p : result.final[s].probability) EXPECT_TRUE(p >= 0.0F && p <= 1.0F);
    }
}

TEST(DynamicFilter, InstantVerdictsComeWhenAWindowCloses) {
    const auto scans = drive(10, false);
    DynamicFilter filter(small_windows());
    for (std::size_t s = 0; s < 10; ++s) {
        EXPECT_EQ(filter.push(scans[s].scan).size(), s == 8 ? 8U : 0U) << s;
    }
    EXPECT_EQ(filter.finish().size(), 2U);
}

TEST(DynamicFilter, WhatWasNotMeasuredIsUnknown) {
    auto scans = drive(10, true);
    const float inf = std::numeric_limits<float>::infinity();
    for (RoomScan& s : scans) {
        s.scan.points[0] = {kNan, 1, 1};
        s.scan.points[1] = Point::Zero();
        s.scan.points[2] = {1, -inf, 1};
        s.scan.points[3] = {1e9F, 0, 0};  // beyond the voxels' reach
    }
    const Outcome result = run(scans, small_windows());
    for (const Verdict& v : result.final) {
        for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(v.labels[i], Label::unknown) << i;
        for (std::size_t i = 4; i < v.labels.size(); ++i) ASSERT_NE(v.labels[i], Label::unknown);
    }
    for (const Verdict& v : result.instant) {
        for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(v.labels[i], Label::unknown) << i;
    }
}

TEST(DynamicFilter, AnyNumberOfThreadsGivesTheSameBits) {
    const auto scans = drive(16, true);
    Outcome one, two, all;
    with_threads(1, [&] { one = run(scans, small_windows()); });
    with_threads(2, [&] { two = run(scans, small_windows()); });
    with_threads(0, [&] { all = run(scans, small_windows()); });
    expect_same(one.final, two.final);
    expect_same(one.instant, two.instant);
    expect_same(one.final, all.final);
}

TEST(DynamicFilter, FarOriginsGiveTheSameVerdicts) {
    const auto near = drive(16, true);
    auto far = near;
    for (RoomScan& s : far)
        s.scan.T_world_sensor.translation() += Eigen::Vector3d(5e5, 5e6, -200.0);
    const Outcome a = run(near, small_windows()), b = run(far, small_windows());
    expect_same(a.final, b.final);
    expect_same(a.instant, b.instant);
}

TEST(DynamicFilter, ASingleScanIsReturnedAsItIs) {
    const auto scans = drive(1, true);
    const Outcome result = run(scans, small_windows());
    EXPECT_TRUE(all_are(result.final, Label::static_));
    EXPECT_TRUE(all_are(result.instant, Label::static_));
    EXPECT_EQ(result.submaps, 1U);
}

TEST(DynamicFilter, WithoutScansThereAreNoVerdicts) {
    DynamicFilter filter(small_windows());
    EXPECT_TRUE(filter.finish().empty());
}

TEST(DynamicFilter, ScansWithoutPointsAreFine) {
    std::vector<RoomScan> scans(20);
    for (std::size_t i = 0; i < scans.size(); ++i) scans[i].scan.stamp = static_cast<double>(i);
    EXPECT_EQ(run(scans, small_windows()).final.size(), 20U);
}

TEST(DynamicFilter, FrontEndOnlyIsTheUnionOfTheStaticSubmaps) {
    Config config = small_windows();
    config.back_end.enabled = false;
    const auto scans = drive(20, true);
    DynamicFilter filter(config);
    WindowCutter cutter(config.keyframe, config.submap.keyframes);
    FrontEnd front_end(config);
    StageTimes times;
    const auto size = static_cast<float>(config.map.voxel_size);
    std::set<VoxelKey> owned;
    const auto own = [&](const std::optional<Window>& window) {
        if (!window) return;
        const Submap submap = front_end.process(*window, times).submap;
        for (const Point& p : submap.points) owned.insert(*voxel_of(p, size));
    };
    for (const RoomScan& s : scans) {
        filter.push(s.scan);
        own(cutter.push(s.scan));
    }
    filter.finish();
    own(cutter.flush());
    for (const RoomScan& s : scans) {  // the map frame is the world here
        Points points;
        to_map(s.scan, points);
        const Verdict verdict = filter.verdict(s.scan);
        for (std::size_t i = 0; i < points.size(); ++i) {
            const bool in_union = owned.count(*voxel_of(points[i], size)) > 0;
            ASSERT_EQ(verdict.labels[i], in_union ? Label::static_ : Label::dynamic);
            ASSERT_EQ(verdict.probability[i], in_union ? 1.0F : 0.0F);
        }
    }
}

TEST(DynamicFilter, BackEndOnlyLeavesInstantVerdictsStillAndStillFindsTheWalker) {
    Config config = small_windows();
    config.front_end.enabled = false;
    const auto scans = drive(40, true);
    const Outcome result = run(scans, config);
    EXPECT_TRUE(all_are(result.instant, Label::static_));
    EXPECT_GT(share(scans, result.final, Label::dynamic, Label::dynamic), 0.5);
    EXPECT_GT(share(scans, result.final, Label::static_, Label::static_), 0.8);
}

TEST(DynamicFilter, MoreChecksNeverRaiseAProbability) {
    const auto scans = drive(24, true);
    Config blind = small_windows(), uncorrected = small_windows();
    blind.back_end.visibility_check = false;
    uncorrected.back_end.incident_correction = false;
    const Outcome full = run(scans, small_windows()), a = run(scans, blind),
                  b = run(scans, uncorrected);
    std::size_t lower = 0;
    for (std::size_t s = 0; s < scans.size(); ++s) {
        for (std::size_t i = 0; i < full.final[s].labels.size(); ++i) {
            ASSERT_LE(a.final[s].probability[i], full.final[s].probability[i]);
            ASSERT_LE(b.final[s].probability[i], full.final[s].probability[i]);
            ASSERT_LE(a.final[s].probability[i], b.final[s].probability[i]);
            lower += a.final[s].probability[i] < full.final[s].probability[i] ? 1 : 0;
        }
    }
    EXPECT_GT(lower, 0U);
    expect_same(full.instant, a.instant);
    expect_same(full.instant, b.instant);
}

TEST(DynamicFilter, TheThresholdIsInclusive) {
    const auto scans = drive(24, true);
    Config config = small_windows();
    for (const double threshold : {0.0, 0.5, 1.0}) {
        config.map.occupancy_threshold = threshold;
        const Outcome result = run(scans, config);
        for (const Verdict& v : result.final) {
            for (std::size_t i = 0; i < v.labels.size(); ++i) {
                const bool still = v.probability[i] >= static_cast<float>(threshold);
                if (v.probability[i] == 0.0F) continue;  // no submap holds it
                ASSERT_EQ(v.labels[i], still ? Label::static_ : Label::dynamic);
            }
        }
    }
}

TEST(DynamicFilter, RemovertTakesTheWholeSequenceAsOneWindow) {
    Config config;
    config.method = Method::removert;
    config.keyframe = small_windows().keyframe;
    const auto scans = drive(20, true);
    const Outcome result = run(scans, config);
    EXPECT_EQ(result.submaps, 1U);
    EXPECT_EQ(result.instant.size(), scans.size());
    EXPECT_GT(share(scans, result.final, Label::static_, Label::static_), 0.8);
    EXPECT_GT(share(scans, result.final, Label::dynamic, Label::dynamic), 0.3);
}

TEST(DynamicFilter, EveryRevertingKeepsAtLeastWhatNoneKeeps) {
    const auto scans = drive(16, true);
    Config config = small_windows();
    config.front_end.reverting = Reverting::none;
    const Outcome none = run(scans, config);
    for (const auto reverting : {Reverting::map, Reverting::visibility}) {
        config.front_end.reverting = reverting;
        const Outcome other = run(scans, config);
        for (std::size_t s = 0; s < scans.size(); ++s) {
            for (std::size_t i = 0; i < none.instant[s].labels.size(); ++i) {
                if (none.instant[s].labels[i] != Label::static_) continue;
                ASSERT_EQ(other.instant[s].labels[i], Label::static_);
            }
        }
    }
}

TEST(DynamicFilter, RejectsAConfigOutOfBounds) {
    Config config;
    config.map.voxel_size = -1.0;
    EXPECT_THROW(DynamicFilter{config}, ConfigError);
}

TEST(DynamicFilter, NotesTheTimesOfItsStages) {
    DynamicFilter filter(small_windows());
    for (const RoomScan& s : drive(10, true)) filter.push(s.scan);
    filter.finish();
    EXPECT_EQ(filter.times().at("front_end").count(), 2U);
    EXPECT_TRUE(filter.times().count("merging"));
    for (const auto& [stage, calls] : filter.times()) {
        EXPECT_GE(calls.quantile(0.0), 0.0) << stage;
        EXPECT_LE(calls.max(), calls.total()) << stage;
    }
}

// More submaps at exactly the same pose than max_submaps: each is still consulted about its own
// voxels.
TEST(DynamicFilter, ASensorThatStandsStillForLongKeepsTheWallsItSawLast) {
    auto scans = drive(1, false);
    scans.push_back(scans[0]);
    for (Point& p : scans[1].scan.points) p *= 0.5F;  // other walls from now on
    Config config = small_windows();
    config.submap.keyframes = 1;
    config.back_end.max_submaps = 1;
    scans[1].scan.stamp = 1.0;
    scans[1].scan.index = 1;
    const Outcome result = run(scans, config);
    for (const float p : result.final[1].probability) ASSERT_GE(p, 0.0F);
    EXPECT_TRUE(all_are(std::vector{result.final[1]}, Label::static_));
}

class StaticLocalMap : public testing::TestWithParam<Config> {};

TEST_P(StaticLocalMap, HoldsTheVoxelsAroundAnyPose) {
    const Eigen::Vector3d far_away(4e5, -2e5, 128.0);
    auto scans = drive(6, false, far_away);
    DynamicFilter filter(GetParam());
    EXPECT_TRUE(filter.local_static_map(Pose::Identity()).empty());
    for (auto& s : scans) filter.push(s.scan);
    filter.finish();
    Pose query = scans[0].scan.T_world_sensor;
    const auto voxels = filter.local_static_map(query);
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
    EXPECT_TRUE(filter.local_static_map(query).empty());
    EXPECT_EQ(filter.local_static_map(query, 1e6).empty(), !filter.judges_each_scan());
}

TEST(DynamicFilter, NothingIsPushedAfterTheEnd) {
    for (const Config& config : {small_windows(), Config{}}) {
        DynamicFilter filter(config);
        const auto scans = drive(2, false);
        filter.push(scans[0].scan);
        filter.finish();
        EXPECT_TRUE(filter.finish().empty());
        EXPECT_THROW(filter.push(scans[1].scan), Error);
    }
}

TEST(DynamicFilter, NothingIsSettledWhereScansDoNotObserve) {
    Config no_back_end = small_windows();
    no_back_end.back_end.enabled = false;
    for (const Config& config : {small_windows(), no_back_end}) {
        DynamicFilter filter(config);
        auto scans = drive(6, false);
        for (auto& s : scans) filter.push(s.scan);
        const Labels labels = filter.settled(scans[0].scan).labels;
        EXPECT_EQ(labels, Labels(scans[0].scan.points.size(), Label::unknown));
    }
}

TEST_P(StaticLocalMap, MergedHoldsTheStaticPointsOfAllScans) {
    auto scans = drive(6, true);
    DynamicFilter filter(GetParam());
    EXPECT_TRUE(filter.static_map().empty());
    for (auto& s : scans) filter.push(s.scan);
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

// Scans observe (the default preset).

TEST(ScansObserve, WallsAreStillAndTheWalkerIsDynamic) {
    const auto scans = drive(24, true);
    const Outcome result = run(scans, Config{});
    EXPECT_GT(share(scans, result.final, Label::static_, Label::static_), 0.99);
    EXPECT_GT(share(scans, result.final, Label::dynamic, Label::dynamic), 0.9);
    ASSERT_EQ(result.instant.size(), scans.size());
    EXPECT_GT(share(scans, result.instant, Label::dynamic, Label::dynamic), 0.7);
    EXPECT_LT(share(scans, result.instant, Label::static_, Label::dynamic), 0.01);
}

TEST(ScansObserve, NothingMovesInAnEmptyRoom) {
    const auto scans = drive(20, false);
    EXPECT_LT(share(scans, run(scans, Config{}).final, Label::static_, Label::dynamic), 0.001);
}

TEST(ScansObserve, TheFirstScanIsUnknownAtOnceAndKnownInTheEnd) {
    const auto scans = drive(12, false);
    const Outcome result = run(scans, Config{});
    EXPECT_TRUE(all_are(std::vector{result.instant[0]}, Label::unknown));
    EXPECT_GT(share({scans[0]}, {result.final[0]}, Label::static_, Label::static_), 0.99);
}

TEST(ScansObserve, GivesTheSameBitsForAnyNumberOfThreads) {
    const auto scans = drive(12, true);
    Outcome one, four;
    with_threads(1, [&] { one = run(scans, Config{}); });
    with_threads(4, [&] { four = run(scans, Config{}); });
    expect_same(one.instant, four.instant);
    expect_same(one.final, four.final);
}

TEST(ScansObserve, TheWorldsOriginDoesNotMatter) {
    const auto near = drive(10, true), far = drive(10, true, {65536.0, -131072.0, 0.0});
    const Outcome a = run(near, Config{}), b = run(far, Config{});
    for (std::size_t s = 0; s < near.size(); ++s) EXPECT_EQ(a.final[s].labels, b.final[s].labels);
}

TEST(ScansObserve, PointsThatAreNoMeasurementsAndUnseenScansAreUnknown) {
    auto scans = drive(6, false);
    scans[2].scan.points[5] = {kNan, 1.0F, 1.0F};
    scans[2].scan.points[6] = Point::Zero();
    scans[3].scan.points.clear();
    scans[4].scan.points.assign(3, Point::Zero());
    const Outcome result = run(scans, Config{});
    EXPECT_EQ(result.final[2].labels[5], Label::unknown);
    EXPECT_EQ(result.final[2].labels[6], Label::unknown);
    EXPECT_TRUE(result.final[3].labels.empty());
    EXPECT_TRUE(all_are(std::vector{result.final[4], result.instant[4]}, Label::unknown));
    DynamicFilter never_fed{Config{}};
    never_fed.finish();
    EXPECT_EQ(never_fed.contents().voxels, 0U);
}

/// A person crosses the room for 10 scans and stands for 30; another crosses at the end.
std::vector<RoomScan> one_comes_and_stays() {
    const test::Box room{{-6.03, -5.03, 0.02}, {9.03, 5.03, 3.1}};
    const auto person = [](double x, double y) {
        const Eigen::Vector3d half(0.25, 0.25, 0.0), feet(x, y, 0.02);
        return test::Box{feet - half, feet + half + Eigen::Vector3d(0.0, 0.0, 1.7)};
    };
    std::vector<RoomScan> scans;
    for (std::size_t i = 0; i < 40; ++i) {
        const auto t = static_cast<double>(i);
        std::vector<test::Box> people{person(5.5, std::min(0.4 * t - 4.5, -0.5))};
        if (i > 30) people.push_back(person(-3.5, 0.4 * (t - 35.0)));
        Pose pose = Pose::Identity();
        pose.translation() = Eigen::Vector3d(t / 64.0, 0.25, 1.25);
        scans.push_back(test::scan_room(pose, room, people));
        scans.back().scan.stamp = 0.5 * t;
        scans.back().scan.index = i;
    }
    return scans;
}

TEST(ScansObserve, TheLatestMapHoldsWhatCameAndStayed) {
    const auto scans = one_comes_and_stays();
    Config latest;
    latest.map.time = MapTime::latest;
    const Outcome always = run(scans, Config{}), now = run(scans, latest);
    int stood = 0, stayed = 0;
    for (std::size_t s = 0; s < scans.size(); ++s) {
        EXPECT_EQ(now.final[s].labels, always.final[s].labels);  // what moved has moved
        EXPECT_TRUE(always.final[s].stays.empty());
        for (std::size_t i = 0; i < scans[s].truth.size(); ++i) {
            if (scans[s].truth[i] != Label::dynamic) continue;
            const bool stays = now.final[s].stays[i];
            EXPECT_TRUE(!stays || now.final[s].labels[i] == Label::dynamic);
            EXPECT_FALSE(stays && (s < 9 || scans[s].scan.points[i].x() < 0.0F)) << s;
            if (s < 20 || now.final[s].labels[i] != Label::dynamic) continue;
            if (scans[s].scan.points[i].x() < 0.0F) continue;
            ++stood;
            stayed += stays ? 1 : 0;
        }
    }
    EXPECT_GT(stood, 400);
    EXPECT_GT(stayed, 0.8 * stood);
    const auto voxels_near = [&](const Config& config) {
        DynamicFilter filter(config);
        for (const RoomScan& s : scans) filter.push(s.scan);
        filter.finish();
        const auto map = filter.static_map();
        return std::count_if(map.begin(), map.end(), [](const StaticVoxel& v) {
            return (v.center - Eigen::Vector3d(5.5, -0.5, 1.0)).norm() < 0.6;
        });
    };
    EXPECT_EQ(voxels_near(Config{}), 0);
    EXPECT_GT(voxels_near(latest), 10);
}

TEST(ScansObserve, AFootOnTheGroundIsDynamicAndTheGroundIsNot) {
    const auto scans = drive(24, true);
    const Outcome result = run(scans, Config{});
    int low = 0, found = 0, ground = 0, kept = 0;
    for (std::size_t s = 0; s < scans.size(); ++s) {
        const auto& [scan, truth] = std::tie(scans[s].scan, scans[s].truth);
        Points feet;
        for (std::size_t i = 0; i < truth.size(); ++i) {
            const Point at = (scan.T_world_sensor * scan.points[i].cast<double>()).cast<float>();
            if (truth[i] != Label::dynamic || at.z() < 0.12F || at.z() > 0.2F) continue;
            feet.push_back(at);
            ++low;
            found += result.final[s].labels[i] == Label::dynamic ? 1 : 0;
        }
        for (std::size_t i = 0; i < truth.size(); ++i) {
            const Point at = (scan.T_world_sensor * scan.points[i].cast<double>()).cast<float>();
            const bool beside_a_foot =
                truth[i] == Label::static_ && at.z() < 0.05F &&
                std::any_of(feet.begin(), feet.end(),
                            [&](const Point& foot) { return (foot - at).head<2>().norm() < 1.0F; });
            if (!beside_a_foot) continue;
            ++ground;
            kept += result.final[s].labels[i] == Label::static_ ? 1 : 0;
        }
    }
    ASSERT_GT(low, 10);
    ASSERT_GT(ground, 10);
    EXPECT_GE(found, 0.4 * low);
    EXPECT_EQ(kept, ground);
}

std::vector<RoomScan> without_poses(std::size_t count) {
    auto scans = drive(count, true);
    for (RoomScan& s : scans) {
        s.scan.has_pose = false;
        s.scan.T_world_sensor.translation().setConstant(std::nan(""));
    }
    return scans;
}

TEST(DynamicFilter, ScansWithoutPosesAreToldWhereTheyWereTaken) {
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

TEST(DynamicFilter, WithoutPosesVerdictsAreThoseOfTheTrackedPoses) {
    auto scans = without_poses(20);
    DynamicFilter filter{Config{}};
    std::vector<Verdict> instant;
    for (const RoomScan& s : scans) {
        for (Verdict& v : filter.push(s.scan)) instant.push_back(std::move(v));
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

TEST(DynamicFilter, WithoutPosesAnyNumberOfThreadsGivesTheSameBits) {
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

TEST(DynamicFilter, PosesForSomeScansOnlyAreAnErrorThatNamesTheScan) {
    auto scans = drive(4, false);
    scans[2].scan.has_pose = false;
    DynamicFilter filter{Config{}};
    filter.push(scans[0].scan);
    filter.push(scans[1].scan);
    try {
        filter.push(scans[2].scan);
        ADD_FAILURE() << "nothing was thrown";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("scan 2 has no pose"), std::string::npos);
    }
}

TEST(DynamicFilter, RefinedPosesAreTold) {
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

TEST(DynamicFilter, TimesThatAreNotOnePerPointAreAnError) {
    auto scans = without_poses(1);
    scans[0].scan.times.assign(3, 0.0F);
    EXPECT_THROW(DynamicFilter{Config{}}.push(scans[0].scan), Error);
}

/// Final verdicts of a filter that is limited to a part of the world.
std::vector<Verdict> run_region(const std::vector<RoomScan>& scans, const Region& region) {
    DynamicFilter filter(preset("default"), region);
    for (const RoomScan& s : scans) filter.push(s.scan);
    filter.finish();
    std::vector<Verdict> verdicts;
    for (const RoomScan& s : scans) verdicts.push_back(filter.verdict(s.scan));
    return verdicts;
}

// Votes reach two voxels far, and nothing else crosses the border of a region here: the tracks of
// objects lie inside.
TEST(DynamicFilter, InsideOfARegionTheVerdictsAreThoseOfTheWhole) {
    const auto scans = drive(24, true);
    const Outcome whole = run(scans, preset("default"));
    const Eigen::Vector3d origin = nearby_origin(scans.front().scan.T_world_sensor, 0.2);
    const double halo = 1.6;  // [m]
    const Eigen::AlignedBox2d inside(Eigen::Vector2d(-60.0, -40.0), Eigen::Vector2d(1.6, 40.0));
    const Region region{.origin = origin,
                        .bounds = {inside.min() - Eigen::Vector2d::Constant(halo),
                                   inside.max() + Eigen::Vector2d::Constant(halo)}};
    const auto part = run_region(scans, region);
    std::size_t within = 0, without = 0, other = 0;
    for (std::size_t s = 0; s < scans.size(); ++s) {
        for (std::size_t i = 0; i < scans[s].truth.size(); ++i) {
            const Eigen::Vector3d world =
                scans[s].scan.T_world_sensor * scans[s].scan.points[i].cast<double>();
            const Eigen::Vector2d at = (world - origin).head<2>();
            if (!region.bounds.contains(at)) {
                without += part[s].labels[i] == Label::unknown ? 0 : 1;
            } else if (inside.contains(at)) {
                ++within;
                other += part[s].labels[i] == whole.final[s].labels[i] ? 0 : 1;
            }
        }
    }
    EXPECT_EQ(without, 0U);
    EXPECT_GT(within, 1000U);
    EXPECT_LE(other, within / 1000);
}

TEST(DynamicFilter, OnlyTheMethodScansFiltersARegion) {
    EXPECT_THROW(DynamicFilter(small_windows(), Region{}), ConfigError);
}

/// Scans of an empty room and of one with a box that stands there all the time.
std::vector<RoomScan> standing(bool box, std::size_t first) {
    const test::Box room{{-20.0, -6.0, 0.0}, {20.0, 6.0, 3.0}}, parked{{3, 2, 0.2}, {5, 3.4, 1.6}};
    std::vector<RoomScan> scans;
    for (std::size_t i = 0; i < 24; ++i) {
        Pose pose = Pose::Identity();
        pose.translation() = Eigen::Vector3d(-6.0 + 0.5 * static_cast<double>(i), 0.25, 1.0);
        auto scan =
            test::scan_room(pose, room, box ? std::vector{parked} : std::vector<test::Box>{},
                            {.rings = 32, .columns = 720});
        scan.scan.stamp = 0.25 * static_cast<double>(i);
        scan.scan.index = first + i;
        scans.push_back(std::move(scan));
    }
    return scans;
}

// A box that stands still in one drive, and is not there in the other one, comes or goes.
TEST(DynamicFilter, WhatOnlyOneDriveSawIsDynamic) {
    for (const bool comes : {false, true}) {
        const auto first = standing(!comes, 0), second = standing(comes, 24);
        DynamicFilter filter(preset("default"));
        for (const RoomScan& s : first) filter.push(s.scan);
        filter.begin_drive();
        for (const RoomScan& s : second) filter.push(s.scan);  // whose stamps begin again
        for (const RoomScan& s : first) filter.look_again(0, s.scan);
        filter.finish();
        std::vector<RoomScan> all = first;
        all.insert(all.end(), second.begin(), second.end());
        std::vector<Verdict> final;
        for (const RoomScan& s : all) final.push_back(filter.verdict(s.scan));
        EXPECT_GT(share(all, final, Label::dynamic, Label::dynamic), 0.9) << comes;
        EXPECT_GT(share(all, final, Label::static_, Label::static_), 0.99) << comes;
    }
}

}  // namespace dynamic_filter_test
}  // namespace dynamic_filter
