// SPDX-License-Identifier: MIT
#include "paper/pipeline.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <set>

#include "dynamic_filter/error.hpp"
#include "dynamic_filter/parallel.hpp"
#include "paper/submap.hpp"
#include "support/outcome.hpp"

namespace dynamic_filter {
namespace pipeline_test {

using test::all_are;
using test::drive;
using test::expect_same;
using test::Outcome;
using test::RoomScan;
using test::run;
using test::share;
using test::small_windows;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

TEST(PaperPipeline, WallsAreStillAndTheWalkerIsDynamic) {
    const auto scans = drive(24, true);
    const Outcome result = run(scans, small_windows());
    EXPECT_EQ(result.submaps, 3U);
    EXPECT_GT(share(scans, result.final, Label::static_, Label::static_), 0.9);
    EXPECT_GT(share(scans, result.final, Label::dynamic, Label::dynamic), 0.9);
    EXPECT_GT(share(scans, result.instant, Label::static_, Label::static_), 0.9);
    EXPECT_GT(share(scans, result.instant, Label::dynamic, Label::dynamic), 0.8);
}

TEST(PaperPipeline, AnEmptyRoomSeenFromOnePlaceIsAllStill) {
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

TEST(PaperPipeline, AnEmptyRoomIsStillAllButAFewPoints) {
    const auto scans = drive(20, false);
    EXPECT_GT(share(scans, run(scans, small_windows()).final, Label::static_, Label::static_), 0.9);
}

TEST(PaperPipeline, EveryScanGetsOneVerdictOfItsSizeInOrder) {
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

TEST(PaperPipeline, InstantVerdictsComeWhenAWindowCloses) {
    const auto scans = drive(10, false);
    PaperPipeline filter(small_windows());
    for (std::size_t s = 0; s < 10; ++s) {
        EXPECT_EQ(filter.push(scans[s].scan).size(), s == 8 ? 8U : 0U) << s;
    }
    EXPECT_EQ(filter.finish().size(), 2U);
}

TEST(PaperPipeline, WhatWasNotMeasuredIsUnknown) {
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

TEST(PaperPipeline, AnyNumberOfThreadsGivesTheSameBits) {
    const auto scans = drive(16, true);
    Outcome one, two, all;
    with_threads(1, [&] { one = run(scans, small_windows()); });
    with_threads(2, [&] { two = run(scans, small_windows()); });
    with_threads(0, [&] { all = run(scans, small_windows()); });
    expect_same(one.final, two.final);
    expect_same(one.instant, two.instant);
    expect_same(one.final, all.final);
}

TEST(PaperPipeline, FarOriginsGiveTheSameVerdicts) {
    const auto near = drive(16, true);
    auto far = near;
    for (RoomScan& s : far)
        s.scan.T_world_sensor.translation() += Eigen::Vector3d(5e5, 5e6, -200.0);
    const Outcome a = run(near, small_windows()), b = run(far, small_windows());
    expect_same(a.final, b.final);
    expect_same(a.instant, b.instant);
}

TEST(PaperPipeline, ASingleScanIsReturnedAsItIs) {
    const auto scans = drive(1, true);
    const Outcome result = run(scans, small_windows());
    EXPECT_TRUE(all_are(result.final, Label::static_));
    EXPECT_TRUE(all_are(result.instant, Label::static_));
    EXPECT_EQ(result.submaps, 1U);
}

TEST(PaperPipeline, WithoutScansThereAreNoVerdicts) {
    PaperPipeline filter(small_windows());
    EXPECT_TRUE(filter.finish().empty());
}

TEST(PaperPipeline, ScansWithoutPointsAreFine) {
    std::vector<RoomScan> scans(20);
    for (std::size_t i = 0; i < scans.size(); ++i) scans[i].scan.stamp = static_cast<double>(i);
    EXPECT_EQ(run(scans, small_windows()).final.size(), 20U);
}

TEST(PaperPipeline, FrontEndOnlyIsTheUnionOfTheStaticSubmaps) {
    Config config = small_windows();
    config.back_end.enabled = false;
    const auto scans = drive(20, true);
    PaperPipeline filter(config);
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

TEST(PaperPipeline, BackEndOnlyLeavesInstantVerdictsStillAndStillFindsTheWalker) {
    Config config = small_windows();
    config.front_end.enabled = false;
    const auto scans = drive(40, true);
    const Outcome result = run(scans, config);
    EXPECT_TRUE(all_are(result.instant, Label::static_));
    EXPECT_GT(share(scans, result.final, Label::dynamic, Label::dynamic), 0.5);
    EXPECT_GT(share(scans, result.final, Label::static_, Label::static_), 0.8);
}

TEST(PaperPipeline, MoreChecksNeverRaiseAProbability) {
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

TEST(PaperPipeline, TheThresholdIsInclusive) {
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

TEST(PaperPipeline, RemovertTakesTheWholeSequenceAsOneWindow) {
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

TEST(PaperPipeline, EveryRevertingKeepsAtLeastWhatNoneKeeps) {
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

TEST(PaperPipeline, NotesTheTimesOfItsStages) {
    PaperPipeline filter(small_windows());
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
TEST(PaperPipeline, ASensorThatStandsStillForLongKeepsTheWallsItSawLast) {
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

/// Returns how many instant verdicts each scan gave.
std::vector<std::size_t> judge_all(PaperPipeline& method, const std::vector<RoomScan>& scans) {
    std::vector<std::size_t> verdicts;
    for (const RoomScan& s : scans) {
        verdicts.push_back(method.push(s.scan).size());
    }
    return verdicts;
}

/// The verdict on points in the world.
Verdict decide(const PaperPipeline& method, const Points& points) {
    return method.verdict({points, Pose::Identity(), 0.0, 0});
}

std::map<std::uint32_t, float> as_map(const std::vector<StaticVoxel>& voxels) {
    std::map<std::uint32_t, float> map;
    for (const StaticVoxel& v : voxels) map[v.voxel] = v.probability;
    EXPECT_EQ(map.size(), voxels.size());
    return map;
}

const Point kAir(0.5F, 0.25F, 1.25F), kFarAir(300.0F, 0.0F, 1.0F);

TEST(PaperPipeline, JudgesWindowByWindow) {
    PaperPipeline method(small_windows());
    const auto verdicts = judge_all(method, drive(20, true));
    for (std::size_t i = 0; i < verdicts.size(); ++i) {
        EXPECT_EQ(verdicts[i], i == 8 || i == 16 ? 8U : 0U) << i;
    }
    const auto rest = method.finish();
    ASSERT_EQ(rest.size(), 4U);
    EXPECT_EQ(rest.front().index, 16U);
    EXPECT_EQ(rest.back().index, 19U);
    const MapContents contents = method.contents();
    EXPECT_EQ(contents.observer, "submaps");
    EXPECT_EQ(contents.observers, 3U);
    EXPECT_TRUE(contents.beams);
    ASSERT_EQ(contents.throughput.size(), 2U);
    for (const char* stage : {"front_end", "back_end", "merging"}) {
        EXPECT_TRUE(method.times().contains(stage)) << stage;
    }
}

TEST(PaperPipeline, RemovertIsOneWindowWithoutBackEnd) {
    Config config;
    config.method = Method::removert;
    config.keyframe = small_windows().keyframe;
    PaperPipeline method(config);
    for (const std::size_t verdicts : judge_all(method, drive(20, true))) EXPECT_EQ(verdicts, 0U);
    EXPECT_EQ(method.finish().size(), 20U);
    EXPECT_EQ(method.contents().observers, 1U);
    const auto map = as_map(method.static_map());
    EXPECT_EQ(map.size(), method.contents().voxels);
    for (const auto& [voxel, probability] : map) EXPECT_EQ(probability, 1.0F);
}

TEST(PaperPipeline, WhatNoStaticSubmapHoldsWasRemoved) {
    PaperPipeline method(small_windows());
    judge_all(method, drive(16, true));
    method.finish();
    const Point nan = Point::Constant(std::numeric_limits<float>::quiet_NaN());
    const Verdict verdict = decide(method, {kAir, kFarAir, nan});
    EXPECT_EQ(verdict.labels, (Labels{Label::dynamic, Label::dynamic, Label::unknown}));
    EXPECT_EQ(verdict.probability, (std::vector<float>{0.0F, 0.0F, 0.0F}));
}

TEST(PaperPipeline, WhatWasForgottenIsUnknown) {
    PaperPipeline whole(small_windows());
    PaperPipeline method(small_windows(), Horizon(3.0, SIZE_MAX));
    judge_all(whole, drive(40, true));
    judge_all(method, drive(40, true));
    whole.flush();
    method.flush();
    EXPECT_LE(method.size(), whole.size());
    method.finish();
    const Verdict verdict = decide(method, {kAir, kFarAir});
    EXPECT_EQ(verdict.labels, (Labels{Label::dynamic, Label::unknown}));
    EXPECT_EQ(verdict.probability[1], 0.0F);
}

TEST(PaperPipeline, AboveTheLimitOfPointsOneSubmapRemains) {
    PaperPipeline method(small_windows(), Horizon(0.0, 1));
    judge_all(method, drive(20, true));
    method.flush();
    EXPECT_EQ(method.contents().observers, 1U);
}

TEST(PaperPipeline, MapsHoldTheVoxelsThatReachTheThreshold) {
    Config config = small_windows();
    PaperPipeline method(config);
    const auto scans = drive(16, true);
    judge_all(method, scans);
    method.finish();
    const auto map = as_map(method.static_map());
    ASSERT_GT(map.size(), 1000U);
    std::vector<std::uint32_t> all(method.contents().voxels);
    for (std::uint32_t v = 0; v < all.size(); ++v) all[v] = v;
    const auto histories = method.histories(all);
    const auto threshold = static_cast<float>(config.map.occupancy_threshold);
    for (const std::uint32_t v : all) {
        const auto& probability = histories[v].probability;
        const bool is_static = probability && *probability >= threshold;
        ASSERT_EQ(map.contains(v), is_static);
        if (is_static) {
            EXPECT_EQ(map.at(v), *probability);
        }
    }
    for (const RoomScan& s : scans) {
        const Verdict verdict = method.verdict(s.scan);
        const PointVoxels voxels = method.voxels_of(s.scan);
        for (std::size_t i = 0; i < voxels.size(); ++i) {
            if (voxels[i] == kNoVoxel) continue;
            const auto& probability = histories[voxels[i]].probability;
            EXPECT_EQ(verdict.labels[i], label_of(probability, config.map.occupancy_threshold));
            EXPECT_EQ(verdict.probability[i], probability.value_or(0.0F));
        }
    }
    const auto near = method.local_static_map(Pose::Identity());
    EXPECT_GT(near.size(), 1000U);
    for (const StaticVoxel& v : near) EXPECT_GE(v.probability, threshold);
    Pose far = Pose::Identity();
    far.translation().x() = 1e4;
    EXPECT_TRUE(method.local_static_map(far).empty());
}

}  // namespace pipeline_test
}  // namespace dynamic_filter
