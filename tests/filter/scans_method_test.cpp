// SPDX-License-Identifier: MIT
#include "filter/scans_method.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "support/filled_map.hpp"
#include "support/outcome.hpp"

namespace dynamic_filter {
namespace scans_method_test {

using test::drive;
using test::every_scan;
using test::RoomScan;

std::vector<Verdict> judge_all(ScansMethod& method, const std::vector<RoomScan>& scans) {
    std::vector<Verdict> instant;
    for (const RoomScan& s : scans) {
        Judged judged = method.judge(s.scan);
        EXPECT_EQ(judged.verdicts.size(), 1U);
        judged.integrate();
        instant.push_back(judged.verdicts.at(0));
    }
    return instant;
}

LocatedScan locate(const ScansMethod& method, const Scan& scan) {
    LocatedScan located;
    to_voxels(scan.points, scan.T_world_sensor, static_cast<float>(Config{}.map.voxel_size),
              located.in_map);
    for (const VoxelKey key : located.in_map.keys) {
        located.voxels.push_back(method.voxels().find(key).value_or(kNoVoxel));
    }
    return located;
}

Verdict blank(const Scan& scan) {
    return {scan.index, Labels(scan.points.size(), Label::unknown),
            std::vector<float>(scan.points.size())};
}

Verdict decided(const ScansMethod& method, const Scan& scan) {
    Verdict verdict = blank(scan);
    method.decide(locate(method, scan), verdict);
    return verdict;
}

std::map<std::uint32_t, float> as_map(const std::vector<VoxelOccupancy>& voxels) {
    std::map<std::uint32_t, float> map;
    for (const VoxelOccupancy& v : voxels) map[v.voxel] = v.probability;
    EXPECT_EQ(map.size(), voxels.size());
    return map;
}

TEST(ScansMethod, JudgesEveryScanAtOnceAndDecidesAtTheEnd) {
    const auto scans = drive(24, true);
    ScansMethod method(every_scan());
    EXPECT_TRUE(method.judges_each_scan());
    const auto instant = judge_all(method, scans);
    EXPECT_TRUE(method.finish().empty());
    std::vector<Verdict> final;
    for (std::size_t i = 0; i < scans.size(); ++i) {
        EXPECT_EQ(instant[i].index, i);
        EXPECT_EQ(instant[i].labels.size(), scans[i].scan.points.size());
        final.push_back(decided(method, scans[i].scan));
        EXPECT_TRUE(final.back().stays.empty());  // only for `map.time` = latest
    }
    EXPECT_GT(test::share(scans, final, Label::dynamic, Label::dynamic), 0.95);
    EXPECT_GT(test::share(scans, final, Label::static_, Label::static_), 0.98);
}

TEST(ScansMethod, SettlingGivesTheProbabilitiesOfTheDecisionFromTheSameEvidence) {
    auto scans = drive(12, true);
    scans[5].scan.points[7] = Point::Zero();  // not measured
    ScansMethod method(every_scan());
    judge_all(method, scans);
    method.finish();
    for (const RoomScan& s : scans) {
        const Verdict final = decided(method, s.scan);
        Verdict settled = blank(s.scan);
        method.settle(locate(method, s.scan), settled);
        EXPECT_EQ(settled.probability, final.probability);
        for (std::size_t i = 0; i < final.labels.size(); ++i) {
            // Only the points of feet may differ.
            if (final.labels[i] == settled.labels[i]) continue;
            EXPECT_EQ(settled.labels[i], Label::static_);
        }
    }
    Verdict settled = blank(scans[5].scan);
    method.settle(locate(method, scans[5].scan), settled);
    EXPECT_EQ(settled.labels[7], Label::unknown);
}

TEST(ScansMethod, TheLocalMapIsTheStaticMapAroundAPose) {
    ScansMethod method(every_scan());
    judge_all(method, drive(12, true));
    method.finish();
    const auto all = as_map(method.static_map());
    ASSERT_GT(all.size(), 1000U);
    for (const auto& [voxel, probability] : all) EXPECT_GE(probability, 0.5F);
    Pose corner = Pose::Identity();
    corner.translation() = Eigen::Vector3d(-6.0, -5.0, 1.0);
    EXPECT_EQ(as_map(method.local_map(corner, 1000.0)), all);
    const auto near = as_map(method.local_map(corner, 4.0));
    std::size_t expected = 0;
    for (const auto& [voxel, probability] : all) {
        const Point middle = center(method.voxels().key(voxel), 0.2F);
        const double distance = (middle.cast<double>() - corner.translation()).norm();
        expected += distance < 3.8 ? 1 : 0;  // its points may lie anywhere in the voxel
        if (near.contains(voxel)) {
            EXPECT_LT(distance, 4.2);
            EXPECT_EQ(near.at(voxel), probability);
        }
    }
    EXPECT_GE(near.size(), expected);
    EXPECT_GT(expected, 100U);
}

TEST(ScansMethod, AHistoryTellsWhoSawThroughAVoxelThatWasRemoved) {
    auto scans = drive(20, true);
    for (RoomScan& s : scans) s.scan.index += 100;
    ScansMethod method(every_scan());
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

TEST(ScansMethod, ContentsNameTheKeyframes) {
    ScansMethod method(every_scan());
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
TEST(ScansMethod, WithTheLatestMapWhatCameAndStaysIsInIt) {
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
        ScansMethod method(config);
        judge_all(method, scans);
        method.finish();
        const auto map = as_map(method.static_map());
        std::size_t points = 0, dynamic = 0, stay = 0, in_map = 0;
        for (const RoomScan& s : scans) {
            const Verdict verdict = decided(method, s.scan);
            const LocatedScan located = locate(method, s.scan);
            for (std::size_t i = 0; i < s.truth.size(); ++i) {
                const bool stays = !verdict.stays.empty() && verdict.stays[i];
                if (s.truth[i] != Label::dynamic) {
                    EXPECT_FALSE(stays && verdict.labels[i] == Label::static_);
                    continue;
                }
                ++points;
                dynamic += verdict.labels[i] == Label::dynamic ? 1 : 0;
                stay += stays ? 1 : 0;
                in_map += map.contains(located.voxels[i]) ? 1 : 0;
                if (stays) {
                    EXPECT_EQ(verdict.labels[i], Label::dynamic);
                    EXPECT_EQ(map.at(located.voxels[i]), 1.0F);
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

TEST(ScansMethod, WhatLiesFarCanBeForgottenAndTheRestGoesOn) {
    const auto scans = drive(16, true);
    const std::vector<RoomScan> first(scans.begin(), scans.begin() + 8);
    const std::vector<RoomScan> rest(scans.begin() + 8, scans.end());
    ScansMethod whole(every_scan()), cut(every_scan());
    judge_all(whole, first);
    judge_all(cut, first);
    cut.keep_within(Eigen::Vector3d(4.0, 0.0, 1.0), 6.0, SIZE_MAX);
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

}  // namespace scans_method_test
}  // namespace dynamic_filter
