// SPDX-License-Identifier: MIT
#include "score/erasor_maps.hpp"

#include <gtest/gtest.h>

namespace dynamic_filter::eval {
namespace erasor_maps_test {

constexpr auto kStill = Label::static_, kDynamic = Label::dynamic, kUnknown = Label::unknown;

/// A point in voxel n of 0.2 m along x, off its middle along x.
Point in_voxel(int n, float off = 0.0F) {
    return {0.2F * static_cast<float>(n) + 0.1F + off, 0.1F, 0.1F};
}

ScanSource source_of(const std::vector<LabelledScan>& scans) {
    return [&scans](std::size_t i) { return std::optional(scans[i]); };
}

TEST(ErasorMaps, AThinnedMapHasTheMeanOfEachVoxelWithTheLabelOfTheNearestPoint) {
    const LabelledMap map{
        {in_voxel(0, -0.09F), in_voxel(0, 0.01F), in_voxel(0, 0.02F), in_voxel(7)},
        {kStill, kDynamic, kStill, kStill}};
    const LabelledMap out = thinned(map, 0.2);
    ASSERT_EQ(out.points.size(), 2U);
    EXPECT_NEAR(out.points[0].x(), 0.1F - 0.02F, 1e-6F);
    EXPECT_EQ(out.labels[0], kDynamic);  // 0.03 m away; two of three are static
    EXPECT_EQ(out.labels[1], kStill);
}

TEST(ErasorMaps, TheNearestPointMayLieInAnotherVoxel) {
    // The mean of voxel 0 is at its border, where the only near point is that of voxel 1.
    const LabelledMap map{{{0.19F, 0.01F, 0.1F}, {0.19F, 0.19F, 0.1F}, {0.205F, 0.1F, 0.1F}},
                          {kStill, kStill, kDynamic}};
    const LabelledMap out = thinned(map, 0.2);
    ASSERT_EQ(out.labels.size(), 2U);
    EXPECT_EQ(out.labels[0], kDynamic);
}

TEST(ErasorMaps, WorkedExample) {
    // Voxel:           0       10         20         30         31 (0.15 m before 30)   40
    // Truth:           static  dynamic    static     dynamic    static                 unknown
    // Verdict:         kept    kept       removed    removed    kept                   removed
    const std::vector<LabelledScan> scans = {
        {{in_voxel(0), in_voxel(10), in_voxel(20), in_voxel(30), in_voxel(31, -0.05F),
          in_voxel(40)},
         {kStill, kDynamic, kStill, kDynamic, kStill, kUnknown},
         {kStill, kUnknown, kDynamic, kDynamic, kStill, kDynamic}}};
    const VoxelTotals t = score_erasor(1, source_of(scans), 0.2);
    EXPECT_EQ(t.static_total, 3U);   // 0, 20, 31
    EXPECT_EQ(t.static_kept, 2U);    // not 20
    EXPECT_EQ(t.dynamic_total, 2U);  // 10, 30
    EXPECT_EQ(t.dynamic_kept, 1U);   // 10; beside 30 is a static point, which does not count
}

TEST(ErasorMaps, ScansAreThinnedBeforeTheyAreThinnedTogether) {
    // The first scan has three points at one place, which count once, as do those of the others:
    // the mean is 0.007 m off the middle, next to a static point. With all points it were -0.028 m.
    const std::vector<LabelledScan> scans = {
        {{in_voxel(0, -0.08F), in_voxel(0, -0.08F), in_voxel(0, -0.08F)},
         {kDynamic, kDynamic, kDynamic},
         {kDynamic, kDynamic, kDynamic}},
        {{in_voxel(0, 0.04F)}, {kStill}, {kStill}},
        {{in_voxel(0, 0.06F)}, {kStill}, {kStill}}};
    const VoxelTotals t = score_erasor(3, source_of(scans), 0.2);
    EXPECT_EQ(t.static_total, 1U);
    EXPECT_EQ(t.dynamic_total, 0U);
}

TEST(ErasorMaps, TheDistanceItselfIsTooFar) {
    const auto kept_at = [](float distance) {
        const std::vector<LabelledScan> scans = {{{in_voxel(0)}, {kStill}, {}}};
        const Points map = {in_voxel(0, distance)};
        return score_erasor(1, source_of(scans), map, 0.2).static_kept;
    };
    EXPECT_EQ(kept_at(0.1731F), 1U);
    EXPECT_EQ(kept_at(0.1733F), 0U);
}

TEST(ErasorMaps, AMapWithoutLabelsGetsThoseOfTheNearestTruePoints) {
    const std::vector<LabelledScan> scans = {
        {{in_voxel(0), in_voxel(10), in_voxel(20)}, {kStill, kDynamic, kStill}, {}}};
    const VoxelTotals t =
        score_erasor(1, source_of(scans), {in_voxel(0, 0.03F), in_voxel(10, 0.03F)}, 0.2);
    EXPECT_EQ(t.static_kept, 1U);
    EXPECT_EQ(t.dynamic_kept, 1U);
}

}  // namespace erasor_maps_test
}  // namespace dynamic_filter::eval
