// SPDX-License-Identifier: MIT
#include "base/say.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <csignal>

#include "dynamic_filter/error.hpp"

namespace dynamic_filter::app {
namespace say_test {

TEST(Say, FillsInValues) {
    std::array<char, 64> text{};
    std::FILE* const file = fmemopen(text.data(), text.size(), "w");
    say(file, "{} of {}\n", 3, "four");
    std::fclose(file);
    EXPECT_STREQ(text.data(), "3 of four\n");
}

TEST(Say, AReaderThatGoesAwayStopsNothing) {
    const auto before = std::signal(SIGPIPE, SIG_IGN);
    std::array<int, 2> ends{};
    ASSERT_EQ(pipe(ends.data()), 0);
    close(ends[0]);
    std::FILE* const file = fdopen(ends[1], "w");
    std::setvbuf(file, nullptr, _IONBF, 0);  // as stderr
    EXPECT_NO_THROW(say(file, "nobody listens to {}", 1));
    std::fclose(file);
    std::signal(SIGPIPE, before);
}

TEST(Say, AFullDiskIsAnError) {
    std::FILE* const file = std::fopen("/dev/full", "w");
    ASSERT_NE(file, nullptr);
    std::setvbuf(file, nullptr, _IONBF, 0);
    EXPECT_THROW(say(file, "text"), Error);
    std::fclose(file);
}

}  // namespace say_test
}  // namespace dynamic_filter::app
