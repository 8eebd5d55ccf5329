// SPDX-License-Identifier: MIT
#include "dynamic_filter/back_end/evidence_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include <cmath>
#include <numeric>

#include "dynamic_filter/front_end/window.hpp"
#include "pipeline/room.hpp"

namespace dynamic_filter {
namespace {

using test::drive;

Config every_scan() {
    Config config;
    config.submap.keyframe_interval = 0.0;
    return config;
}

EvidenceMap filled(const std::vector<test::RoomScan>& scans, const Config& config) {
    EvidenceMap map(config);
    StageTimes times;
    for (const auto& s : scans) {
        map.insert(s.scan, times);
        map.look_at_rest(times);
    }
    return map;
}

std::optional<float> probability_of(const EvidenceMap& map, std::uint32_t voxel) {
    return map.probabilities({&voxel, 1})[0];
}

/// What asking all keyframes about a place, oldest first, gives.
Evidence brute_force(const std::vector<test::RoomScan>& scans, const Point& place,
                     const BeamPattern& beams, const Config& config) {
    Evidence e;
    const Scan* last = nullptr;
    for (const auto& s : scans) {
        if (last != nullptr && !is_keyframe(*last, s.scan, config.submap)) continue;
        last = &s.scan;
        Directions seen;
        to_spherical(std::span(&place, 1), s.scan.T_world_sensor.inverse().cast<float>(), seen);
        std::vector<Sight> sights;
        look(BeamImage(s.scan.points, beams), seen, SightMargins{}, sights);
        record(e, sights.at(0));
    }
    return e;
}

TEST(EvidenceMap, EqualsAskingEveryKeyframeAboutEveryVoxel) {
    const auto scans = drive(9, true);
    Config some_scans;
    some_scans.submap.keyframe_interval = 1.0;  // every second scan
    some_scans.submap.keyframe_distance = 100.0;
    for (const Config& config : {every_scan(), some_scans}) {
        const EvidenceMap map = filled(scans, config);
        ASSERT_GT(map.voxels().size(), 1000U);
        for (std::uint32_t v = 0; v < map.voxels().size(); v += 7) {
            const Evidence expected = brute_force(scans, map.centroid(v), *map.beams(), config);
            EXPECT_EQ(map.evidence(v).seen, expected.seen) << v;
            EXPECT_EQ(map.evidence(v).passed, expected.passed) << v;
            EXPECT_EQ(map.evidence(v).switches, expected.switches) << v;
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
        if (pack(*cell_of(at, 5.0F)) != map.voxels().key(voxel)) continue;
        sum += at.cast<double>();
        ++count;
    }
    ASSERT_GT(count, 0);
    EXPECT_LT((map.centroid(voxel).cast<double>() - sum / count).norm(), 1e-5);
}

TEST(EvidenceMap, AFewPointsAtFirstDoNotDecideHowTheSensorLooks) {
    auto scans = drive(4, false);
    test::RoomScan few = scans[0];
    few.scan.points = {{1.0F, 0.0F, 0.0F}, {0.0F, 1.0F, 0.0F}};
    EXPECT_FALSE(filled({few}, every_scan()).beams());
    scans.insert(scans.begin(), few);
    const auto beams = filled(scans, every_scan()).beams();
    ASSERT_TRUE(beams);
    EXPECT_NEAR(beams->azimuth_spacing, 1.5 * M_PI / 180.0, 0.002);
}

TEST(EvidenceMap, LargeVoxelsKeepTheirCorners) {
    Config config = every_scan();
    config.back_end.voxel_size = 1.0;
    const EvidenceMap map = filled(drive(12, false), config);
    for (std::uint32_t v = 0; v < map.voxels().size(); ++v) {
        EXPECT_GE(probability_of(map, v).value_or(1.0F), 0.5F) << map.centroid(v).transpose();
    }
}

TEST(EvidenceMap, KnowsWhichScansOwnAVoxel) {
    const auto scans = drive(5, false);
    const EvidenceMap map = filled({scans[0], scans[0], scans[0]}, every_scan());
    for (std::uint32_t v = 0; v < map.voxels().size(); ++v) {
        EXPECT_EQ(map.evidence(v).owned, 3);
        EXPECT_EQ(map.evidence(v).first_owner, 0U);
        EXPECT_EQ(map.evidence(v).last_owner, 2U);
    }
}

TEST(EvidenceMap, ForgetsOnlyTheKeyframesBeyondItsMemory) {
    const auto scans = drive(6, true);
    Config config = every_scan();
    config.back_end.max_scans = 2;
    const EvidenceMap map = filled(scans, config);
    std::size_t asked_few = 0;
    for (std::uint32_t v = 0; v < map.voxels().size(); ++v) {
        const Evidence& e = map.evidence(v);
        const std::size_t scans_after = scans.size() - e.first_owner;
        EXPECT_LE(static_cast<std::size_t>(e.seen + e.passed), scans_after + 1);
        asked_few += e.first_owner == 5 ? 1 : 0;
    }
    EXPECT_GT(asked_few, 0U);
    EXPECT_EQ(map.observers(), scans.size());
}

// Keyframes that are not asked are stood for by those that are: the counts come out much the same.
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
    for (std::uint32_t v = 0; v < map.voxels().size(); ++v) {
        const Evidence& e = map.evidence(v);
        if (e.first_owner != 199 || e.passed == 0) continue;
        EXPECT_NEAR(e.passed, 199, 20) << v;
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
    for (std::uint32_t v = 0; v < map.voxels().size(); v += 3) some.push_back(v);
    const auto seen_through = map.seen_through(some);
    ASSERT_EQ(seen_through.size(), some.size());
    std::size_t passes = 0;
    for (std::size_t i = 0; i < some.size(); ++i) {
        EXPECT_EQ(seen_through[i].size(), map.evidence(some[i]).passed) << some[i];
        EXPECT_TRUE(std::is_sorted(seen_through[i].begin(), seen_through[i].end()));
        for (const std::size_t index : seen_through[i]) EXPECT_GE(index, 100U);
        passes += seen_through[i].size();
    }
    EXPECT_GT(passes, 50U);
    EXPECT_EQ(map.keyframes().size(), scans.size());
    EXPECT_EQ(map.keyframes().front(), 100U);
    EXPECT_EQ(map.index_of_owner(map.evidence(some.back()).first_owner), 108U);
}

TEST(EvidenceMap, WithinFindsWhatLiesNear) {
    const EvidenceMap map = filled(drive(6, true), every_scan());
    const Point center(1.0F, 0.5F, 1.0F);
    std::vector<std::uint32_t> found = map.within(center, 4.0F), expected;
    for (std::uint32_t v = 0; v < map.voxels().size(); ++v) {
        if ((map.centroid(v) - center).norm() <= 4.0F) expected.push_back(v);
    }
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, expected);
    EXPECT_GT(found.size(), 100U);
    EXPECT_LT(found.size(), map.voxels().size() / 2);
}

TEST(EvidenceMap, WhatIsKeptIsAsItWasAndGoesOnAsItWouldHave) {
    const auto scans = drive(12, true);
    EvidenceMap whole(every_scan()), part(every_scan());
    StageTimes times;
    const auto insert = [&](EvidenceMap& map, std::size_t i) {
        map.insert(scans[i].scan, times);
        map.look_at_rest(times);
    };
    for (std::size_t i = 0; i < 8; ++i) {
        insert(whole, i);
        insert(part, i);
    }
    const std::size_t before = part.voxels().size();
    const auto kept = part.keep_within(Point(0.0F, 0.25F, 1.25F), 5.0F, SIZE_MAX);
    EXPECT_EQ(part.voxels().size(), kept.size());
    EXPECT_LT(kept.size(), before);
    for (std::size_t i = 8; i < scans.size(); ++i) {
        insert(whole, i);
        insert(part, i);
    }
    for (std::uint32_t v = 0; v < kept.size(); ++v) {
        EXPECT_EQ(part.voxels().key(v), whole.voxels().key(kept[v]));
        EXPECT_EQ(part.centroid(v), whole.centroid(kept[v]));
        EXPECT_EQ(part.evidence(v).seen, whole.evidence(kept[v]).seen) << v;
        EXPECT_EQ(part.evidence(v).passed, whole.evidence(kept[v]).passed) << v;
        EXPECT_EQ(part.evidence(v).last_owner, whole.evidence(kept[v]).last_owner) << v;
    }
    EXPECT_LE(part.keep_within(Point::Zero(), 100.0F, 300).size(), 400U);
    EXPECT_GT(part.voxels().size(), 100U);
}

/// Own opinion, that of the company and that of the neighbourhood, by asking all voxels of the map.
float brute_force_probability(const EvidenceMap& map, std::uint32_t voxel) {
    const Evidence& own = map.evidence(voxel);
    const Cell home = unpack(map.voxels().key(voxel));
    double company = 0.0, companions = 0.25, around = 0.0, neighbors = 0.25;
    for (std::uint32_t v = 0; v < map.voxels().size(); ++v) {
        const int cells = (unpack(map.voxels().key(v)) - home).cwiseAbs().maxCoeff();
        if (v == voxel || cells > 2) continue;
        const double opinion = transience(map.evidence(v));
        const double together = co_presence(own, map.evidence(v));
        const double weight = cells == 1 ? 1.0 : 0.3;
        company += together * opinion, companions += together;
        around += weight * opinion, neighbors += weight;
    }
    const double sum = transience(own) + company / companions + 2.0 * around / neighbors;
    return static_cast<float>(1.0 / (1.0 + std::exp(3.0 * sum)));
}

TEST(EvidenceMap, ProbabilityAddsUpTheVoxelItsCompanyAndItsNeighborhood) {
    const EvidenceMap map = filled(drive(12, true), every_scan());
    std::vector<std::uint32_t> all(map.voxels().size());
    std::iota(all.begin(), all.end(), 0U);
    const auto together = map.probabilities(all);
    int compared = 0;
    for (std::uint32_t v = 0; v < map.voxels().size(); v += 11) {
        if (is_unknown(map.evidence(v))) continue;
        ASSERT_NEAR(*probability_of(map, v), brute_force_probability(map, v), 1e-5F) << v;
        ASSERT_EQ(probability_of(map, v), together[v]);  // whoever else is asked about
        ++compared;
    }
    EXPECT_GT(compared, 100);
}

TEST(EvidenceMap, ProbabilityIsUnknownUntilAnotherKeyframeLooked) {
    const auto scans = drive(2, false);
    const EvidenceMap one = filled({scans[0]}, every_scan());
    for (std::uint32_t v = 0; v < one.voxels().size(); ++v) EXPECT_FALSE(probability_of(one, v));
    const EvidenceMap two = filled({scans[0], scans[0]}, every_scan());
    for (std::uint32_t v = 0; v < two.voxels().size(); ++v) {
        ASSERT_EQ(probability_of(two, v).has_value(), !is_unknown(two.evidence(v)));
        EXPECT_GT(probability_of(two, v).value_or(1.0F), 0.5F);
    }
}

TEST(EvidenceMap, ScansWithoutMeasurementsChangeNothing) {
    const auto scans = drive(3, false);
    const test::RoomScan empty;
    test::RoomScan zeros;
    zeros.scan.points.assign(5, Point::Zero());
    const EvidenceMap plain = filled(scans, every_scan());
    const EvidenceMap mixed = filled({empty, scans[0], zeros, scans[1], scans[2]}, every_scan());
    ASSERT_EQ(plain.voxels().size(), mixed.voxels().size());
    for (std::uint32_t v = 0; v < plain.voxels().size(); ++v) {
        EXPECT_EQ(probability_of(plain, v), probability_of(mixed, v));
    }
}

}  // namespace
}  // namespace dynamic_filter
