// SPDX-License-Identifier: MIT
#include "dynamic_filter/scores.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <tuple>

namespace dynamic_filter::eval {
namespace voxel_scores_test {

constexpr Label kStill = Label::static_, kDynamic = Label::dynamic;

/// Middle of the n-th voxel of 0.2 m along x, and a little off it.
Point in_voxel(int n, float off = 0.0F) {
    return {0.2F * static_cast<float>(n) + 0.1F + off, 0.1F, 0.1F};
}

TEST(VoxelScore, IsWorkedByHand) {
    const VoxelScore s = voxel_score(10, 9, 5, 1);
    EXPECT_DOUBLE_EQ(*s.pr, 0.9);
    EXPECT_DOUBLE_EQ(*s.rr, 0.8);
    EXPECT_DOUBLE_EQ(*s.f1, 2 * 0.9 * 0.8 / 1.7);
}

TEST(VoxelScore, IsUndefinedWithoutVoxelsOfAKind) {
    EXPECT_FALSE(voxel_score(0, 0, 5, 1).pr);
    EXPECT_FALSE(voxel_score(0, 0, 5, 1).f1);
    EXPECT_FALSE(voxel_score(10, 9, 0, 0).rr);
    EXPECT_DOUBLE_EQ(*voxel_score(10, 0, 5, 5).f1, 0.0);
}

/// Voxel 0: 2 static, 1 kept. Voxel 1: 1 dynamic kept. Voxel 2: 1 dynamic removed.
/// Voxel 3: 2 static removed, 1 dynamic kept. Voxel 4: 1 static, 2 dynamic, all removed.
constexpr std::uint32_t kKept = 0, kRemoved = 1;  // by result 0

void add(VoxelTally& tally, const Point& point, Label truth, std::uint32_t removed) {
    const VoxelTally::TruePoint one{point, truth, removed};
    tally.add({&one, 1});
}

VoxelTally worked_example() {
    VoxelTally tally(0.2);
    add(tally, in_voxel(0, 0.05F), kStill, kKept);
    add(tally, in_voxel(0, -0.05F), kStill, kRemoved);
    add(tally, in_voxel(1), kDynamic, kKept);
    add(tally, in_voxel(2), kDynamic, kRemoved);
    add(tally, in_voxel(3), kStill, kRemoved);
    add(tally, in_voxel(3), kStill, kRemoved);
    add(tally, in_voxel(3), kDynamic, kKept);
    add(tally, in_voxel(4), kStill, kRemoved);
    add(tally, in_voxel(4), kDynamic, kRemoved);
    add(tally, in_voxel(4), kDynamic, kRemoved);
    return tally;
}

TEST(VoxelTally, ReadsMixedVoxelsAsNamed) {
    const auto scores = worked_example().scores();
    // Excluded: static {0}, kept; dynamic {1, 2}, 1 kept.
    EXPECT_DOUBLE_EQ(*scores.at("excluded").pr, 1.0);
    EXPECT_DOUBLE_EQ(*scores.at("excluded").rr, 0.5);
    // Static wins: static {0, 3, 4}, 0 and 3 hold a kept point; dynamic {1, 2}.
    EXPECT_DOUBLE_EQ(*scores.at("static_wins").pr, 2.0 / 3.0);
    EXPECT_DOUBLE_EQ(*scores.at("static_wins").rr, 0.5);
    // Majority: static {0, 3}, dynamic {1, 2, 4}.
    EXPECT_DOUBLE_EQ(*scores.at("majority").pr, 1.0);
    EXPECT_DOUBLE_EQ(*scores.at("majority").rr, 1.0 - 1.0 / 3.0);
}

TEST(VoxelTally, DynamicShareCountsVoxelsWithAnyMovingPoint) {
    EXPECT_EQ(worked_example().dynamic_voxels(), 4U);
    EXPECT_EQ(worked_example().voxels(), 5U);
    EXPECT_EQ(VoxelTally(0.2).voxels(), 0U);
}

TEST(VoxelTally, AMapMadeElsewherePreservesTheVoxelsItHasPointsIn) {
    VoxelTally tally(0.2);
    for (int n = 0; n < 4; ++n) add(tally, in_voxel(n), n < 2 ? kStill : kDynamic, kRemoved);
    tally.add_map_point(in_voxel(0, 0.09F));
    tally.add_map_point(in_voxel(3, -0.09F));
    tally.add_map_point(in_voxel(50));  // where the raw map has nothing
    const auto scores = tally.scores();
    EXPECT_DOUBLE_EQ(*scores.at("excluded").pr, 0.5);
    EXPECT_DOUBLE_EQ(*scores.at("excluded").rr, 0.5);
}

/// A slow, plain re-count of the four readings.
struct Plain {
    struct Voxel {
        int still = 0, dynamic = 0, kept = 0;
    };
    std::map<std::tuple<int, int, int>, Voxel> voxels;

