// SPDX-License-Identifier: MIT
#include "base/stage_clock.hpp"

#include <unistd.h>

#include <ctime>
#include <fstream>
#include <sstream>

namespace dynamic_filter::app {

namespace {

double seconds_of(clockid_t clock) {
    timespec now{};
    clock_gettime(clock, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// [s] since the machine was started; field 22 of /proc/self/stat counts ticks, mostly of 10 ms.
double process_start() {
    std::ifstream file("/proc/self/stat");
    std::string line;
    std::getline(file, line);
    const std::size_t name_end = line.rfind(')');  // the name may hold spaces
    if (name_end == std::string::npos) return seconds_of(CLOCK_BOOTTIME);
    std::istringstream fields(line.substr(name_end + 1));
    std::string skipped;
    for (int field = 3; field < 22; ++field) fields >> skipped;
    double ticks = 0.0;
    fields >> ticks;
    return ticks / static_cast<double>(sysconf(_SC_CLK_TCK));
}

/// Since the process began.
Seconds now() {
    static const double start = process_start();
    return {seconds_of(CLOCK_BOOTTIME) - start, seconds_of(CLOCK_PROCESS_CPUTIME_ID)};
}

}  // namespace

void StageClock::finish(std::string name) {
    const Seconds end = now();
    stages_.push_back({std::move(name), {end.wall - last_.wall, end.cpu - last_.cpu}});
    last_ = end;
}

}  // namespace dynamic_filter::app
