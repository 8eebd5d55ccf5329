// SPDX-License-Identifier: MIT
/// Wall time per call of each stage, for timing.json.
#pragma once

#include <chrono>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace dynamic_filter {

/// Seconds of each call, by stage.
using StageTimes = std::map<std::string, std::vector<double>>;

/// Runs `work`, notes how long it took, and hands on its result. Single caller per `times`.
template <class F>
decltype(auto) timed(StageTimes& times, const std::string& stage, F&& work) {
    struct Note {
        std::vector<double>& seconds;
        std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
        ~Note() {
            const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
            seconds.push_back(passed.count());
        }
    } note{times[stage]};
    return std::forward<F>(work)();
}

}  // namespace dynamic_filter
