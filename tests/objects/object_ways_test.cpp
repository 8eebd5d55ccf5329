// SPDX-License-Identifier: MIT
#include "objects/object_ways.hpp"

#include <gtest/gtest.h>

namespace dynamic_filter::app {
namespace object_ways_test {

TEST(ObjectWays, AreThoseOfTheBoxes) {
    ObjectWays ways;
    std::vector<ObjectBox> boxes;
    for (std::size_t i = 0; i < 40; ++i) {
        const double t = 0.3 * static_cast<double>(i), x = 4.0 * std::sin(t);
        KnownScan scan{.scan = i};
        for (const std::uint32_t object : {1U, 4U}) {
            const double size = 1.0 + 0.01 * static_cast<double>(i * object);
            boxes.push_back({object, i, t, {x, 2.0 * object, 0}, {size, 1, 2}, 0.0, {x, 0, 0}, 7});
            scan.objects.push_back({boxes.back()});
        }
        ways.add(scan);
    }
    const std::vector<ObjectSummary> summaries = summaries_of(boxes);
    const std::vector<ObjectWay> found = ways.take(10);
    ASSERT_EQ(found.size(), summaries.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_EQ(found[i].object, summaries[i].object);
        EXPECT_EQ(found[i].points, summaries[i].points);
        EXPECT_EQ(found[i].size, summaries[i].size);
        EXPECT_EQ(found[i].path, summaries[i].path);
        EXPECT_EQ(found[i].fastest, summaries[i].fastest);
        EXPECT_EQ(found[i].first, summaries[i].boxes.front()->scan);
        EXPECT_EQ(found[i].last, 39U);
        EXPECT_EQ(found[i].places.size(), summaries[i].boxes.size());
    }
    EXPECT_TRUE(ways.take(10).empty());
}

TEST(ObjectWays, KeepFewPlacesOfALongWay) {
    ObjectWays ways;
    for (std::size_t i = 0; i < 1000; ++i) {
        const auto t = static_cast<double>(i);
        ObjectBox box{1, i, t, {t, 0, 0}, {4, 2, 1.5}, 0.0, {1, 0, 0}, i == 700 ? 50U : 10U};
        KnownScan scan{.scan = i};
        scan.objects.push_back({box});
        if (i == 2) scan.objects.push_back({{2, i, t, {0, 0, 0}, {1, 1, 1}, 0.0, {0, 0, 0}, 5}});
        ways.add(scan);
    }
    const std::vector<ObjectWay> largest = ways.take(1);
    ASSERT_EQ(largest.size(), 1U);
    const ObjectWay& way = largest.front();
    EXPECT_EQ(way.object, 1U);
    EXPECT_EQ(way.nearest, 700U);
    EXPECT_EQ(way.last, 999U);
    EXPECT_NEAR(way.path, 999.0, 1e-9);
    ASSERT_LE(way.places.size(), 128U);
    ASSERT_GE(way.places.size(), 60U);
    const std::size_t step = way.places[1].scan - way.places[0].scan;
    for (std::size_t k = 0; k < way.places.size(); ++k) EXPECT_EQ(way.places[k].scan, k * step);
}

}  // namespace object_ways_test
}  // namespace dynamic_filter::app
