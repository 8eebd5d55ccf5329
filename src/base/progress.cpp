// SPDX-License-Identifier: MIT
#include "base/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <ctime>

#include "base/say.hpp"

namespace dynamic_filter::app {

namespace {

volatile std::sig_atomic_t signal_seen = 0, later_one_kills = 1;
timespec first_signal{};

/// `timeout`, supervisors and terminals signal a process and then its whole group: what comes
/// within half a second is one wish, not two.
constexpr double kOneWish = 0.5;

extern "C" void note_signal(int number) {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    if (signal_seen == 0) {
        first_signal = now;
        signal_seen = number;
        return;
    }
    const double since = static_cast<double>(now.tv_sec - first_signal.tv_sec) +
                         1e-9 * static_cast<double>(now.tv_nsec - first_signal.tv_nsec);
    if (since < kOneWish || later_one_kills == 0) return;
    std::signal(number, SIG_DFL);
    raise(number);  // delivered when this handler returns
}

std::string clock_text(double seconds) {
    const auto whole = static_cast<long>(seconds);
    return fmt::format("{:02}:{:02}", whole / 60, whole % 60);
}

}  // namespace

Progress::Progress(std::string verb, std::size_t total, bool quiet)
    : verb_(std::move(verb)), total_(total), quiet_(quiet), terminal_(isatty(STDERR_FILENO) != 0) {}

Progress::~Progress() {
    if (!quiet_ && terminal_ && done_ > 0) say(stderr, "\n");
}

void Progress::advance() {
    ++done_;
    if (quiet_) return;
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start_;
    const double seconds = passed.count();
    if (terminal_) {
        if (done_ < total_ && seconds - printed_at_ < 0.1) return;
        printed_at_ = seconds;
    } else {
        if (done_ < next_line_) return;
        // A log of a whole run is to fit on a screen.
        next_line_ = ((4 * done_ / total_ + 1) * total_ + 3) / 4;
    }
    print(seconds);
}

void Progress::print(double seconds) const {
    const double per_second = seconds > 0 ? static_cast<double>(done_) / seconds : 0.0;
    const double left = per_second > 0 ? static_cast<double>(total_ - done_) / per_second : 0.0;
    say(stderr, "{}{} {}/{} [{}<{}, {:.1f} scans/s]{}", terminal_ ? "\r" : "", verb_, done_, total_,
        clock_text(seconds), clock_text(left), per_second, terminal_ ? "\x1b[K" : "\n");
    std::fflush(stderr);
}

void catch_interrupts(bool a_later_one_kills) {
    signal_seen = 0;
    later_one_kills = a_later_one_kills ? 1 : 0;
    std::signal(SIGINT, note_signal);
    std::signal(SIGTERM, note_signal);
    std::signal(SIGHUP, note_signal);
    std::signal(SIGPIPE, SIG_IGN);  // a reader of our output that goes away stops nothing
}

bool interrupted() { return signal_seen != 0; }
bool terminated() { return signal_seen == SIGTERM; }

}  // namespace dynamic_filter::app
