// SPDX-License-Identifier: MIT
#include "progress.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>

namespace dynamic_filter::app {
namespace {

/// In a process of its own, because signals stay caught.
TEST(CatchInterrupts, TheFirstIsNotedAndTheSecondKills) {
    EXPECT_FALSE(interrupted());
    for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
        const auto once = [=] {
            catch_interrupts();
            std::raise(number);
        };
        EXPECT_EXIT((once(), std::exit(interrupted() ? 7 : 1)), testing::ExitedWithCode(7), "");
        EXPECT_EXIT((once(), std::raise(number)), testing::KilledBySignal(number), "");
    }
}

}  // namespace
}  // namespace dynamic_filter::app
