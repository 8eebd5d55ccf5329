// SPDX-License-Identifier: MIT
#include "live/diagnosis.hpp"

#include <gtest/gtest.h>

namespace dynamic_filter::live {
namespace diagnosis_test {

Figures healthy() {
    Figures figures;
    figures.cloud = "/points";
    figures.poses = "poses from /tf";
    figures.silence = 0.1;
    figures.intake = {
        .received = 100, .taken = 90, .malformed = 1, .without_pose = 5, .overrun = 2};
    figures.filter = {.in = 90, .processed = 80, .dropped = 7, .rejected = 1, .queued = 2};
    return figures;
}

std::vector<int> levels(const Figures& now, const Figures& before) {
    std::vector<int> levels;
    for (const auto& row : diagnose(now, before, "filter", 2.0)) levels.push_back(row.level);
    return levels;
}

TEST(Diagnosis, WhatOnceWasIsNoWarningNow) {
    EXPECT_EQ(levels(healthy(), healthy()), (std::vector<int>{0, 0, 0, 0}));
    EXPECT_EQ(levels(healthy(), {}), (std::vector<int>{2, 1, 0, 0}));
}

TEST(Diagnosis, SilenceIsStale) {
    Figures now = healthy();
    now.silence = 3.0;
    const auto rows = diagnose(now, now, "filter", 2.0);
    EXPECT_EQ(rows[0].level, 3);
    EXPECT_EQ(rows[0].name, "filter: input");
    EXPECT_EQ(rows[0].message, "no scan for 3 s");
    now.silence.reset();
    EXPECT_EQ(diagnose(now, now, "filter", 2.0)[0].message, "no scan yet");
}

TEST(Diagnosis, ALostOdometryIsAnError) {
    Figures now = healthy();
    now.odometry = {.good = 10, .weak = 0, .lost = 1, .last = TrackStatus::lost};
    EXPECT_EQ(levels(now, now), (std::vector<int>{0, 2, 0, 0}));
    now.odometry.last = TrackStatus::weak;
    EXPECT_EQ(levels(now, now), (std::vector<int>{0, 1, 0, 0}));
}

TEST(Diagnosis, AnAlarmOfTheResultIsAnError) {
    Figures now = healthy();
    now.alarm = "31 of 50 scans lose more than 15 % of their ground, up to 63 %";
    EXPECT_EQ(levels(now, now), (std::vector<int>{0, 0, 2, 0}));
    EXPECT_EQ(diagnose(now, now, "filter", 2.0)[2].message, now.alarm);
}

TEST(Diagnosis, SlowReceiversAreAWarning) {
    Figures now = healthy();
    now.not_taken = 3;
    EXPECT_EQ(levels(now, healthy()), (std::vector<int>{0, 0, 0, 1}));
}

TEST(Diagnosis, TheClosingTableAddsUp) {
    const std::string text = to_text(healthy());
    EXPECT_NE(
        text.find("100 scans received; 90 taken, 5 without a pose, 1 not readable, 2 dropped, 2 "
                  "waiting"),
        std::string::npos)
        << text;
    EXPECT_NE(text.find("80 judged, 7 dropped, 1 rejected, 2 waiting"), std::string::npos);
}

}  // namespace diagnosis_test
}  // namespace dynamic_filter::live
