// SPDX-License-Identifier: MIT
#include "dynamic_filter/scores.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <random>
#include <vector>

#include "dynamic_filter/error.hpp"

namespace dynamic_filter::eval {
namespace scores_test {

constexpr Label kStill = Label::static_, kDynamic = Label::dynamic, kUnknown = Label::unknown;

std::vector<LabelledScan> random_scans() {
    std::mt19937 random(11);
    const auto coordinate = [&] { return static_cast<float>(random() % 1000) / 1000.0F; };
    std::vector<LabelledScan> scans(5);
    for (LabelledScan& scan : scans) {
        for (int i = 0; i < 400; ++i) {
            scan.points.emplace_back(coordinate(), coordinate(), coordinate());
            scan.truth.push_back(random() % 5 == 0   ? kUnknown
                                 : random() % 2 == 0 ? kDynamic
                                                     : kStill);
            scan.verdict.push_back(random() % 6 == 0   ? kUnknown
                                   : random() % 2 == 0 ? kDynamic
                                                       : kStill);
        }
    }
    return scans;
}

ScanSource source_of(const std::vector<LabelledScan>& scans) {
    return [&scans](std::size_t i) { return std::optional(scans[i]); };
}

/// SA and DA by comparing every ground-truth point with every point of the clean map.
PointScore plain_point_score(const std::vector<LabelledScan>& scans, const Points& map) {
    CoverCount count;
    for (const LabelledScan& scan : scans) {
        for (std::size_t i = 0; i < scan.points.size(); ++i) {
            if (scan.truth[i] == kUnknown) continue;
            bool covered = false;
            for (const Point& m : map)
                covered |= (m - scan.points[i]).squaredNorm() <= 0.05F * 0.05F;
            const bool dynamic = scan.truth[i] == kDynamic;
            (dynamic ? count.dynamic : count.still) += 1;
            if (covered) (dynamic ? count.covered_dynamic : count.covered_still) += 1;
        }
    }
    return point_score(count);
}

Points clean_map(const std::vector<LabelledScan>& scans) {
    Points map;
    for (const LabelledScan& scan : scans) {
        for (std::size_t i = 0; i < scan.points.size(); ++i) {
            if (scan.truth[i] != kUnknown && scan.verdict[i] != kDynamic)
                map.push_back(scan.points[i]);
        }
    }
    return map;
}

TEST(ScoreLabels, CoverAgreesWithBruteForce) {
    const auto scans = random_scans();
    const Scores scores = score_labels(scans.size(), source_of(scans), 0.2);
    const PointScore plain = plain_point_score(scans, clean_map(scans));
    EXPECT_DOUBLE_EQ(*scores.point.sa, *plain.sa);
    EXPECT_DOUBLE_EQ(*scores.point.da, *plain.da);
    EXPECT_LT(*scores.point.da, 1.0);
    EXPECT_GT(*scores.point.da, 0.0);
}

TEST(ScoreMap, OfTheKeptPointsAgreesWithScoreLabels) {
    const auto scans = random_scans();
    const Scores by_labels = score_labels(scans.size(), source_of(scans), 0.2);
    const Scores by_map = score_map(scans.size(), source_of(scans), clean_map(scans), 0.2);
    EXPECT_DOUBLE_EQ(*by_map.point.sa, *by_labels.point.sa);
    EXPECT_DOUBLE_EQ(*by_map.point.da, *by_labels.point.da);
    EXPECT_FALSE(by_map.point.iou);
    for (const char* reading : {"excluded", "static_wins", "majority"}) {
        EXPECT_EQ(by_map.voxel.at(reading).f1, by_labels.voxel.at(reading).f1) << reading;
        EXPECT_EQ(by_map.voxel_shifted.at(reading).f1, by_labels.voxel_shifted.at(reading).f1)
            << reading;
    }
}

TEST(ScoreLabels, TheShiftedGridIsThatOfScansMovedByHalfAVoxel) {
    const auto scans = random_scans();
    auto moved = scans;
    for (LabelledScan& scan : moved) {
        for (Point& p : scan.points) p -= Point::Constant(0.1F);
    }
    const Scores both = score_labels(scans.size(), source_of(scans), 0.2);
    const Scores of_moved = score_labels(moved.size(), source_of(moved), 0.2);
    for (const char* reading : {"excluded", "static_wins", "majority"}) {
        EXPECT_EQ(both.voxel_shifted.at(reading).f1, of_moved.voxel.at(reading).f1) << reading;
        EXPECT_NE(both.voxel_shifted.at(reading).f1, both.voxel.at(reading).f1) << reading;
    }
    EXPECT_TRUE(ScanScores(0.2, 1).scores(0).voxel_shifted.empty());  // nobody asked for it
}

TEST(ScanScores, ResultsBesideEachOtherScoreAsAlone) {
    const auto scans = random_scans();
    auto others = scans;  // another result on the same scans
    for (LabelledScan& scan : others) {
        for (Label& label : scan.verdict) label = label == kDynamic ? kStill : kDynamic;
    }
    ScanScores both(0.2, 2);
    const auto verdicts = [&](std::size_t i) {
        return std::array<const Labels*, 2>{&scans[i].verdict, &others[i].verdict};
    };
    for (std::size_t i = 0; i < scans.size(); ++i) both.add(scans[i], verdicts(i));
    for (std::size_t i = scans.size(); i-- > 0;) {  // in any order
        both.add_near(both.near_removed(scans[i], verdicts(i)));
    }
    for (std::size_t r = 0; r < 2; ++r) {
        const Scores alone = score_labels(scans.size(), source_of(r == 0 ? scans : others), 0.2);
        const Scores beside = both.scores(r);
        EXPECT_EQ(beside.point.aa, alone.point.aa);
        EXPECT_EQ(beside.point.iou, alone.point.iou);
        EXPECT_EQ(beside.voxel.at("majority").f1, alone.voxel.at("majority").f1);
    }
    EXPECT_NE(both.scores(0).point.iou, both.scores(1).point.iou);
}

TEST(ScoreLabels, AnyNumberOfScansIsReadEachOnceAndInOrder) {
    const auto few = random_scans();
    for (const std::size_t count : {1U, 15U, 16U, 17U, 33U}) {
        std::vector<int> reads(count);
        const ScanSource source = [&](std::size_t i) {
            ++reads.at(i);
            LabelledScan scan = few[i % few.size()];
            for (Point& p : scan.points) p.x() += 10.0F * static_cast<float>(i);  // apart
            return std::optional(scan);
        };
        const Scores scores = score_labels(count, source, 0.2);
        EXPECT_EQ(std::count(reads.begin(), reads.end(), reads.front()),
                  static_cast<std::ptrdiff_t>(count));
        ScanScores beside(0.2, 1);
        for (std::size_t i = 0; i < count; ++i) {
            const LabelledScan scan = *source(i);
            const std::array<const Labels*, 1> verdict{&scan.verdict};
            beside.add(scan, verdict);
            beside.add_near(beside.near_removed(scan, verdict));
        }
        EXPECT_EQ(scores.point.iou, beside.scores(0).point.iou) << count;
    }
}

// Removed points of two results lie in the same cell, or in cells that share an edge.
TEST(ScanScores, EachResultHasItsOwnRemovedPlaces) {
    const Point kept(1.0F, 1.0F, 1.0F);
    for (const float dx : {0.02F, -0.04F, 0.049F}) {
        for (const float dy : {0.0F, 0.01F}) {
            LabelledScan scan{{kept, kept + Point(dx, dy, 0.0F), kept + Point(dx, 0.0F, dy)},
                              Labels(3, kStill),
                              {}};
            const Labels first{kStill, kDynamic, kStill}, second{kStill, kStill, kDynamic};
            ScanScores both(0.2, 2);
            const std::array<const Labels*, 2> verdicts{&first, &second};
            both.add(scan, verdicts);
            both.add_near(both.near_removed(scan, verdicts));
            // The kept point is near to each removed one, so all static points are covered.
            EXPECT_EQ(both.scores(0).point.sa, 1.0);
            EXPECT_EQ(both.scores(1).point.sa, 1.0);
        }
    }
}

TEST(ScoreLabels, RefusesArraysThatAreNotParallel) {
    const Points points(3, Point(1, 2, 3));
    const Labels two(2, Label::static_), three(3, Label::static_);
    for (const LabelledScan& scan : {LabelledScan{points, two, three}, {points, three, two}}) {
        const auto source = [&](std::size_t) { return std::optional(scan); };
        EXPECT_THROW(score_labels(1, source, 0.2), Error);
        EXPECT_THROW(score_map(1, source, points, 0.2), Error);
    }
}

TEST(ScoreLabels, PerfectVerdictsScoreOne) {
    auto scans = random_scans();
    for (LabelledScan& scan : scans) {
        scan.verdict = scan.truth;
        // Apart, so that no removed point lies near a kept one.
        for (std::size_t i = 0; i < scan.points.size(); ++i) {
            if (scan.truth[i] == kDynamic) scan.points[i].x() += 5.0F;
        }
    }
    const Scores scores = score_labels(scans.size(), source_of(scans), 0.2);
    EXPECT_DOUBLE_EQ(*scores.voxel.at("excluded").f1, 1.0);
    EXPECT_DOUBLE_EQ(*scores.point.aa, 1.0);
    EXPECT_DOUBLE_EQ(*scores.point.iou, 1.0);
}

TEST(ScoreLabels, LeavesOutUnknownTruthMissingScansAndPointsThatAreNotFinite) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const LabelledScan scan{{{0, 0, 0.1F}, {1, 0, 0.1F}, {nan, 0, 0}},
                            {kUnknown, kStill, kDynamic},
                            {kDynamic, kStill, kStill}};
    const ScanSource source = [&](std::size_t i) {
        return i == 0 ? std::optional(scan) : std::nullopt;
    };
    const Scores scores = score_labels(2, source, 0.2);
    EXPECT_DOUBLE_EQ(*scores.voxel.at("excluded").pr, 1.0);
    EXPECT_FALSE(scores.voxel.at("excluded").rr);
    EXPECT_DOUBLE_EQ(*scores.point.sa, 1.0);
    EXPECT_FALSE(scores.point.da);
    EXPECT_DOUBLE_EQ(scores.dynamic_share, 0.0);
}

// Areas that have no voxel in common, and no points near each other.
TEST(ScoreSums, OfTwoAreasAddUpToThoseOfBoth) {
    const auto row = [](float y, std::size_t seed) {
        LabelledScan scan;
        for (std::size_t i = 0; i < 500; ++i) {
            scan.points.emplace_back(0.07F * static_cast<float>(i), y, 0.1F);
            scan.truth.push_back(i % (3 + seed) == 0 ? Label::dynamic : Label::static_);
            scan.verdict.push_back(i % (4 + seed) == 0 ? Label::dynamic : Label::static_);
        }
        return scan;
    };
    const std::vector<LabelledScan> scans{row(0.1F, 0), row(50.1F, 1)};
    const auto sums_of = [](const std::vector<LabelledScan>& some) {
        ScanScores scores(0.2, 1);
        for (const auto& scan : some) scores.add(scan, std::array{&scan.verdict});
        for (const auto& scan : some) {
            scores.add_near(scores.near_removed(scan, std::array{&scan.verdict}));
        }
        return scores.sums(0);
    };
    ScoreSums sum = sums_of({scans[0]});
    sum.add(sums_of({scans[1]}));
    const Scores parts = sum.scores(), whole = sums_of(scans).scores();
    for (const auto& [reading, score] : whole.voxel) {
        EXPECT_EQ(parts.voxel.at(reading).pr, score.pr) << reading;
        EXPECT_EQ(parts.voxel.at(reading).rr, score.rr) << reading;
        EXPECT_EQ(parts.voxel.at(reading).f1, score.f1) << reading;
    }
    EXPECT_EQ(parts.point.sa, whole.point.sa);
    EXPECT_EQ(parts.point.da, whole.point.da);
    EXPECT_EQ(parts.point.iou, whole.point.iou);
    EXPECT_EQ(parts.dynamic_share, whole.dynamic_share);
    EXPECT_GT(whole.dynamic_share, 0.0);
}

}  // namespace scores_test
}  // namespace dynamic_filter::eval
