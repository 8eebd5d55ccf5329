// SPDX-License-Identifier: MIT
#include "base/stage_clock.hpp"

#include <gtest/gtest.h>

#include <thread>

namespace dynamic_filter::app {
namespace stage_clock_test {

TEST(StageClock, StagesFollowEachOtherFromTheBeginningOfTheProcess) {
    StageClock clock;
    clock.finish("first");
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
    clock.finish("second");
    ASSERT_EQ(clock.stages().size(), 2U);
    EXPECT_EQ(clock.stages()[1].name, "second");
    EXPECT_GE(clock.stages()[1].seconds.wall, 0.03);
    Seconds sum;
    for (const StageClock::Stage& stage : clock.stages()) {
        EXPECT_GE(stage.seconds.wall, 0.0);
        EXPECT_GE(stage.seconds.cpu, 0.0);
        sum.wall += stage.seconds.wall, sum.cpu += stage.seconds.cpu;
    }
    EXPECT_NEAR(clock.total().wall, sum.wall, 1e-9);
    EXPECT_NEAR(clock.total().cpu, sum.cpu, 1e-9);
}

// A clock also counts the time before it was made.
TEST(StageClock, CountsTheWholeProcess) {
    StageClock early, late;
    early.finish("all");
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    late.finish("all");
    EXPECT_GE(late.total().wall, early.total().wall + 0.02);
}

// No waiting: time of the processor is of this program alone.
TEST(StageClock, SleepingCostsNoProcessorTime) {
    StageClock clock;
    clock.finish("before");
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    clock.finish("asleep");
    EXPECT_LT(clock.stages()[1].seconds.cpu, 0.04);
}

}  // namespace stage_clock_test
}  // namespace dynamic_filter::app
