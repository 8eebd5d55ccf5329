// SPDX-License-Identifier: MIT
/// Runs the online filter for hours, and under overload. A recording is repeated; each round begins
/// where the last one ended, so that the sensor moves on for ever. Prints JSON.
///
///     replay RECORDING hours H        H hours of sensor time at full speed: memory and time
///     replay RECORDING overload S     S seconds at ten times the possible rate, then the rate of
///                                     the sensor: age of the verdicts, recovery, counters
#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "dynamic_filter/dynamic_filter.hpp"
#include "recording/scans.hpp"
#include "score/report.hpp"

namespace {

using namespace dynamic_filter;
using Clock = std::chrono::steady_clock;
using nlohmann::ordered_json;

double resident_mib() {
    std::ifstream file("/proc/self/statm");
    long pages = 0, resident = 0;
    file >> pages >> resident;
    return static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1 << 20);
}

/// Repeats the scans without end.
class EndlessDrive {
public:
    explicit EndlessDrive(const io::Recording& recording) {
        for (std::size_t i = 0; i < recording.size(); ++i) {
            io::FullScan full = recording.read(i);
            scans_.push_back(app::moved_scan(full, i));
        }
        if (scans_.size() < 2) throw Error("one scan is no drive");
        const double rounds = static_cast<double>(scans_.size() - 1);
        period_ = (scans_.back().stamp - scans_.front().stamp) / rounds;
    }
    Scan next() {
        const std::size_t i = count_ % scans_.size();
        Scan scan = scans_[i];
        scan.T_world_sensor = round_ * scan.T_world_sensor;
        scan.stamp = period_ * static_cast<double>(count_);
        scan.index = count_++;
        if (i + 1 == scans_.size()) {
            round_ = scan.T_world_sensor * scans_.front().T_world_sensor.inverse();
        }
        return scan;
    }
    [[nodiscard]] double period() const { return period_; }

private:
    std::vector<Scan> scans_;
    Pose round_ = Pose::Identity();
    double period_ = 0.1;
    std::size_t count_ = 0;
};

ordered_json hours(const io::Recording& recording, double hours) {
    EndlessDrive drive(recording);
    OnlineOptions options;
    options.overload = Overload::wait;
    OnlineFilter filter(Config{}, options);
    const auto scans = static_cast<std::size_t>(3600.0 * hours / drive.period());
    const std::size_t step = std::max<std::size_t>(1, scans / 18);  // ten minutes of three hours
    ordered_json rows = ordered_json::array();
    auto start = Clock::now();
    for (std::size_t i = 1; i <= scans; ++i) {
        filter.push(drive.next());
        if (i % step != 0) continue;
        filter.flush();
        rows.push_back({{"hours", static_cast<double>(i) * drive.period() / 3600.0},
                        {"ms_per_scan", 1e3 * seconds_since(start) / static_cast<double>(step)},
                        {"resident_mib", resident_mib()},
                        {"voxels", filter.contents().voxels}});
        fmt::print(stderr, "{}\n", rows.back().dump());
        start = Clock::now();
    }
    return rows;
}

/// Ages of the verdicts of a phase.
struct Ages {
    std::mutex lock;
    Durations seconds;
    std::vector<Clock::time_point> sent;

    Durations so_far() {
        const std::lock_guard hold(lock);
        return seconds;
    }
    void note(std::size_t index) {
        const std::lock_guard hold(lock);
        seconds.add(seconds_since(sent[index]));
    }
};

ordered_json overload(const io::Recording& recording, double seconds) {
    EndlessDrive drive(recording);
    Ages ages;
    std::size_t last_dropped = 0;
    OnlineFilter filter(Config{}, {},
                        {.instant = [&](const Verdict& v) { ages.note(v.index); },
                         .settled = {},
                         .notice =
                             [&](const Notice& n) {
                                 if (n.kind == NoticeKind::dropped) last_dropped = n.index;
                             }});
    const auto send = [&] {
        Scan scan = drive.next();
        {
            const std::lock_guard hold(ages.lock);
            ages.sent.push_back(Clock::now());
        }
        filter.push(std::move(scan));
    };
    bool exact = true;
    const auto check = [&] {
        const Counters c = filter.counters();
        exact &= c.in == c.processed + c.dropped + c.rejected + c.queued;
    };
    // Time per scan without load.
    for (int i = 0; i < 100; ++i) {
        send();
        filter.flush();
    }
    const double alone = ages.seconds.quantile(0.5);
    const auto period = std::chrono::duration<double>(alone / 10.0);
    const std::size_t first_overload = ages.sent.size();
    ages.seconds = {};
    const auto start = Clock::now();
    for (auto due = start; seconds_since(start) < seconds;
         due += std::chrono::duration_cast<Clock::duration>(period)) {
        std::this_thread::sleep_until(due);
        send();
        check();
    }
    const auto ended = Clock::now();
    const std::size_t first_calm = ages.sent.size();
    const Durations under_load = ages.so_far();
    while (seconds_since(ended) < std::min(10.0, seconds)) {
        std::this_thread::sleep_for(std::chrono::duration<double>(drive.period()));
        send();
        check();
    }
    filter.flush();
    const Counters c = filter.counters();
    const double recovery =
        last_dropped < first_calm
            ? 0.0
            : std::chrono::duration<double>(ages.sent[last_dropped] - ended).count();
    return {{"alone_ms", 1e3 * alone},
            {"sent_per_second", static_cast<double>(first_calm - first_overload) / seconds},
            {"judged_per_second", static_cast<double>(under_load.count()) / seconds},
            {"age_p50_ms", 1e3 * under_load.quantile(0.5)},
            {"age_p99_ms", 1e3 * under_load.quantile(0.99)},
            {"recovery_seconds", recovery},
            {"counters_exact", exact && c.queued == 0},
            {"in", c.in},
            {"processed", c.processed},
            {"dropped", c.dropped},
            {"rejected", c.rejected}};
}

}  // namespace

int main(int argc, char** argv) {
    const std::string what = argc == 4 ? argv[2] : "";
    if (what != "hours" && what != "overload") {
        fmt::print(stderr, "usage: replay RECORDING hours H | replay RECORDING overload SECONDS\n");
        return 2;
    }
    try {
        const auto recording = io::open_recording(argv[1]);
        const double amount = std::stod(argv[3]);
        fmt::print("{}", app::text_of(what == "hours" ? hours(recording, amount)
                                                      : overload(recording, amount)));
        return 0;
    } catch (const std::exception& error) {
        fmt::print(stderr, "replay: {}\n", error.what());
        return 2;
    }
}