    void add(const Point& p, Label truth, bool kept) {
        const auto cell = [](float v) { return static_cast<int>(std::floor(v / 0.2F)); };
        Voxel& v = voxels[{cell(p.x()), cell(p.y()), cell(p.z())}];
        (truth == kDynamic ? v.dynamic : v.still) += 1;
        v.kept += kept ? 1 : 0;
    }
    template <class IsStill, class Counts>
    VoxelScore score(IsStill is_still, Counts counts) const {
        double s = 0, sk = 0, d = 0, dk = 0;
        for (const auto& [key, v] : voxels) {
            if (!counts(v)) continue;
            (is_still(v) ? s : d) += 1;
            if (v.kept > 0) (is_still(v) ? sk : dk) += 1;
        }
        return voxel_score(s, sk, d, dk);
    }
};

void expect_equal(const VoxelScore& a, const VoxelScore& b) {
    EXPECT_DOUBLE_EQ(*a.pr, *b.pr);
    EXPECT_DOUBLE_EQ(*a.rr, *b.rr);
    EXPECT_DOUBLE_EQ(*a.f1, *b.f1);
}

TEST(VoxelTally, AShiftedGridCountsOtherVoxels) {
    VoxelTally aligned(0.2), shifted(0.2, 1, 0.1);
    // Voxels of the aligned grid end between the first two, those of the shifted grid between the
    // last two.
    const Point left(0.17F, 0.17F, 0.17F), middle(0.23F, 0.23F, 0.23F), right(0.33F, 0.33F, 0.33F);
    for (VoxelTally* tally : {&aligned, &shifted}) {
        add(*tally, left, kStill, kKept);
        add(*tally, middle, kDynamic, kKept);
        add(*tally, right, kDynamic, kRemoved);
    }
    EXPECT_EQ(aligned.voxels(), 2U);
    EXPECT_EQ(shifted.voxels(), 2U);
    EXPECT_DOUBLE_EQ(*aligned.scores().at("excluded").rr, 0.0);  // the middle one stays
    EXPECT_DOUBLE_EQ(*shifted.scores().at("excluded").rr, 1.0);  // it is in a mixed voxel
    EXPECT_FALSE(shifted.scores().at("excluded").pr);
}

TEST(VoxelTally, ResultsBesideEachOtherScoreAsAlone) {
    std::mt19937 random(3);
    VoxelTally both(0.2, 2), first(0.2), second(0.2);
    for (int i = 0; i < 3000; ++i) {
        const auto at = [&] { return static_cast<float>(random() % 1000) / 500.0F; };
        const Point p(at(), at(), at());
        const Label truth = random() % 3 == 0 ? kDynamic : kStill;
        const std::uint32_t a = random() % 4 == 0 ? 1 : 0, b = random() % 2 == 0 ? 1 : 0;
        add(both, p, truth, a | b << 1U);
        add(first, p, truth, a);
        add(second, p, truth, b);
    }
    for (const auto& [reading, score] : first.scores()) {
        EXPECT_EQ(both.scores(0).at(reading).f1, score.f1) << reading;
        EXPECT_EQ(both.scores(1).at(reading).f1, second.scores().at(reading).f1) << reading;
    }
    EXPECT_NE(both.scores(0).at("excluded").f1, both.scores(1).at("excluded").f1);
}

TEST(VoxelTally, AgreesWithAPlainCountOnRandomPoints) {
    std::mt19937 random(7);
    // Multiples of 1/64, so that no point sits on the border of a 0.2 m voxel but 0 itself.
    const auto coordinate = [&] { return (static_cast<float>(random() % 256) - 127.5F) / 64.0F; };
    VoxelTally tally(0.2);
    Plain plain;
    for (int i = 0; i < 5000; ++i) {
        const Point p(coordinate(), coordinate(), coordinate());
        const Label truth = random() % 3 == 0 ? kDynamic : kStill;
        const bool kept = random() % 4 != 0;
        add(tally, p, truth, kept ? kKept : kRemoved);
        plain.add(p, truth, kept);
    }
    const auto scores = tally.scores();
    const auto all = [](const Plain::Voxel&) { return true; };
    expect_equal(scores.at("excluded"),
                 plain.score([](const auto& v) { return v.dynamic == 0; },
                             [](const auto& v) { return v.still == 0 || v.dynamic == 0; }));
    expect_equal(scores.at("static_wins"),
                 plain.score([](const auto& v) { return v.still > 0; }, all));
    expect_equal(scores.at("majority"),
                 plain.score([](const auto& v) { return v.still >= v.dynamic; }, all));
}

}  // namespace voxel_scores_test
}  // namespace dynamic_filter::eval
