// SPDX-License-Identifier: MIT
#include "online/two_stages.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <optional>
#include <stdexcept>
#include <vector>

#include "dynamic_filter/error.hpp"

namespace dynamic_filter {
namespace two_stages_test {

/// Numbers to work on; what was done with them is noted in order.
struct Line {
    std::deque<int> waiting;
    std::vector<int> first_did, second_did;
    std::function<void(int)> in_first = [](int) {}, in_second = [](int) {};
    int gave_up = 0;

    [[nodiscard]] TwoStages::Hooks hooks() {
        return {.take =
                    [this] {
                        const int n = waiting.front();
                        waiting.pop_front();
                        return TwoStages::Job([this, n]() -> TwoStages::Rest {
                            in_first(n);
                            first_did.push_back(n);
                            if (n < 0) return {};  // nothing left to do
                            return [this, n] {
                                in_second(n);
                                second_did.push_back(n);
                            };
                        });
                    },
                .has_job = [this] { return !waiting.empty(); },
                .give_up =
                    [this] {
                        waiting.clear();
                        ++gave_up;
                    },
                .around = [](const auto& work) { work(); }};
    }
};

void add(TwoStages& stages, Line& line, int n) {
    const auto hold = stages.lock();
    line.waiting.push_back(n);
    stages.changed();
}

TEST(TwoStages, BothDoEveryJobInOrder) {
    Line line;
    TwoStages stages(line.hooks());
    std::vector<int> all;
    for (int n = 0; n < 500; ++n) {
        add(stages, line, n);
        all.push_back(n);
    }
    const auto hold = stages.idle();
    EXPECT_EQ(line.first_did, all);
    EXPECT_EQ(line.second_did, all);
}

TEST(TwoStages, AJobMayLeaveNothingToTheSecond) {
    Line line;
    TwoStages stages(line.hooks());
    for (const int n : {1, -2, 3}) add(stages, line, n);
    const auto hold = stages.idle();
    EXPECT_EQ(line.first_did, (std::vector<int>{1, -2, 3}));
    EXPECT_EQ(line.second_did, (std::vector<int>{1, 3}));
}

TEST(TwoStages, TheFirstCanWaitUntilTheSecondHasNothingLeft) {
    Line line;
    std::optional<TwoStages> stages;
    std::atomic<int> ahead{0}, most{0};
    line.in_first = [&](int) {
        stages->wait_for_second(0);
        most = std::max(most.load(), ++ahead);
    };
    line.in_second = [&](int) { --ahead; };
    stages.emplace(line.hooks());
    for (int n = 0; n < 200; ++n) add(*stages, line, n);
    stages->idle();
    EXPECT_EQ(most, 1);
}

TEST(TwoStages, WhatTheFirstHasDoneIsFinishedWhenTheyStopAndNothingElseIsTaken) {
    Line line;
    TwoStages stages(line.hooks());
    for (int n = 0; n < 50; ++n) add(stages, line, n);
    stages.stop();
    stages.stop();
    EXPECT_EQ(line.first_did, line.second_did);
    EXPECT_TRUE(line.waiting.empty());
    EXPECT_GE(line.gave_up, 1);
}

TEST(TwoStages, WhatAStageThrowsComesToWhoeverWaits) {
    for (const bool in_second : {false, true}) {
        Line line;
        (in_second ? line.in_second : line.in_first) = [](int n) {
            if (n == 3) throw std::runtime_error("three");
        };
        TwoStages stages(line.hooks());
        for (int n = 0; n < 5; ++n) add(stages, line, n);
        EXPECT_THROW(stages.idle(), std::runtime_error);
        EXPECT_THROW(stages.idle(), std::runtime_error);
        auto hold = stages.lock();
        EXPECT_THROW(stages.rethrow(), std::runtime_error);
        stages.wait(hold, [] { return false; });  // ends, because a stage has failed
    }
}

TEST(TwoStages, TheOwnersOwnFailureIsRememberedToo) {
    Line line;
    TwoStages stages(line.hooks());
    stages.fail(std::make_exception_ptr(std::runtime_error("mine")));
    EXPECT_THROW(stages.idle(), std::runtime_error);
}

TEST(TwoStages, ItsOwnThreadsMustNotWaitForThemselves) {
    Line line;
    std::optional<TwoStages> stages;
    int refused = 0;
    const auto wait = [&](int) {
        try {
            stages->idle();
        } catch (const Error&) {
            ++refused;
        }
    };
    line.in_first = wait;
    line.in_second = wait;
    stages.emplace(line.hooks());
    add(*stages, line, 1);
    stages->idle();
    EXPECT_EQ(refused, 2);
    EXPECT_NO_THROW(stages->refuse_own_threads());
}

}  // namespace two_stages_test
}  // namespace dynamic_filter
