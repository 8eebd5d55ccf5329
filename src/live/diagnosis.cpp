// SPDX-License-Identifier: MIT
#include "live/diagnosis.hpp"

#include <fmt/format.h>

namespace dynamic_filter::live {

namespace {

enum Level : std::uint8_t { kGood = 0, kWarning = 1, kError = 2, kStale = 3 };

using Values = std::vector<std::pair<std::string, std::string>>;

template <class T>
void add(Values& values, const char* key, const T& value) {
    values.emplace_back(key, fmt::format("{}", value));
}

io::DiagnosticStatus input_row(const Figures& now, const Figures& before, double silent_after) {
    io::DiagnosticStatus row{kGood, "input", now.poses, now.cloud, {}};
    if (!now.silence || *now.silence > silent_after) {
        row.level = kStale;
        row.message = now.silence ? fmt::format("no scan for {:.0f} s", *now.silence)
                                  : std::string("no scan yet");
    } else if (now.intake.without_pose > before.intake.without_pose) {
        row.level = kError;
        row.message = "scans without a pose: " + now.poses;
    } else if (now.intake.malformed > before.intake.malformed || now.lost > before.lost) {
        row.level = kWarning;
        row.message = "scans are lost or cannot be read";
    }
    add(row.values, "scans received", now.intake.received);
    add(row.values, "scans taken", now.intake.taken);
    add(row.values, "scans without a pose", now.intake.without_pose);
    add(row.values, "scans not readable", now.intake.malformed);
    add(row.values, "scans dropped unread", now.intake.overrun);
    add(row.values, "messages lost on the network", now.lost);
    add(row.values, "messages with poses not readable", now.intake.other_malformed);
    return row;
}

io::DiagnosticStatus filter_row(const Figures& now, const Figures& before) {
    io::DiagnosticStatus row{kGood, "filter", "", now.cloud, {}};
    row.message =
        fmt::format("latency {:.0f} ms, p99 {:.0f} ms", now.latencies.p50, now.latencies.p99);
    if (now.is_paused) row.message = "paused by a message; scans are left out";
    const std::uint64_t dropped =
        now.filter.dropped + now.intake.overrun - before.filter.dropped - before.intake.overrun;
    if (dropped > 0) {
        row.level = kWarning;
        row.message =
            fmt::format("too slow for the sensor: {} scans dropped; {}", dropped, row.message);
    }
    const bool tracks = now.odometry.good + now.odometry.weak + now.odometry.lost > 0;
    if (tracks && now.odometry.last == TrackStatus::lost) {
        row.level = kError;
        row.message = "the odometry is lost; " + row.message;
    } else if (tracks && now.odometry.last == TrackStatus::weak && row.level == kGood) {
        row.level = kWarning;
        row.message = "the odometry is weak in some direction; " + row.message;
    }
    add(row.values, "judged", now.filter.processed);
    add(row.values, "left out during pauses", now.left_out);
    add(row.values, "dropped", now.filter.dropped);
    add(row.values, "rejected", now.filter.rejected);
    add(row.values, "waiting", now.filter.queued);
    row.values.emplace_back("latency p50 [ms]", fmt::format("{:.1f}", now.latencies.p50));
    row.values.emplace_back("latency p99 [ms]", fmt::format("{:.1f}", now.latencies.p99));
    if (tracks) {
        add(row.values, "odometry good", now.odometry.good);
        add(row.values, "odometry weak", now.odometry.weak);
        add(row.values, "odometry lost", now.odometry.lost);
    }
    return row;
}

io::DiagnosticStatus result_row(const Figures& now) {
    io::DiagnosticStatus row{kGood, "result", "the ground stays", now.cloud, {}};
    if (now.alarm.empty()) return row;
    row.level = kError;
    row.message = now.alarm;
    return row;
}

io::DiagnosticStatus output_row(const Figures& now, const Figures& before) {
    io::DiagnosticStatus row{kGood, "output", "published", now.cloud, {}};
    if (now.not_taken > before.not_taken || now.unpublished > before.unpublished) {
        row.level = kWarning;
        row.message = "a receiver is too slow";
    }
    add(row.values, "scans published", now.published);
    add(row.values, "scans not published", now.unpublished);
    add(row.values, "messages not taken", now.not_taken);
    return row;
}

}  // namespace

std::vector<io::DiagnosticStatus> diagnose(const Figures& now, const Figures& before,
                                           const std::string& name, double silent_after) {
    std::vector<io::DiagnosticStatus> rows{input_row(now, before, silent_after),
                                           filter_row(now, before), result_row(now),
                                           output_row(now, before)};
    for (io::DiagnosticStatus& row : rows) row.name = name + ": " + row.name;
    return rows;
}

std::string to_text(const Figures& f) {
    std::string text;
    const auto line = [&](const char* name, const std::string& value) {
        text += fmt::format("{:<9}{}\n", name, value);
    };
    const auto& in = f.intake;
    const std::uint64_t waiting =
        in.received - in.taken - in.malformed - in.without_pose - in.overrun;
    line("input", fmt::format("{} scans received; {} taken, {} without a pose, {} not readable, {} "
                              "dropped, {} waiting; {} messages lost on the network",
                              in.received, in.taken, in.without_pose, in.malformed, in.overrun,
                              waiting, f.lost));
    line("filter", fmt::format("{} judged, {} dropped, {} rejected, {} waiting", f.filter.processed,
                               f.filter.dropped, f.filter.rejected, f.filter.queued));
    if (f.left_out > 0) line("pauses", fmt::format("{} left out during pauses", f.left_out));
    line("output", fmt::format("{} published, {} not; {} messages not taken by slow receivers",
                               f.published, f.unpublished, f.not_taken));
    if (f.origin == PoseOrigin::odometry) {
        line("odometry", fmt::format("{} scans good, {} weak, {} lost", f.odometry.good,
                                     f.odometry.weak, f.odometry.lost));
    }
    line("latency",
         fmt::format("p50 {:.1f} ms, p99 {:.1f} ms, at most {:.1f} ms, of the last {} scans",
                     f.latencies.p50, f.latencies.p99, f.latencies.most, f.latencies.scans));
    return text;
}

}  // namespace dynamic_filter::live
