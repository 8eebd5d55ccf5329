// SPDX-License-Identifier: MIT
/// @file
/// Wall-clock time per call of each stage; it is written to timing.json.
///
/// - Units: [s].
/// - Shapes: one Durations per stage.
/// - Ownership: values, copied; timed() borrows its arguments.
/// - Threads: single caller.
/// - Errors: none of its own.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace dynamic_filter {

/// Wall-clock time since `start` [s].
inline double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Durations of many calls in bounded memory. Sums and the maximum cover all calls; quantiles cover
/// the newest kNewest calls.
class Durations {
public:
    static constexpr std::size_t kNewest = 4096;  ///< number of calls that quantiles cover

    /// Reserves memory for one more call, so that the next add() allocates nothing.
    void make_room() {
        if (newest_.size() < newest_.capacity()) return;
        newest_.reserve(std::min(2 * newest_.size() + 16, kNewest));
    }
    /// Adds one call [s].
    void add(double seconds) {
        keep(seconds);
        ++count_;
        total_ += seconds;
        max_ = std::max(max_, seconds);
    }
    /// Adds all calls of another object.
    void add(const Durations& other) {
        for (const double seconds : other.newest_) keep(seconds);
        count_ += other.count_;
        total_ += other.total_;
        max_ = std::max(max_, other.max_);
    }
    [[nodiscard]] std::size_t count() const { return count_; }  ///< number of calls
    [[nodiscard]] double total() const { return total_; }       ///< [s] sum of all calls
    [[nodiscard]] double max() const { return max_; }           ///< [s] longest call
    /// The quantile [s] of the newest calls; `share` is 0..1. Returns 0 if there was no call.
    [[nodiscard]] double quantile(double share) const {
        if (newest_.empty()) return 0.0;
        std::vector<double> calls = newest_;
        const auto rank =
            static_cast<std::ptrdiff_t>(share * static_cast<double>(calls.size() - 1));
        std::nth_element(calls.begin(), calls.begin() + rank, calls.end());
        return calls[static_cast<std::size_t>(rank)];
    }

private:
    void keep(double seconds) {
        if (newest_.size() < kNewest) {
            newest_.push_back(seconds);
        } else {
            newest_[oldest_++ % kNewest] = seconds;
        }
    }
    std::vector<double> newest_;
    std::size_t oldest_ = 0, count_ = 0;
    double total_ = 0.0, max_ = 0.0;
};

using StageTimes = std::map<std::string, Durations>;  ///< keys are the names of the stages

/// Runs `work`, adds its duration to the stage, and returns its result. Single caller per `times`.
template <class F>
decltype(auto) timed(StageTimes& times, const std::string& stage, F&& work) {
    struct Note {
        Durations& durations;
        std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
        ~Note() { durations.add(seconds_since(start)); }
    };
    Durations& durations = times[stage];
    durations.make_room();  // so that the destructor below cannot throw
    const Note note{durations};
    return std::forward<F>(work)();
}

}  // namespace dynamic_filter
