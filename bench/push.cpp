// SPDX-License-Identifier: MIT
/// push RECORDING [keep]: measures the scans per second of OnlineFilter::ask() without reading.
/// bench/python_push.py compares with it. With `keep`, scans and their labels are kept, which a
/// user needs for corrections.
#include <fmt/format.h>

#include <chrono>
#include <deque>

#include "dynamic_filter/dynamic_filter.hpp"
#include "dynamic_filter/recording.hpp"

using namespace dynamic_filter;

namespace {

double scans_per_second(const std::vector<io::FullScan>& frames, bool keep) {
    std::deque<std::pair<Scan, Labels>> kept;
    OnlineFilter filter(preset("default"),
                        {.overload = Overload::wait, .horizon = 0.0, .max_bytes = 0});
    const auto start = std::chrono::steady_clock::now();
    for (std::size_t i = 0; i < frames.size(); ++i) {
        Scan scan{frames[i].points, frames[i].T_world_sensor, frames[i].stamp, i};
        if (keep) kept.emplace_back(scan, Labels());
        const std::optional<Verdict> verdict = filter.ask(std::move(scan));
        if (keep) kept.back().second = verdict->labels;
    }
    filter.flush();
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
    return static_cast<double>(frames.size()) / passed.count();
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 2) return 2;
    const bool keep = argc > 2;
    const io::Recording recording = io::open_recording(argv[1]);
    std::vector<io::FullScan> frames;
    for (std::size_t i = 0; i < recording.size(); ++i) {
        frames.push_back(recording.read(i));
    }
    // In the second run memory and threads exist already, as in Python.
    scans_per_second(frames, keep);
    fmt::print("{}\n", scans_per_second(frames, keep));
}
