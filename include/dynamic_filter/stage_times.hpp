// SPDX-License-Identifier: MIT
/// @file
/// Wall time per call of each stage, for timing.json.
///
/// - Units: [s].
/// - Shapes: a Durations per stage.
/// - Ownership: values, copied; timed() borrows.
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

/// [s] of wall time.
inline double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Seconds of many calls, in bounded memory: all count towards the sums, the newest towards the
/// quantiles.
class Durations {
public:
    static constexpr std::size_t kNewest = 4096;  ///< calls that quantiles know

    /// For one call more, whose add() then needs no memory.
    void make_room() {
        if (newest_.size() < newest_.capacity()) return;
        newest_.reserve(std::min(2 * newest_.size() + 16, kNewest));
    }
    /// One call more [s].
    void add(double seconds) {
        keep(seconds);
        ++count_;
        total_ += seconds;
        max_ = std::max(max_, seconds);
    }
    /// The calls of another.
    void add(const Durations& other) {
        for (const double seconds : other.newest_) keep(seconds);
        count_ += other.count_;
        total_ += other.total_;
        max_ = std::max(max_, other.max_);
    }
    [[nodiscard]] std::size_t count() const { return count_; }  ///< calls
    [[nodiscard]] double total() const { return total_; }       ///< [s] of all calls
    [[nodiscard]] double max() const { return max_; }           ///< [s] of the longest
    /// [s] of the call below which that share, 0..1, of the newest calls lies. 0 if there was none.
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

using StageTimes = std::map<std::string, Durations>;  ///< by the stage's name

/// Runs `work`, notes how long it took, and hands on its result. Single caller per `times`.
template <class F>
decltype(auto) timed(StageTimes& times, const std::string& stage, F&& work) {
    struct Note {
        Durations& durations;
        std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
        ~Note() { durations.add(seconds_since(start)); }
    };
    Durations& durations = times[stage];
    durations.make_room();  // destructors must not throw
    const Note note{durations};
    return std::forward<F>(work)();
}

}  // namespace dynamic_filter
