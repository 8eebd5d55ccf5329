// SPDX-License-Identifier: MIT
#include "base/progress.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <string>
#include <thread>

namespace dynamic_filter::app {
namespace progress_test {

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

TEST(Progress, ALogHasFiveLinesOfAStageWhateverItsLength) {
    for (const std::size_t total : {3U, 4U, 10U, 323U, 30000U}) {
        testing::internal::CaptureStderr();
        {
            Progress progress("filter", total, false);
            for (std::size_t i = 0; i < total; ++i) progress.advance();
        }
        const std::string log = testing::internal::GetCapturedStderr();
        const auto lines = static_cast<std::size_t>(std::count(log.begin(), log.end(), '\n'));
        EXPECT_EQ(lines, std::min<std::size_t>(total, 5)) << log;
        const std::string last = std::to_string(total) + "/" + std::to_string(total);
        EXPECT_NE(log.find("filter " + last), std::string::npos) << log;
    }
}

}  // namespace progress_test
}  // namespace dynamic_filter::app
