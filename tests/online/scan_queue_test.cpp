// SPDX-License-Identifier: MIT
#include "online/scan_queue.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace dynamic_filter {
namespace scan_queue_test {

Scan scan(double stamp, double x = 0.0, std::size_t index = 0) {
    Scan s{{Point(1, 0, 0)}, Pose::Identity(), stamp, index};
    s.T_world_sensor.translation().x() = x;
    return s;
}

void add(ScanQueue& queue, const Scan& s) {
    ASSERT_FALSE(queue.refusal(s)) << s.stamp;
    queue.add({.scan = s, .reply = nullptr});
}

std::optional<NoticeKind> refused(const ScanQueue& queue, const Scan& s) {
    const auto notice = queue.refusal(s);
    return notice ? std::optional(notice->kind) : std::nullopt;
}

TEST(ScanQueue, GivesScansInTheOrderOfTheirStamps) {
    ScanQueue queue;
    for (const double stamp : {0.3, 0.1, 0.4, 0.2}) add(queue, scan(stamp));
    for (const double stamp : {0.1, 0.2, 0.3, 0.4}) EXPECT_EQ(queue.pop().scan.stamp, stamp);
}

TEST(ScanQueue, WhatIsOlderThanAScanInWorkIsLate) {
    ScanQueue queue;
    add(queue, scan(0.2));
    queue.pop();
    EXPECT_EQ(refused(queue, scan(0.1)), NoticeKind::late);
    EXPECT_FALSE(refused(queue, scan(0.3)));
}

// Messages of two sensors may be on their way for different times.
TEST(ScanQueue, ALaterScanOfAnotherSensorMakesNothingLate) {
    ScanQueue queue;
    Scan rear = scan(0.2);
    rear.sensor = 1;
    add(queue, rear);
    queue.pop();
    EXPECT_FALSE(refused(queue, scan(0.1)));
    rear.stamp = 0.1;
    EXPECT_EQ(refused(queue, rear), NoticeKind::late);
}

TEST(ScanQueue, ANewStretchBeginsWhereItIsWanted) {
    ScanQueue queue;
    add(queue, scan(0.1));
    queue.begin_anew();
    add(queue, scan(0.2));
    add(queue, scan(0.3));
    const QueuedScan before = queue.pop(), first = queue.pop(), second = queue.pop();
    EXPECT_FALSE(before.was_wanted);
    EXPECT_TRUE(first.was_wanted);
    EXPECT_NE(first.stretch, before.stretch);
    EXPECT_FALSE(second.was_wanted);
    EXPECT_EQ(second.stretch, first.stretch);
}

TEST(ScanQueue, PassesAScanThatIsJudgedAtOnceOrSaysWhyNot) {
    ScanQueue queue;
    const auto first = queue.pass(scan(5.0));
    ASSERT_TRUE(std::holds_alternative<QueuedScan>(first));
    EXPECT_EQ(std::get<QueuedScan>(first).scan.stamp, 5.0);
    const auto late = queue.pass(scan(4.5));
    ASSERT_TRUE(std::holds_alternative<Notice>(late));
    EXPECT_EQ(std::get<Notice>(late).kind, NoticeKind::late);
    const auto restarted = queue.pass(scan(1.0));
    ASSERT_TRUE(std::holds_alternative<QueuedScan>(restarted));
    EXPECT_NE(std::get<QueuedScan>(restarted).stretch, std::get<QueuedScan>(first).stretch);
    EXPECT_EQ(queue.size(), 0U);
}

TEST(ScanQueue, ADroppedScanMakesNothingLate) {
    ScanQueue queue;
    add(queue, scan(0.2));
    queue.drop();
    EXPECT_FALSE(refused(queue, scan(0.1)));
}

TEST(ScanQueue, TheSameStampTwiceIsADuplicateButForAnotherSensor) {
    ScanQueue queue;
    add(queue, scan(0.1));
    EXPECT_EQ(refused(queue, scan(0.1)), NoticeKind::duplicate);
    add(queue, scan(0.1, 0.5));  // another pose at the same time: another sensor
    queue.pop();
    EXPECT_EQ(refused(queue, scan(0.1)), NoticeKind::duplicate);
    queue.pop();
    EXPECT_EQ(refused(queue, scan(0.1, 0.5)), NoticeKind::duplicate);
}

TEST(ScanQueue, StampsThatGoBackByMoreThanASecondBeginAnew) {
    ScanQueue queue;
    add(queue, scan(100.0));
    add(queue, scan(100.1));
    add(queue, scan(3.0));
    add(queue, scan(3.1));
    const QueuedScan first = queue.pop();
    EXPECT_EQ(first.scan.stamp, 100.0);
    EXPECT_EQ(queue.pop().stretch, first.stretch);
    const QueuedScan anew = queue.pop();
    EXPECT_EQ(anew.scan.stamp, 3.0);
    EXPECT_EQ(anew.stretch, first.stretch + 1);
    EXPECT_EQ(queue.pop().stretch, anew.stretch);
    EXPECT_EQ(refused(queue, scan(3.05)), NoticeKind::late);
}

TEST(ScanQueue, RefusesWhatIsNoPoseOrNoTime) {
    const ScanQueue queue;
    EXPECT_EQ(refused(queue, scan(std::nan(""))), NoticeKind::invalid);
    EXPECT_EQ(refused(queue, scan(INFINITY)), NoticeKind::invalid);
    EXPECT_EQ(refused(queue, scan(0.0, std::nan(""))), NoticeKind::invalid);
    Scan scaled = scan(0.0);
    scaled.T_world_sensor.linear() *= 1.1;
    EXPECT_EQ(refused(queue, scaled), NoticeKind::invalid);
    Scan mirrored = scan(0.0);
    mirrored.T_world_sensor.linear()(0, 0) = -1.0;
    EXPECT_EQ(refused(queue, mirrored), NoticeKind::invalid);
}

}  // namespace scan_queue_test
}  // namespace dynamic_filter
