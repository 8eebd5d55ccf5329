// SPDX-License-Identifier: MIT
#include "dynamic_filter/parallel.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <stdexcept>
#include <thread>

namespace dynamic_filter {
namespace parallel_test {

/// The most bodies that ran at the same time, each lingering a little.
int most_at_once() {
    std::atomic<int> running{0}, most{0};
    parallel_for(64, 1, [&](std::size_t, std::size_t) {
        const int now = ++running;
        int seen = most.load();
        while (seen < now && !most.compare_exchange_weak(seen, now)) {
        }
        std::this_thread::sleep_for(std::chrono::microseconds(200));
        --running;
    });
    return most.load();
}

TEST(ParallelFor, CoversTheRangeExactlyOnce) {
    for (const std::size_t count : {0u, 1u, 2u, 7u, 1000u, 100003u}) {
        for (const std::size_t grain : {0u, 1u, 3u, 4096u, 1000000u}) {
            const auto visits = std::make_unique<std::atomic<int>[]>(count);
            std::atomic<bool> empty_range{false};
            parallel_for(count, grain, [&](std::size_t begin, std::size_t end) {
                if (begin >= end || end > count) empty_range = true;
                for (std::size_t i = begin; i < end; ++i) ++visits[i];
            });
            EXPECT_FALSE(empty_range);
            for (std::size_t i = 0; i < count; ++i)
                ASSERT_EQ(visits[i], 1) << count << " " << grain;
        }
    }
}

TEST(ParallelFor, RangesAreNotMuchSmallerThanTheGrain) {
    std::atomic<std::size_t> smallest{1000000};
    parallel_for(100000, 1000, [&](std::size_t begin, std::size_t end) {
        std::size_t seen = smallest.load();
        while (end - begin < seen && !smallest.compare_exchange_weak(seen, end - begin)) {
        }
    });
    EXPECT_GE(smallest.load(), 500U);
}

TEST(ParallelFor, RethrowsWhatTheBodyThrows) {
    for (const int threads : {1, 2}) {
        with_threads(threads, [] {
            EXPECT_THROW(parallel_for(1000, 1,
                                      [](std::size_t begin, std::size_t end) {
                                          if (begin <= 500 && 500 < end) {
                                              throw std::out_of_range("500");
                                          }
                                      }),
                         std::out_of_range);
        });
    }
}

TEST(ParallelFor, NestsWithoutDeadlock) {
    std::atomic<int> sum{0};
    parallel_for(8, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            parallel_for(8, 1,
                         [&](std::size_t b, std::size_t e) { sum += static_cast<int>(e - b); });
        }
    });
    EXPECT_EQ(sum, 64);
}

TEST(WithThreads, OneMeansOneThreadAtATime) {
    with_threads(1, [] { EXPECT_EQ(most_at_once(), 1); });
}

TEST(WithThreads, NoMoreRunAtOnceThanAsked) {
    for (const int threads : {2, 3}) {
        with_threads(threads, [&] { EXPECT_LE(most_at_once(), threads); });
    }
}

TEST(WithThreads, ZeroMeansAllCores) {
    with_threads(0, [] { EXPECT_LE(most_at_once(), available_threads()); });
}

TEST(WithThreads, TheInnerLimitHoldsAndTheOuterOneComesBack) {
    with_threads(1, [] {
        with_threads(2, [] { EXPECT_LE(most_at_once(), 2); });
        EXPECT_EQ(most_at_once(), 1);
    });
}

TEST(WithThreads, RunsTheWorkOnceAndRethrows) {
    int runs = 0;
    with_threads(2, [&] { ++runs; });
    EXPECT_EQ(runs, 1);
    EXPECT_THROW(with_threads(2, [] { throw std::out_of_range("x"); }), std::out_of_range);
}

TEST(AvailableThreads, IsAtLeastOne) { EXPECT_GE(available_threads(), 1); }

}  // namespace parallel_test
}  // namespace dynamic_filter
