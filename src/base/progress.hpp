// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace dynamic_filter::app {

/// `verb n/N [elapsed<left, scans/s]`: one line rewritten on a terminal, ten plain lines otherwise.
/// Goes to stderr, so that stdout holds results only. Single caller.
class Progress {
public:
    Progress(std::string verb, std::size_t total, bool quiet = false);
    ~Progress();
    void advance();

private:
    void print(double seconds) const;

    std::string verb_;
    std::size_t total_, done_ = 0;
    bool quiet_, terminal_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    double printed_at_ = -1.0;
    std::size_t next_line_ = 0;
};

/// True once SIGINT, SIGTERM or SIGHUP has come since the last catch_interrupts(); another one half
/// a second later kills as usual, if that is wanted.
void catch_interrupts(bool a_later_one_kills = true);
bool interrupted();
bool terminated();  ///< interrupted by SIGTERM: a supervisor wants the process to end at once

}  // namespace dynamic_filter::app
