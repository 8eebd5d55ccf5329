// SPDX-License-Identifier: MIT
#include "dynamic_filter/filter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "dynamic_filter/error.hpp"
#include "dynamic_filter/parallel.hpp"
#include "geometry/pose.hpp"
#include "support/filled_map.hpp"
#include "support/outcome.hpp"

namespace dynamic_filter {
namespace dynamic_filter_test {

using test::all_are;
using test::drive;
using test::every_scan;
using test::expect_same;
using test::Outcome;
using test::RoomScan;
using test::run;
using test::share;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

TEST(DynamicFilter, RejectsAConfigOutOfBounds) {
    Config config;
    config.map.voxel_size = -1.0;
    EXPECT_THROW(DynamicFilter{config}, ConfigError);
}

TEST(DynamicFilter, RunsTheDefaultPresetOnly) {
    EXPECT_THROW(DynamicFilter{preset("paper")}, ConfigError);
    EXPECT_THROW(DynamicFilter(preset("paper"), Region{}), ConfigError);
}

TEST(DynamicFilter, WantsPoses) {
    DynamicFilter filter{Config{}};
    Scan scan = drive(1, false)[0].scan;
    scan.has_pose = false;
    EXPECT_THROW(filter.push(scan), Error);
}

TEST(DynamicFilter, NothingIsPushedAfterTheEnd) {
    DynamicFilter filter{Config{}};
    const auto scans = drive(2, false);
    filter.push(scans[0].scan);
    filter.finish();
    filter.finish();
    EXPECT_THROW(filter.push(scans[1].scan), Error);
}

TEST(DynamicFilter, WallsAreStillAndTheWalkerIsDynamic) {
    const auto scans = drive(24, true);
    const Outcome result = run(scans, Config{});
    EXPECT_GT(share(scans, result.final, Label::static_, Label::static_), 0.99);
    EXPECT_GT(share(scans, result.final, Label::dynamic, Label::dynamic), 0.9);
    ASSERT_EQ(result.instant.size(), scans.size());
    EXPECT_GT(share(scans, result.instant, Label::dynamic, Label::dynamic), 0.7);
    EXPECT_LT(share(scans, result.instant, Label::static_, Label::dynamic), 0.01);
}

TEST(DynamicFilter, NothingMovesInAnEmptyRoom) {
    const auto scans = drive(20, false);
    EXPECT_LT(share(scans, run(scans, Config{}).final, Label::static_, Label::dynamic), 0.001);
}

TEST(DynamicFilter, TheFirstScanIsUnknownAtOnceAndKnownInTheEnd) {
    const auto scans = drive(12, false);
    const Outcome result = run(scans, Config{});
    EXPECT_TRUE(all_are(std::vector{result.instant[0]}, Label::unknown));
    EXPECT_GT(share({scans[0]}, {result.final[0]}, Label::static_, Label::static_), 0.99);
}

TEST(DynamicFilter, GivesTheSameBitsForAnyNumberOfThreads) {
    const auto scans = drive(12, true);
    Outcome one, four;
    with_threads(1, [&] { one = run(scans, Config{}); });
    with_threads(4, [&] { four = run(scans, Config{}); });
    expect_same(one.instant, four.instant);
    expect_same(one.final, four.final);
}

TEST(DynamicFilter, TheWorldsOriginDoesNotMatter) {
    const auto near = drive(10, true), far = drive(10, true, {65536.0, -131072.0, 0.0});
    const Outcome a = run(near, Config{}), b = run(far, Config{});
    for (std::size_t s = 0; s < near.size(); ++s) EXPECT_EQ(a.final[s].labels, b.final[s].labels);
}

TEST(DynamicFilter, PointsThatAreNoMeasurementsAndUnseenScansAreUnknown) {
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

TEST(DynamicFilter, TheLatestMapHoldsWhatCameAndStayed) {
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

TEST(DynamicFilter, AFootOnTheGroundIsDynamicAndTheGroundIsNot) {
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

// The second drive meets another filter, which has the evidence of the first one.
TEST(DynamicFilter, GoesOnFromTheEvidenceOfAnotherAsIfItHadSeenTheDrivesItself) {
    for (const bool comes : {false, true}) {
        auto first = standing(!comes, 0), second = standing(comes, 24);
        for (RoomScan& s : first) s.scan.sensor = 1;  // of which the second drive knows nothing
        for (const MapTime time : {MapTime::always, MapTime::latest}) {
            Config config = preset("default");
            config.map.time = time;
            DynamicFilter whole(config), before(config), after(config);
            for (const RoomScan& s : first) whole.push(s.scan);
            for (const RoomScan& s : first) before.push(s.scan);
            const std::vector<std::byte> evidence = before.evidence();
            after.go_on_from(evidence);
            EXPECT_EQ(after.evidence(), evidence);
            EXPECT_EQ(after.size(), whole.size());
            whole.begin_drive();
            after.begin_drive();
            for (const RoomScan& s : second) {
                const Verdict expected = whole.push(s.scan), found = after.push(s.scan);
                EXPECT_EQ(found.labels, expected.labels) << s.scan.index;
                EXPECT_EQ(found.probability, expected.probability) << s.scan.index;
            }
            EXPECT_EQ(after.evidence(), whole.evidence());
            for (const RoomScan& s : first) whole.look_again(0, s.scan);
            for (const RoomScan& s : first) after.look_again(0, s.scan);
            whole.finish();
            after.finish();
            for (const auto* drive : {&first, &second}) {
                for (const RoomScan& s : *drive) {
                    const Verdict expected = whole.verdict(s.scan), found = after.verdict(s.scan);
                    EXPECT_EQ(found.labels, expected.labels) << s.scan.index;
                    EXPECT_EQ(found.probability, expected.probability) << s.scan.index;
                    EXPECT_EQ(found.stays, expected.stays) << s.scan.index;
                }
            }
        }
    }
}

TEST(DynamicFilter, EvidenceThatIsDamagedOrComesTooLateIsRefused) {
    const auto scans = standing(true, 0);
    DynamicFilter filter(preset("default"));
    filter.push(scans.front().scan);
    std::vector<std::byte> evidence = filter.evidence();
    EXPECT_THROW(filter.go_on_from(evidence), Error);
    evidence.push_back(std::byte{0});
    EXPECT_THROW(DynamicFilter(preset("default")).go_on_from(evidence), Error);
    evidence.resize(evidence.size() / 2);
    EXPECT_THROW(DynamicFilter(preset("default")).go_on_from(evidence), Error);
}

// Only what look_again() uses has to be read.
TEST(DynamicFilter, TheScansThatLookAgainAreKnownByTheirPosesAndStamps) {
    const auto first = standing(true, 0), second = standing(false, 24);
    Config config = preset("default");
    config.keyframe = {.interval = 0.6, .distance = 5.0};
    DynamicFilter all(config), some(config);
    std::vector<Scan> unread;
    for (const RoomScan& s : first) {
        unread.push_back(s.scan);
        unread.back().points.clear();
    }
    EXPECT_EQ(some.are_to_look_again(unread), std::vector<bool>(first.size(), false));
    for (DynamicFilter* filter : {&all, &some}) {
        for (const RoomScan& s : first) filter->push(s.scan);
        filter->begin_drive();
        for (const RoomScan& s : second) filter->push(s.scan);
    }
    const std::vector<bool> looks = some.are_to_look_again(unread);
    EXPECT_LT(std::count(looks.begin(), looks.end(), true), 24);
    EXPECT_GT(std::count(looks.begin(), looks.end(), true), 4);
    for (std::size_t i = 0; i < first.size(); ++i) {
        all.look_again(0, first[i].scan);
        if (looks[i]) some.look_again(0, first[i].scan);
    }
    EXPECT_EQ(some.evidence(), all.evidence());
}

std::vector<Verdict> judge_all(DynamicFilter& method, const std::vector<RoomScan>& scans) {
    std::vector<Verdict> instant;
    for (const RoomScan& s : scans) {
        instant.push_back(method.push(s.scan));
    }
    return instant;
}

std::map<std::uint32_t, float> as_map(const std::vector<StaticVoxel>& voxels) {
    std::map<std::uint32_t, float> map;
    for (const StaticVoxel& v : voxels) map[v.voxel] = v.probability;
    EXPECT_EQ(map.size(), voxels.size());
    return map;
}

TEST(DynamicFilter, JudgesEveryScanAtOnceAndDecidesAtTheEnd) {
    const auto scans = drive(24, true);
    DynamicFilter method(every_scan());
    const auto instant = judge_all(method, scans);
    method.finish();
    std::vector<Verdict> final;
    for (std::size_t i = 0; i < scans.size(); ++i) {
        EXPECT_EQ(instant[i].index, i);
        EXPECT_EQ(instant[i].labels.size(), scans[i].scan.points.size());
        final.push_back(method.verdict(scans[i].scan));
        EXPECT_TRUE(final.back().stays.empty());  // only for `map.time` = latest
    }
    EXPECT_GT(test::share(scans, final, Label::dynamic, Label::dynamic), 0.95);
    EXPECT_GT(test::share(scans, final, Label::static_, Label::static_), 0.98);
}

TEST(DynamicFilter, SettlingGivesTheProbabilitiesOfTheDecisionFromTheSameEvidence) {
    auto scans = drive(12, true);
    scans[5].scan.points[7] = Point::Zero();  // not measured
    DynamicFilter method(every_scan());
    judge_all(method, scans);
    method.finish();
    for (const RoomScan& s : scans) {
        const Verdict final = method.verdict(s.scan);
        const Verdict settled = method.settled(s.scan);
        EXPECT_EQ(settled.probability, final.probability);
        for (std::size_t i = 0; i < final.labels.size(); ++i) {
            // Only the points of feet may differ.
            if (final.labels[i] == settled.labels[i]) continue;
            EXPECT_EQ(settled.labels[i], Label::static_);
        }
    }
    EXPECT_EQ(method.settled(scans[5].scan).labels[7], Label::unknown);
}

TEST(DynamicFilter, TheLocalMapIsTheStaticMapAroundAPose) {
    DynamicFilter method(every_scan());
    judge_all(method, drive(12, true));
    method.finish();
    const auto all = as_map(method.static_map());
    ASSERT_GT(all.size(), 1000U);
    for (const auto& [voxel, probability] : all) EXPECT_GE(probability, 0.5F);
    Pose corner = Pose::Identity();
    corner.translation() = Eigen::Vector3d(-6.0, -5.0, 1.0);
    EXPECT_EQ(as_map(method.local_static_map(corner, 1000.0)), all);
    const auto near = as_map(method.local_static_map(corner, 4.0));
    std::size_t expected = 0;
    for (const StaticVoxel& v : method.static_map()) {
        const double distance = (v.center - corner.translation()).norm();
        expected += distance < 3.8 ? 1 : 0;  // its points may lie anywhere in the voxel
        if (near.contains(v.voxel)) {
            EXPECT_LT(distance, 4.2);
            EXPECT_EQ(near.at(v.voxel), v.probability);
        }
    }
    EXPECT_GE(near.size(), expected);
    EXPECT_GT(expected, 100U);
}

TEST(DynamicFilter, AHistoryTellsWhoSawThroughAVoxelThatWasRemoved) {
    auto scans = drive(20, true);
    for (RoomScan& s : scans) s.scan.index += 100;
    Config config = every_scan();
    config.scans.evidence.longest_run = 255;  // so that no keyframe stands for others
    DynamicFilter method(config);
    judge_all(method, scans);
    method.finish();
    std::vector<std::uint32_t> all(method.size());
    for (std::uint32_t v = 0; v < all.size(); ++v) all[v] = v;
    const auto histories = method.histories(all);
    ASSERT_EQ(histories.size(), all.size());
    const auto in_map = as_map(method.static_map());
    std::size_t removed = 0;
    for (std::uint32_t v = 0; v < all.size(); ++v) {
        const VoxelHistory& h = histories[v];
        EXPECT_GE(h.first, 100U);
        EXPECT_LE(h.first, h.last);
        EXPECT_LE(h.last, 119U);
        EXPECT_LE(h.n_own, h.last - h.first + 1);
        if (!h.probability) continue;
        EXPECT_EQ(in_map.contains(v), *h.probability >= 0.5F);
        if (*h.probability >= 0.5F) {
            EXPECT_EQ(h.probability, in_map.at(v));
            EXPECT_TRUE(h.free_keyframes.empty());
            continue;
        }
        ++removed;
        EXPECT_EQ(h.free_keyframes.size(), h.n_free);
        EXPECT_LE(h.free, static_cast<float>(h.n_free));
    }
    EXPECT_GT(removed, 50U);
}

TEST(DynamicFilter, ContentsNameTheKeyframes) {
    DynamicFilter method(every_scan());
    judge_all(method, drive(5, false));
    const MapContents contents = method.contents();
    EXPECT_EQ(contents.observer, "keyframes");
    EXPECT_EQ(contents.observers, 5U);
    EXPECT_EQ(contents.keyframes, (std::vector<std::size_t>{0, 1, 2, 3, 4}));
    ASSERT_EQ(contents.throughput.size(), 2U);
    EXPECT_TRUE(contents.beams);
    for (const char* stage : {"judge", "integrate", "insertion", "visibility_check", "instances"}) {
        EXPECT_TRUE(method.times().contains(stage)) << stage;
    }
}

// A crate is set down before the sensor, which is at rest, and stays.
TEST(DynamicFilter, WithTheLatestMapWhatCameAndStaysIsInIt) {
    const test::Box room{{-6.03, -5.03, 0.02}, {9.03, 5.03, 3.1}};
    const test::Box crate{{2.5, -0.5, 0.02}, {3.3, 0.5, 1.8}};
    Pose pose = Pose::Identity();
    pose.translation() = Eigen::Vector3d(0.0, 0.25, 1.25);
    std::vector<RoomScan> scans;
    for (std::size_t i = 0; i < 60; ++i) {
        std::vector<test::Box> boxes;
        if (i >= 25) boxes.push_back(crate);
        scans.push_back(test::scan_room(pose, room, boxes));
        scans.back().scan.stamp = 0.5 * static_cast<double>(i);
        scans.back().scan.index = i;
    }
    for (const MapTime time : {MapTime::always, MapTime::latest}) {
        Config config = every_scan();
        config.map.time = time;
        DynamicFilter method(config);
        judge_all(method, scans);
        method.finish();
        const auto map = as_map(method.static_map());
        std::size_t points = 0, dynamic = 0, stay = 0, in_map = 0;
        for (const RoomScan& s : scans) {
            const Verdict verdict = method.verdict(s.scan);
            const auto voxels = method.voxels_of(s.scan);
            for (std::size_t i = 0; i < s.truth.size(); ++i) {
                const bool stays = !verdict.stays.empty() && verdict.stays[i];
                if (s.truth[i] != Label::dynamic) {
                    EXPECT_FALSE(stays && verdict.labels[i] == Label::static_);
                    continue;
                }
                ++points;
                dynamic += verdict.labels[i] == Label::dynamic ? 1 : 0;
                stay += stays ? 1 : 0;
                in_map += map.contains(voxels[i]) ? 1 : 0;
                if (stays) {
                    EXPECT_EQ(verdict.labels[i], Label::dynamic);
                    EXPECT_EQ(map.at(voxels[i]), 1.0F);
                }
            }
        }
        ASSERT_GT(points, 1000U);
        EXPECT_GT(dynamic, points * 8 / 10);  // the rest lies in voxels of the floor
        if (time == MapTime::latest) {
            EXPECT_GT(stay, dynamic * 9 / 10);
            EXPECT_EQ(in_map, points);
        } else {
            EXPECT_EQ(stay, 0U);
            EXPECT_LT(in_map, points * 2 / 10);
        }
    }
}

TEST(DynamicFilter, WhatLiesFarCanBeForgottenAndTheRestGoesOn) {
    const auto scans = drive(16, true);
    const std::vector<RoomScan> first(scans.begin(), scans.begin() + 8);
    const std::vector<RoomScan> rest(scans.begin() + 8, scans.end());
    DynamicFilter whole(every_scan()), cut(every_scan());
    judge_all(whole, first);
    judge_all(cut, first);
    cut.keep_within(Pose(Eigen::Translation3d(4.0, 0.0, 1.0)), 6.0, SIZE_MAX);
    EXPECT_LT(cut.size(), whole.size());
    const auto expected = judge_all(whole, rest), found = judge_all(cut, rest);
    std::size_t dynamic = 0;
    for (std::size_t s = 0; s < rest.size(); ++s) {
        for (std::size_t i = 0; i < rest[s].truth.size(); ++i) {
            const Point p =
                (rest[s].scan.T_world_sensor * rest[s].scan.points[i].cast<double>()).cast<float>();
            // Farther out, the neighbors are missing.
            if ((p - Point(4.0F, 0.0F, 1.0F)).norm() > 4.0F) continue;
            EXPECT_EQ(found[s].labels[i], expected[s].labels[i]);
            dynamic += found[s].labels[i] == Label::dynamic ? 1 : 0;
        }
    }
    EXPECT_GT(dynamic, 50U);
}

}  // namespace dynamic_filter_test
}  // namespace dynamic_filter
