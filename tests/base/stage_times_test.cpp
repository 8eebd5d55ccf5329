// SPDX-License-Identifier: MIT
#include "dynamic_filter/stage_times.hpp"

#include <gtest/gtest.h>

namespace dynamic_filter {
namespace stage_times_test {

TEST(Durations, AllCallsCountTheNewestRank) {
    Durations calls;
    EXPECT_EQ(calls.quantile(0.5), 0.0);
    calls.add(1000.0);
    for (std::size_t i = 0; i < Durations::kNewest; ++i) calls.add(static_cast<double>(i % 101));
    EXPECT_EQ(calls.count(), Durations::kNewest + 1);
    EXPECT_EQ(calls.max(), 1000.0);
    EXPECT_EQ(calls.quantile(1.0), 100.0);  // the first call is forgotten
    EXPECT_NEAR(calls.quantile(0.5), 50.0, 1.0);
    EXPECT_EQ(calls.quantile(0.0), 0.0);
}

TEST(Durations, AddUp) {
    Durations a, b;
    for (int i = 1; i <= 3; ++i) a.add(i);
    for (int i = 4; i <= 5; ++i) b.add(i);
    a.add(b);
    EXPECT_EQ(a.count(), 5U);
    EXPECT_EQ(a.total(), 15.0);
    EXPECT_EQ(a.max(), 5.0);
    EXPECT_EQ(a.quantile(0.5), 3.0);
}

TEST(Timed, NotesTheCallEvenIfItThrows) {
    StageTimes times;
    EXPECT_EQ(timed(times, "work", [] { return 7; }), 7);
    EXPECT_THROW(timed(times, "work", []() -> int { throw 1; }), int);
    EXPECT_EQ(times.at("work").count(), 2U);
}

}  // namespace stage_times_test
}  // namespace dynamic_filter
