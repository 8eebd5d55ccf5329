// SPDX-License-Identifier: MIT
#include "paper/back_thread.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <stdexcept>
#include <vector>

#include "dynamic_filter/parallel.hpp"

namespace dynamic_filter {
namespace back_thread_test {

TEST(BackThread, DoesEveryJobInOrder) {
    BackThread thread;
    std::vector<int> done, all;
    for (int n = 0; n < 500; ++n) {
        thread.add([&done, n] { done.push_back(n); });
        all.push_back(n);
    }
    thread.wait();
    EXPECT_EQ(done, all);
}

TEST(BackThread, TheCallerIsNeverFarAhead) {
    BackThread thread;
    std::atomic<int> ahead{0}, most{0};
    for (int n = 0; n < 200; ++n) {
        thread.add([&] { --ahead; });
        most = std::max(most.load(), ++ahead);
    }
    thread.wait();
    EXPECT_LE(most, 3);
    EXPECT_EQ(ahead, 0);
}

TEST(BackThread, WhatWasAddedIsDoneWhenItEnds) {
    std::vector<int> done;
    {
        BackThread thread;
        for (int n = 0; n < 3; ++n) thread.add([&done, n] { done.push_back(n); });
    }
    EXPECT_EQ(done.size(), 3U);
}

TEST(BackThread, WhatAJobThrowsComesToTheCallerAndEndsTheWork) {
    BackThread thread;
    std::vector<int> done;
    thread.add([] { throw std::runtime_error("first"); });
    EXPECT_THROW(thread.wait(), std::runtime_error);
    EXPECT_THROW(thread.add([&] { done.push_back(1); }), std::runtime_error);
    EXPECT_THROW(thread.wait(), std::runtime_error);
    EXPECT_TRUE(done.empty());
}

TEST(BackThread, AJobUsesTheCallersNumberOfThreads) {
    BackThread thread;
    int threads = 0;
    with_threads(1, [&] { thread.add([&] { threads = current_threads(); }); });
    thread.wait();
    EXPECT_EQ(threads, 1);
}

}  // namespace back_thread_test
}  // namespace dynamic_filter
