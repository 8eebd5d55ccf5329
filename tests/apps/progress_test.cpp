// SPDX-License-Identifier: MIT
#include "progress.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <thread>

namespace dynamic_filter::app {
namespace {

/// In a process of its own, because signals stay caught.
TEST(CatchInterrupts, TheFirstIsNotedAndALaterOneKills) {
    EXPECT_FALSE(interrupted());
    for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
        // Twice at once, as `timeout` does: the process, then its group.
        const auto at_once = [=] {
            catch_interrupts();
            std::raise(number);
            std::raise(number);
        };
        const auto later = [=] {
            at_once();
            std::this_thread::sleep_for(std::chrono::milliseconds(600));
            std::raise(number);
        };
        EXPECT_EXIT((at_once(), std::exit(interrupted() ? 7 : 1)), testing::ExitedWithCode(7), "");
        EXPECT_EXIT(later(), testing::KilledBySignal(number), "");
    }
}

}  // namespace
}  // namespace dynamic_filter::app
