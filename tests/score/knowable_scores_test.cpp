// SPDX-License-Identifier: MIT
#include "score/knowable_scores.hpp"

#include <gtest/gtest.h>

#include <map>
#include <string>

namespace dynamic_filter::eval {
namespace knowable_scores_test {

constexpr Label kStill = Label::static_, kDynamic = Label::dynamic, kUnknown = Label::unknown;

struct Case {
    LabelledScan scan;
    std::vector<KnowablePoint> knowable;

    /// A point in the voxel of that number, along x.
    void add(int voxel, Label truth, Label verdict, KnowablePoint what = {}) {
        scan.points.emplace_back(0.2F * static_cast<float>(voxel) + 0.1F, 0.1F, 0.1F);
        scan.truth.push_back(truth);
        scan.verdict.push_back(verdict);
        knowable.push_back(what);
    }
};

KnowableScores scores_of(const std::vector<Case>& scans) {
    return score_knowable(
        scans.size(), [&](std::size_t i) { return std::optional(scans[i].scan); },
        [&](std::size_t i, std::size_t points) {
            EXPECT_EQ(points, scans[i].knowable.size());
            return scans[i].knowable;
        },
        0.2);
}

/// points / removed points / voxels / removed voxels
std::string text(const Removed& r) {
    return std::to_string(r.points) + "/" + std::to_string(r.removed_points) + "/" +
           std::to_string(r.voxels) + "/" + std::to_string(r.removed_voxels);
}

std::map<std::string, std::string> by_name(const KnowableScores& scores) {
    std::map<std::string, std::string> out;
    const auto groups = knowable_groups();
    for (std::size_t g = 0; g < groups.size(); ++g) {
        out[groups[g].name] = text(scores.groups[g]);
    }
    return out;
}

TEST(KnowableScores, CountsByBeamsAndByState) {
    Case a, b;
    a.add(0, kDynamic, kDynamic, {0, ThingState::moves, true});
    a.add(1, kDynamic, kStill, {2, ThingState::never, false});
    b.add(2, kDynamic, kDynamic, {9, ThingState::moved, true});
    b.add(3, kDynamic, kDynamic, {10, ThingState::never, false});
    b.add(4, kDynamic, kUnknown, {300, ThingState::will_move, true});
    const KnowableScores scores = scores_of({a, b});
    EXPECT_EQ(by_name(scores), (std::map<std::string, std::string>{{"all", "5/3/5/3"},
                                                                   {"beams_1", "4/2/4/2"},
                                                                   {"beams_3", "3/2/3/2"},
                                                                   {"beams_10", "2/1/2/1"},
                                                                   {"moves", "1/1/1/1"},
                                                                   {"moved", "1/1/1/1"},
                                                                   {"will_move", "1/0/1/0"},
                                                                   {"never", "2/1/2/1"},
                                                                   {"knowable", "4/3/4/3"}}));
    std::vector<std::string> bins;
    for (const Removed& bin : scores.bins) bins.push_back(text(bin));
    EXPECT_EQ(bins, (std::vector<std::string>{"1/1/1/1", "1/0/1/0", "1/1/1/1", "1/1/1/1", "0/0/0/0",
                                              "1/0/1/0"}));
}

TEST(KnowableScores, MixedVoxelsAreLeftOutAndTheirPointsAreNot) {
    Case a;
    a.add(0, kDynamic, kDynamic, {5, ThingState::moves, true});
    a.add(0, kStill, kStill);
    a.add(1, kStill, kDynamic);
    EXPECT_EQ(by_name(scores_of({a})).at("all"), "1/1/0/0");
}

TEST(KnowableScores, AVoxelIsRemovedIfAllOfItsPointsAre) {
    Case a, b;
    a.add(0, kDynamic, kDynamic, {5, ThingState::moves, true});
    b.add(0, kDynamic, kStill, {5, ThingState::moves, true});
    EXPECT_EQ(by_name(scores_of({a, b})).at("moves"), "2/1/1/0");
}

TEST(KnowableScores, AVoxelHasTheStateThatTellsLeast) {
    Case a;
    a.add(0, kDynamic, kDynamic, {2, ThingState::moves, true});
    a.add(0, kDynamic, kDynamic, {2, ThingState::never, false});
    const auto groups = by_name(scores_of({a}));
    EXPECT_EQ(groups.at("moves"), "1/1/0/0");
    EXPECT_EQ(groups.at("never"), "1/1/1/1");
    EXPECT_EQ(groups.at("knowable"), "1/1/0/0");
}

TEST(KnowableScores, PointsWithoutTruthAreLeftOut) {
    Case a;
    a.add(0, kUnknown, kStill);
    a.add(0, kDynamic, kDynamic, {5, ThingState::moves, true});
    const KnowableScores scores = scores_of({a});
    EXPECT_EQ(by_name(scores).at("all"), "1/1/1/1");
    EXPECT_DOUBLE_EQ(scores.groups[0].rr().value(), 1.0);
    EXPECT_DOUBLE_EQ(scores.groups[0].point_share().value(), 1.0);
    EXPECT_FALSE(scores.bins[0].rr().has_value());
}

}  // namespace knowable_scores_test
}  // namespace dynamic_filter::eval
