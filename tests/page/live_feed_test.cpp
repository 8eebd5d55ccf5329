// SPDX-License-Identifier: MIT
#include "page/live_feed.hpp"

#include <gtest/gtest.h>

#include <cstring>

namespace dynamic_filter::app {
namespace live_feed_test {

template <class T>
T at(const std::string& bytes, std::size_t offset) {
    T value;
    std::memcpy(&value, bytes.data() + offset, sizeof value);
    return value;
}

std::vector<std::string> records_in(const std::string& bytes) {
    std::vector<std::string> records;
    for (std::size_t begin = 0; begin < bytes.size();) {
        const auto size = at<std::uint32_t>(bytes, begin);
        records.push_back(bytes.substr(begin, size));
        begin += size;
    }
    return records;
}

Pose at_x(double x) {
    Pose pose = Pose::Identity();
    pose.translation() = Eigen::Vector3d(x, 5.0, 0.0);
    return pose;
}

TEST(LiveFeed, ARecordHoldsTheScan) {
    LiveFeed feed;
    const Points points = {{1.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 0.0F}, {0.0F, 2.0F, 0.5F}};
    feed.expect(points, at_x(100.0), 1.0, 3);
    feed.judged(3, {Label::static_, Label::unknown, Label::dynamic});
    feed.expect(points, at_x(101.0), 1.5, 4);
    feed.judged(4, {Label::unknown, Label::unknown, Label::dynamic});
    const auto records = records_in(feed.after(0));
    ASSERT_EQ(records.size(), 2U);
    const std::string& r = records[1];
    EXPECT_EQ(r.size() % 4, 0U);
    EXPECT_EQ(at<std::uint32_t>(r, 4), 2U);   // number
    EXPECT_EQ(at<std::uint32_t>(r, 8), 1U);   // kind
    EXPECT_EQ(at<std::uint32_t>(r, 12), 4U);  // index
    EXPECT_EQ(at<double>(r, 16), 1.5);        // stamp
    EXPECT_EQ(at<float>(r, 24), 1.0F);        // the sensor has moved by a metre
    EXPECT_EQ(at<float>(r, 28), 0.0F);
    EXPECT_EQ(at<std::uint32_t>(r, 36), 0U);  // static
    EXPECT_EQ(at<std::uint32_t>(r, 40), 1U);  // dynamic
    EXPECT_EQ(at<std::uint32_t>(r, 44), 2U);  // unknown
    ASSERT_EQ(at<std::uint32_t>(r, 48), 2U);  // what was measured
    EXPECT_EQ(at<float>(r, 52), 2.0F);
    EXPECT_EQ(at<float>(r, 64 + 4), 2.0F);                         // y of the second point
    EXPECT_EQ(at<std::uint8_t>(r, 76), 3U << 2U);                  // unknown, no truth
    EXPECT_EQ(at<std::uint8_t>(r, 77), 2U | 3U << 2U | 2U << 4U);  // dynamic
    EXPECT_EQ(records_in(feed.after(1)).size(), 1U);
    EXPECT_TRUE(feed.after(2).empty());
    EXPECT_TRUE(feed.after(77).empty());
}

TEST(LiveFeed, ACorrectionIsOfTheSamePoints) {
    LiveFeed feed;
    Points points;
    for (int i = 1; i <= 20000; ++i) points.emplace_back(static_cast<float>(i), 0.0F, 0.0F);
    feed.expect(points, at_x(0.0), 0.0, 9);
    feed.judged(9, Labels(points.size(), Label::static_));
    Labels final(points.size(), Label::static_);
    for (std::size_t i = 10000; i < final.size(); ++i) final[i] = Label::dynamic;
    feed.corrected(9, points, final);
    const auto records = records_in(feed.after(0));
    ASSERT_EQ(records.size(), 2U);
    const auto n = at<std::uint32_t>(records[0], 48);
    EXPECT_NEAR(n, 5000, 300);
    ASSERT_EQ(at<std::uint32_t>(records[1], 16), n);
    for (std::uint32_t i = 0; i < n; ++i) {
        const bool dynamic = at<float>(records[0], 52 + 12 * i) > 10000.5F;
        EXPECT_EQ(at<std::uint8_t>(records[1], 20 + i) & 3U, dynamic ? 2U : 1U);
    }
}

TEST(LiveFeed, WhatWasDroppedIsForgotten) {
    LiveFeed feed;
    const Points points = {{1.0F, 0.0F, 0.0F}};
    feed.expect(points, at_x(0.0), 0.0, 1);
    feed.expect(points, at_x(0.0), 0.1, 2);
    feed.judged(2, {Label::static_});
    feed.judged(1, {Label::static_});
    feed.judged(7, {Label::static_});
    EXPECT_EQ(records_in(feed.after(0)).size(), 1U);
}

TEST(LiveFeed, MemoryIsBoundedAndAnswersAreSmall) {
    LiveFeed feed;
    const Points points(5000, Point::UnitX());
    const Labels labels(points.size(), Label::static_);
    for (std::size_t i = 0; i < 2500; ++i) {  // some 65 KB each
        feed.expect(points, at_x(0.0), 0.0, i);
        feed.judged(i, labels);
    }
    std::size_t bytes = 0;
    std::uint32_t number = 0, first = 0;
    while (true) {
        const std::string some = feed.after(number);
        if (some.empty()) break;
        EXPECT_LE(some.size(), std::size_t{1} << 20U);
        const auto records = records_in(some);
        if (first == 0) first = at<std::uint32_t>(records.front(), 4);
        number = at<std::uint32_t>(records.back(), 4);
        bytes += some.size();
    }
    EXPECT_EQ(number, feed.newest());
    EXPECT_EQ(number, 2500U);
    EXPECT_GT(first, 1000U);
    EXPECT_LE(bytes, std::size_t{64} << 20U);
}

}  // namespace live_feed_test
}  // namespace dynamic_filter::app
