// SPDX-License-Identifier: MIT
#include "dynamic_filter/filter.hpp"

#include <gtest/gtest.h>

namespace dynamic_filter {
namespace map_contents_test {

TEST(MapContents, AddsUpCountsAndKeepsTheNewestBeamPattern) {
    MapContents all, first, second;
    first.observer = second.observer = "keyframes";
    first.observers = 3, second.observers = 4;
    first.voxels = 10, second.voxels = 20;
    first.beams = BeamPattern{0.1F, 0.2F};
    first.keyframes = {0, 5}, second.keyframes = {9};
    first.throughput = {{"judge", "scans", 7}, {"integrate", "scans", 6}};
    second.throughput = {{"judge", "scans", 2}, {"integrate", "scans", 1}};
    all.add(first);
    all.add(second);
    EXPECT_EQ(all.observer, "keyframes");
    EXPECT_EQ(all.observers, 7U);
    EXPECT_EQ(all.voxels, 30U);
    EXPECT_EQ(all.beams->azimuth_spacing, 0.1F);
    EXPECT_EQ(all.keyframes, (std::vector<std::size_t>{0, 5, 9}));
    ASSERT_EQ(all.throughput.size(), 2U);
    EXPECT_EQ(all.throughput[0].count, 9U);
    EXPECT_EQ(all.throughput[1].count, 7U);
}

}  // namespace map_contents_test
}  // namespace dynamic_filter
