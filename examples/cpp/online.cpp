// SPDX-License-Identifier: MIT
/// online RECORDING: the engine for a robot. push() returns at once; verdicts come to a callback,
/// and again, corrected, when later scans have said more.
#include <cstdio>
#include <dynamic_filter/dynamic_filter.hpp>
#include <dynamic_filter/recording.hpp>
#include <exception>
#include <map>
#include <mutex>

namespace df = dynamic_filter;

namespace {

void replay(const df::io::Recording& recording) {
    df::OnlineOptions options;
    options.settle_after = 10;                // scans until a verdict is corrected
    options.overload = df::Overload::wait;    // a robot keeps the default: drop the oldest
    std::map<std::size_t, df::Labels> first;  // until they are corrected
    std::size_t changed = 0;

    df::OnlineCallbacks callbacks;  // from the filter's threads, one of each kind at a time
    std::mutex lock;
    callbacks.instant = [&](const df::Verdict& verdict) {
        const std::lock_guard hold(lock);
        first[verdict.index] = verdict.labels;
    };
    callbacks.settled = [&](const df::Verdict& verdict) {
        const std::lock_guard hold(lock);
        const df::Labels before = std::move(first[verdict.index]);
        first.erase(verdict.index);
        for (std::size_t i = 0; i < before.size(); ++i) changed += before[i] != verdict.labels[i];
    };
    callbacks.notice = [](const df::Notice& notice) {
        std::fprintf(stderr, "scan %zu: %s\n", notice.index, notice.text.c_str());
    };

    df::OnlineFilter filter(df::Config{}, options, callbacks);
    df::Pose last;
    for (std::size_t i = 0; i < recording.size(); ++i) {
        df::io::FullScan scan = recording.read(i);
        last = scan.T_world_sensor;
        filter.push({std::move(scan.points), scan.T_world_sensor, scan.stamp, i});
    }
    filter.finish();
    std::printf("%zu scans, %zu verdicts corrected, %zu static voxels around\n",
                filter.counters().processed, changed, filter.local_static_map(last).size());
}

}  // namespace

int main(int argc, char** argv) try {
    if (argc != 2) throw df::Error("usage: online RECORDING");
    replay(df::io::open_recording(argv[1]));
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
