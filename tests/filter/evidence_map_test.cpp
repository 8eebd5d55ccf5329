// SPDX-License-Identifier: MIT
#include "filter/evidence_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include <cmath>
#include <numeric>

#include "filter/keyframe.hpp"
#include "filter/vote.hpp"
#include "support/filled_map.hpp"
#include "support/rings.hpp"

namespace dynamic_filter {
namespace evidence_map_test {

using test::drive;
using test::every_scan;
using test::filled;
using test::probability_of;

/// Asks all keyframes about a place, oldest first.
Evidence brute_force(const std::vector<test::RoomScan>& scans, const Point& place,
                     const BeamPattern& beams, const Config& config) {
    Evidence e;
    const Scan* last = nullptr;
    for (const auto& s : scans) {
        if (last != nullptr && !is_keyframe(*last, s.scan, config.keyframe)) continue;
        last = &s.scan;
        Directions seen;
        to_spherical(std::span(&place, 1), s.scan.T_world_sensor.inverse().cast<float>(), seen);
        std::vector<Sight> sights;
        check_lines_of_sight(BeamImage(s.scan.points, beams), seen,
                             margins_of(config.scans.sight, config.map.voxel_size), sights);
        record(e, {sights.at(0)}, static_cast<unsigned>(config.scans.evidence.longest_run));
    }
    return e;
}

TEST(EvidenceMap, EqualsAskingEveryKeyframeAboutEveryVoxel) {
    const auto scans = drive(9, true);
    Config some_scans;
    some_scans.keyframe.interval = 1.0;  // every second scan
    some_scans.keyframe.distance = 100.0;
    Config short_sighted = every_scan();
    short_sighted.scans.sight.farthest = 6.0;  // some voxels lie just beyond it
    for (const Config& config : {every_scan(), some_scans, short_sighted}) {
        const EvidenceMap map = filled(scans, config);
        ASSERT_GT(map.grid().voxels().size(), 1000U);
        for (std::uint32_t v = 0; v < map.grid().voxels().size(); v += 7) {
            const Evidence expected =
                brute_force(scans, map.grid()[v].centroid, *map.keyframes().beams(), config);
            EXPECT_EQ(map.grid()[v].evidence.n_occ, expected.n_occ) << v;
            EXPECT_EQ(map.grid()[v].evidence.n_free, expected.n_free) << v;
            EXPECT_EQ(map.grid()[v].evidence.n_switch, expected.n_switch) << v;
            EXPECT_EQ(map.grid()[v].evidence.free, expected.free) << v;
            EXPECT_EQ(map.grid()[v].evidence.occupied, expected.occupied) << v;
        }
    }
}

TEST(EvidenceMap, AVoxelIsTheCentroidOfItsPointsInTheFirstScanThatHasAny) {
    const auto scans = drive(2, false);
    const EvidenceMap map = filled(scans, every_scan());
    const std::uint32_t voxel = 17;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    int count = 0;
    for (const Point& p : scans[0].scan.points) {
        const Point at = (scans[0].scan.T_world_sensor * p.cast<double>()).cast<float>();
        if (pack(*cell_of(at, 5.0F)) != map.grid().voxels().key(voxel)) continue;
        sum += at.cast<double>();
        ++count;
    }
    ASSERT_GT(count, 0);
    EXPECT_LT((map.grid()[voxel].centroid.cast<double>() - sum / count).norm(), 1e-5);
}

TEST(EvidenceMap, AFewPointsAtFirstDoNotDecideHowTheSensorLooks) {
    auto scans = drive(4, false);
    test::RoomScan few = scans[0];
    few.scan.points = {{1.0F, 0.0F, 0.0F}, {0.0F, 1.0F, 0.0F}};
    EXPECT_FALSE(filled({few}, every_scan()).keyframes().beams());
    scans.insert(scans.begin(), few);
    const auto beams = filled(scans, every_scan()).keyframes().beams();
    ASSERT_TRUE(beams);
    EXPECT_NEAR(beams->azimuth_spacing, 1.5 * M_PI / 180.0, 0.002);
}

TEST(EvidenceMap, LargeVoxelsKeepTheirCorners) {
    Config config = every_scan();
    config.map.voxel_size = 1.0;
    const EvidenceMap map = filled(drive(12, false), config);
    for (std::uint32_t v = 0; v < map.grid().voxels().size(); ++v) {
        const auto probability = probability_of(map, v);
        ASSERT_TRUE(probability) << map.grid()[v].centroid.transpose();
        EXPECT_GE(*probability, 0.5F) << map.grid()[v].centroid.transpose();
    }
}

TEST(EvidenceMap, KnowsWhichScansOwnAVoxel) {
    const auto scans = drive(5, false);
    const EvidenceMap map = filled({scans[0], scans[0], scans[0]}, every_scan());
    for (std::uint32_t v = 0; v < map.grid().voxels().size(); ++v) {
        EXPECT_EQ(map.grid()[v].evidence.n_own, 3);
        EXPECT_EQ(map.grid()[v].evidence.first_owner, 0U);
        EXPECT_EQ(map.grid()[v].evidence.last_owner, 2U);
        EXPECT_EQ(map.grid()[v].evidence.hits, map.grid()[v].evidence.n_occ);
    }
}

TEST(EvidenceMap, ForgetsOnlyTheKeyframesBeyondItsMemory) {
    const auto scans = drive(6, true);
    Config config = every_scan();
    config.scans.max_keyframes = 2;
    const EvidenceMap map = filled(scans, config);
    std::size_t asked_few = 0;
    for (std::uint32_t v = 0; v < map.grid().voxels().size(); ++v) {
        const Evidence& e = map.grid()[v].evidence;
        const std::size_t scans_after = scans.size() - e.first_owner;
        EXPECT_LE(static_cast<std::size_t>(e.n_occ + e.n_free), scans_after + 1);
        asked_few += e.first_owner == 5 ? 1 : 0;
    }
    EXPECT_GT(asked_few, 0U);
    EXPECT_EQ(map.keyframes().total(), scans.size());
}

// A keyframe that is asked also counts for those that are skipped. The counts hardly change.
TEST(EvidenceMap, ANewVoxelAsksASelectionOfManyKeyframes) {
    auto scans = drive(2, false);
    for (std::size_t i = 2; i < 200; ++i) {  // a sensor at rest, that sees one more thing at last
        scans.push_back(scans[1]);
        scans[i].scan.index = i;
    }
    const Point thing(2.0F, 0.3F, 0.1F);
    for (int k = 0; k < 40; ++k) {
        scans.back().scan.points.push_back(thing + 0.002F * static_cast<float>(k) * Point::UnitY());
    }
    const EvidenceMap map = filled(scans, every_scan());
    std::size_t seen_through = 0;
    for (std::uint32_t v = 0; v < map.grid().voxels().size(); ++v) {
        const Evidence& e = map.grid()[v].evidence;
        if (e.first_owner != 199 || e.n_free == 0) continue;
        EXPECT_NEAR(e.n_free, 199, 20) << v;
        ++seen_through;
    }
    EXPECT_GT(seen_through, 0U);
}

// As long as every keyframe was asked by every voxel, those that see through it are those counted.
TEST(EvidenceMap, NamesTheKeyframesThatSawThroughAVoxel) {
    auto scans = drive(9, true);
    for (auto& s : scans) s.scan.index += 100;
    const EvidenceMap map = filled(scans, every_scan());
    std::vector<std::uint32_t> some;
    for (std::uint32_t v = 0; v < map.grid().voxels().size(); v += 3) some.push_back(v);
    const auto seen_through = map.free_keyframes(some);
    ASSERT_EQ(seen_through.size(), some.size());
    std::size_t passes = 0;
    for (std::size_t i = 0; i < some.size(); ++i) {
        EXPECT_EQ(seen_through[i].size(), map.grid()[some[i]].evidence.n_free) << some[i];
        EXPECT_TRUE(std::is_sorted(seen_through[i].begin(), seen_through[i].end()));
        for (const std::size_t index : seen_through[i]) EXPECT_GE(index, 100U);
        passes += seen_through[i].size();
    }
    EXPECT_GT(passes, 50U);
    EXPECT_EQ(map.keyframes().kept().size(), scans.size());
    EXPECT_EQ(map.keyframes().kept().front().index, 100U);
    EXPECT_EQ(map.index_of_owner(map.grid()[some.back()].evidence.first_owner), 108U);
}

TEST(EvidenceMap, AsksUpTo64KeyframesAndThenEverySecond) {
    Config config = every_scan();
    config.scans.observers.images_asked = 1000.0;  // all keyframes observe a new voxel
    config.scans.evidence.longest_run = 255;       // and none stands for others
    for (const std::size_t count : {64U, 65U}) {
        const EvidenceMap map = filled(drive(count, true), config);
        std::vector<std::uint32_t> all(map.grid().size());
        std::iota(all.begin(), all.end(), 0U);
        const auto seen_through = map.free_keyframes(all);
        std::size_t named = 0, counted = 0;
        for (const std::uint32_t v : all) {
            named += seen_through[v].size();
            counted += map.grid()[v].evidence.n_free;
        }
        ASSERT_GT(counted, 1000U);
        if (count == 64) {
            EXPECT_EQ(named, counted);
        } else {
            EXPECT_LT(named, counted * 6 / 10);
        }
    }
}

/// A board 5 m in front of the sensor hides what is behind it.
Points behind_a_board(Points points) {
    for (Point& p : points) {
        const Point at = 5.0F / p.x() * p;
        if (p.x() > 5.0F && std::abs(at.y()) < 1.5F && at.z() > -1.4F && at.z() < 1.0F) p = at;
    }
    return points;
}

/// Scans of a street with such a board in it, and then one without it.
EvidenceMap board_that_left(int longest_run) {
    Config config = every_scan();
    config.scans.evidence.longest_run = longest_run;
    std::vector<test::RoomScan> scans(25);
    for (std::size_t i = 0; i < scans.size(); ++i) {
        Points points = io::scan_of(64, static_cast<unsigned>(i));
        if (i + 1 < scans.size()) points = behind_a_board(std::move(points));
        scans[i].scan = {std::move(points), Pose::Identity(), 0.3 * static_cast<double>(i), i};
    }
    return filled(scans, config);
}

TEST(EvidenceMap, WhatIsSurelyOccupiedIsAskedInTurnAndAllOfItOnceSomethingLeft) {
    const EvidenceMap all = board_that_left(255), in_turn = board_that_left(16);
    ASSERT_EQ(all.grid().size(), in_turn.grid().size());
    double occupied = 0.0, estimated = 0.0;
    std::size_t left = 0, noticed = 0, only_noticed = 0;
    for (std::uint32_t v = 0; v < all.grid().size(); ++v) {
        const Evidence &e = all.grid()[v].evidence, &f = in_turn.grid()[v].evidence;
        occupied += e.n_occ;
        estimated += f.n_occ;
        if (e.n_occ < 20) continue;
        left += e.n_free > 0 ? 1 : 0;
        noticed += e.n_free > 0 && f.n_free > 0 ? 1 : 0;
        only_noticed += e.n_free == 0 && f.n_free > 0 ? 1 : 0;
    }
    EXPECT_GT(left, 100U);
    EXPECT_GE(static_cast<double>(noticed), 0.98 * static_cast<double>(left));
    EXPECT_EQ(only_noticed, 0U);
    EXPECT_NEAR(estimated / occupied, 1.0, 0.02);
}

TEST(EvidenceMap, WithinFindsWhatLiesNear) {
    const EvidenceMap map = filled(drive(6, true), every_scan());
    const Point center(1.0F, 0.5F, 1.0F);
    std::vector<std::uint32_t> found = map.grid().within(center, 4.0F), expected;
    for (std::uint32_t v = 0; v < map.grid().voxels().size(); ++v) {
        if ((map.grid()[v].centroid - center).norm() <= 4.0F) expected.push_back(v);
    }
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, expected);
    EXPECT_GT(found.size(), 100U);
    EXPECT_LT(found.size(), map.grid().voxels().size() / 2);
}

TEST(EvidenceMap, WhatIsKeptIsAsItWasAndGoesOnAsItWouldHave) {
    const auto scans = drive(12, true);
    EvidenceMap whole(every_scan()), part(every_scan());
    StageTimes times;
    const auto insert = [&](EvidenceMap& map, std::size_t i) {
        map.insert(scans[i].scan, times);
        map.observe_elsewhere(times);
    };
    for (std::size_t i = 0; i < 8; ++i) {
        insert(whole, i);
        insert(part, i);
    }
    const std::size_t before = part.grid().voxels().size();
    const auto kept = part.keep_within(Point(0.0F, 0.25F, 1.25F), 5.0F, SIZE_MAX);
    EXPECT_EQ(part.grid().voxels().size(), kept.size());
    EXPECT_LT(kept.size(), before);
    for (std::size_t i = 8; i < scans.size(); ++i) {
        insert(whole, i);
        insert(part, i);
    }
    for (std::uint32_t v = 0; v < kept.size(); ++v) {
        EXPECT_EQ(part.grid().voxels().key(v), whole.grid().voxels().key(kept[v]));
        EXPECT_EQ(part.grid()[v].centroid, whole.grid()[kept[v]].centroid);
        EXPECT_EQ(part.grid()[v].evidence.n_occ, whole.grid()[kept[v]].evidence.n_occ) << v;
        EXPECT_EQ(part.grid()[v].evidence.n_free, whole.grid()[kept[v]].evidence.n_free) << v;
        EXPECT_EQ(part.grid()[v].evidence.last_owner, whole.grid()[kept[v]].evidence.last_owner)
            << v;
    }
    EXPECT_LE(part.keep_within(Point::Zero(), 100.0F, 300).size(), 400U);
    EXPECT_GT(part.grid().voxels().size(), 100U);
}

TEST(EvidenceMap, ScansWithoutMeasurementsChangeNothing) {
    const auto scans = drive(3, false);
    const test::RoomScan empty;
    test::RoomScan zeros;
    zeros.scan.points.assign(5, Point::Zero());
    const EvidenceMap plain = filled(scans, every_scan());
    const EvidenceMap mixed = filled({empty, scans[0], zeros, scans[1], scans[2]}, every_scan());
    ASSERT_EQ(plain.grid().voxels().size(), mixed.grid().voxels().size());
    for (std::uint32_t v = 0; v < plain.grid().voxels().size(); ++v) {
        EXPECT_EQ(probability_of(plain, v), probability_of(mixed, v));
    }
}

}  // namespace evidence_map_test
}  // namespace dynamic_filter
