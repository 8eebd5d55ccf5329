// SPDX-License-Identifier: MIT
#include "recording/matching.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/text.hpp"
#include "dynamic_filter/error.hpp"

namespace dynamic_filter::io {
namespace {

constexpr double most_gap = 0.05;            // [s] half the period of a 10 Hz LiDAR
constexpr double least_epoch_seconds = 1e8;  // smaller whole numbers are indices, not times
constexpr double least_nanoseconds = 1e15;   // larger than any number of seconds

/// SECONDS_NANOSECONDS at the end of a name, as in "cloud_1583836591_182590976".
std::optional<double> split_time_in(const std::string& name) {
    constexpr std::size_t digits = 9;
    const std::size_t low = name.rfind('_');
    if (low == std::string::npos || low == 0 || name.size() - low - 1 != digits) {
        return std::nullopt;
    }
    const std::size_t high = name.rfind('_', low - 1);  // npos + 1 is 0
    const std::string whole = name.substr(high + 1, low - high - 1), part = name.substr(low + 1);
    const bool numeric = (whole + part).find_first_not_of("0123456789") == std::string::npos;
    const auto seconds = parse_real(whole), nanoseconds = parse_real(part);
    if (!numeric || !seconds || !nanoseconds || *seconds < least_epoch_seconds) return std::nullopt;
    return *seconds + *nanoseconds * 1e-9;
}

/// Reads a file name as a time; empty for indices such as "000123".
std::optional<double> time_in(const std::string& name) {
    if (const auto time = split_time_in(name)) return time;
    const bool numeric = name.find_first_not_of("0123456789.") == std::string::npos;
    const auto value = numeric ? parse_real(name) : std::nullopt;
    if (!value) return std::nullopt;
    if (name.find('.') != std::string::npos) return value;
    if (*value >= least_nanoseconds) return *value * 1e-9;
    return *value >= least_epoch_seconds ? value : std::nullopt;
}

std::vector<double> times_in_names(const Paths& scans) {
    std::vector<double> times;
    for (const auto& scan : scans) {
        const auto time = time_in(scan.stem().string());
        if (!time) return {};
        times.push_back(*time);
    }
    return times;
}

std::size_t nearest(const std::vector<double>& stamps, double time) {
    const auto after = std::lower_bound(stamps.begin(), stamps.end(), time);
    if (after == stamps.begin()) return 0;
    const auto before = after - 1;
    const bool later = after != stamps.end() && *after - time < time - *before;
    return static_cast<std::size_t>((later ? after : before) - stamps.begin());
}

Match match_by_time(const Layout& layout, const PoseFile& file, std::vector<double> times,
                    const std::string& source) {
    Match match;
    for (std::size_t i = 0; i < times.size(); ++i) {
        const std::size_t pose = nearest(file.stamps, times[i]);
        const double gap = std::abs(file.stamps[pose] - times[i]);
        if (!(gap <= most_gap)) {
            throw InputError(layout.scans[i], "",
                             fmt::format("{} scans but {} poses in {}, and no pose within {} s of "
                                         "this scan's time {}; the nearest is {:.3g} s away",
                                         layout.scans.size(), file.poses.size(),
                                         layout.poses->string(), most_gap, times[i], gap));
        }
        match.poses.push_back(file.poses[pose]);
    }
    match.stamps = std::move(times);
    match.note = fmt::format("{} scans matched to {} poses by time ({})", layout.scans.size(),
                             file.poses.size(), source);
    return match;
}

}  // namespace

std::vector<double> growing_times_in_names(const Paths& scans) {
    std::vector<double> times = times_in_names(scans);
    if (!std::is_sorted(times.begin(), times.end())) times.clear();
    return times;
}

Match match_poses(const Layout& layout, const PoseFile& file, const std::vector<double>& times) {
    const std::size_t scans = layout.scans.size();
    if (file.poses.size() == scans) {
        const std::string note = fmt::format("{} scans matched to poses by order", scans);
        if (file.stamps.empty()) {
            return {file.poses, times.empty() ? growing_times_in_names(layout.scans) : times, note};
        }
        const std::vector<double> own = times.empty() ? times_in_names(layout.scans) : times;
        if (own.empty()) return {file.poses, file.stamps, note};
        return {file.poses, own, note, file.stamps};
    }
    if (!file.stamps.empty()) {
        const char* source = layout.times ? "times.txt" : "the recording's stamps";
        if (times.size() == scans) return match_by_time(layout, file, times, source);
        const std::vector<double> named = times_in_names(layout.scans);
        if (!named.empty()) return match_by_time(layout, file, named, "file names");
    }
    throw InputError(
        *layout.poses, "",
        fmt::format("{} scans in {} but {} poses; give the matching file with --poses, "
                    "or --poses none, which finds the poses (--first, --last and --stride apply "
                    "after matching)",
                    scans, layout.scan_folder.string(), file.poses.size()));
}

}  // namespace dynamic_filter::io
