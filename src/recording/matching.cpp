// SPDX-License-Identifier: MIT
#include "recording/matching.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/numbers.hpp"
#include "dynamic_filter/error.hpp"
#include "recording/layouts/numbers.hpp"
#include "recording/poses_at_scans.hpp"
#include "recording/scan_overlay.hpp"
#include "recording/times_in_names.hpp"

namespace dynamic_filter::io {
namespace {

double span_of(const std::vector<double>& stamps) { return stamps.back() - stamps.front(); }

double usual_step(const std::vector<double>& stamps) {
    std::vector<double> steps;
    for (std::size_t i = 1; i < stamps.size(); ++i) steps.push_back(stamps[i] - stamps[i - 1]);
    return median(std::move(steps));
}

bool overlap(const std::vector<double>& a, const std::vector<double>& b) {
    return a.front() <= b.back() && b.front() <= a.back();
}

/// Stamps in whole seconds, or all equal, do not tell which pose belongs to which scan.
bool repeat(const std::vector<double>& stamps) {
    return std::adjacent_find(stamps.begin(), stamps.end()) != stamps.end();
}

/// Stamps of one clock. One that begins at 0 counts from its own beginning, so the other one is
/// another clock, unless it begins within the same second.
bool are_of_one_clock(const std::vector<double>& poses, const std::vector<double>& scans) {
    constexpr double at_once = 1.0;  // [s]
    const bool begin_together = std::abs(poses.front() - scans.front()) < at_once;
    const bool one_begins_at_zero = (poses.front() == 0.0) != (scans.front() == 0.0);
    return overlap(poses, scans) && (begin_together || !one_begins_at_zero);
}

/// True if each row is that of its scan: the numbers agree, and no two stamps are apart.
bool are_parallel(const std::vector<double>& poses, const std::vector<double>& scans) {
    const double most = limits_for(scans).nearest;
    const auto is_near = [&](double a, double b) { return std::abs(a - b) <= most; };
    return std::equal(poses.begin(), poses.end(), scans.begin(), scans.end(), is_near);
}

/// Poses in a file are often rounded to milliseconds; a row that near is that of the scan, also one
/// of lost tracking.
std::optional<Pose> row_at(const Trajectory& rows, double stamp) {
    constexpr double rounding = 1e-3;  // [s]
    const auto row = std::lower_bound(rows.stamps.begin(), rows.stamps.end(), stamp - rounding);
    if (row == rows.stamps.end() || *row > stamp + rounding) return std::nullopt;
    return rows.poses[static_cast<std::size_t>(row - rows.stamps.begin())];
}

/// "; the poses begin 0.2 s after the scans; 1 scan has no pose", as far as that is so.
std::string misfit_text(const std::vector<double>& poses, const std::vector<double>& scans,
                        const std::vector<Pose>& matched) {
    std::string text;
    const double offset = poses.front() - scans.front();
    const bool is_shifted = poses.size() == scans.size() && !are_parallel(poses, scans);
    if (is_shifted && std::abs(offset) > 0.5 * usual_step(scans)) {
        text += fmt::format("; the poses begin {:.3g} s {} the scans", std::abs(offset),
                            offset < 0.0 ? "before" : "after");
    }
    const auto lost = std::count_if(matched.begin(), matched.end(),
                                    [](const Pose& pose) { return !pose.matrix().allFinite(); });
    if (lost > 0)
        text += fmt::format("; {} {} no pose", lost, lost == 1 ? "scan has" : "scans have");
    return text;
}

[[noreturn]] void refuse_without_any(const Layout& layout, const PoseFile& file,
                                     const std::vector<double>& times) {
    double gap = std::abs(file.stamps.front() - times.front());
    for (const double stamp : file.stamps) gap = std::min(gap, std::abs(stamp - times.front()));
    throw InputError(layout.scans.front(), "",
                     fmt::format("no scan has a pose: {} scans but {} poses in {}, and no pose "
                                 "within {:.3g} s of this scan's time {}; the nearest is {:.3g} s "
                                 "away",
                                 layout.scans.size(), file.poses.size(), layout.poses->string(),
                                 limits_for(times).nearest, times.front(), gap));
}

/// Throws if most rows have the stamp of the row before, which then tells no scan its pose.
void refuse_rounded_stamps(const Layout& layout, const PoseFile& file) {
    std::size_t same = 0;
    for (std::size_t i = 1; i < file.stamps.size(); ++i) {
        if (file.stamps[i] == file.stamps[i - 1]) ++same;
    }
    if (2 * same <= file.stamps.size()) return;
    throw InputError(
        *layout.poses, "",
        fmt::format(
            "its stamps are rounded: {} of {} rows have the stamp of the row before, such as "
            "{}; expected one for each pose, to match them to {} scans; write all digits, or "
            "give --poses none, which finds the poses",
            same, file.stamps.size(), file.stamps[file.stamps.size() / 2], layout.scans.size()));
}

Match match_by_time(const Layout& layout, const PoseFile& file, const std::vector<double>& times,
                    const char* source) {
    Match match{.poses = {}, .stamps = times, .note = {}};
    match.trajectory = without_lost(file.stamps, file.poses);
    if (are_parallel(file.stamps, times)) {
        match.poses = file.poses;
    } else {
        Trajectory rows{file.stamps, file.poses};
        put_in_order(rows);
        const PoseLimits limits = limits_for(times);
        PosesAtScans found = poses_at_scans(times, match.trajectory, [&](double stamp) {
            const auto row = row_at(rows, stamp);
            return row ? row : pose_at(match.trajectory, stamp, limits.apart);
        });
        match.poses = std::move(found.T_world_sensor);
        match.are_sparse = found.are_sparse;
        match.sparse_note = std::move(found.note);
    }
    const bool none = std::none_of(match.poses.begin(), match.poses.end(),
                                   [](const Pose& pose) { return pose.matrix().allFinite(); });
    if (none) refuse_without_any(layout, file, times);
    match.note = fmt::format("{} scans matched to {} poses by time ({})", times.size(),
                             file.poses.size(), source) +
                 (match.are_sparse ? "" : misfit_text(file.stamps, times, match.poses));
    return match;
}

Match match_by_order(const PoseFile& file, const std::vector<double>& own) {
    const std::string note = fmt::format("{} scans matched to poses by order", file.poses.size());
    if (file.stamps.empty()) return {file.poses, own, note};
    if (own.empty()) return {file.poses, file.stamps, note};
    return {file.poses, own, note, file.stamps};
}

Match match_by_rows(const Layout& layout, const PoseFile& file,
                    const std::vector<std::size_t>& rows, const std::vector<double>& times) {
    Match match{.poses = {}, .stamps = times, .note = {}};
    for (const std::size_t row : rows) {
        match.poses.push_back(file.poses[row]);
        if (times.empty() && !file.stamps.empty()) match.stamps.push_back(file.stamps[row]);
    }
    match.note = fmt::format(
        "{} scans matched to {} poses by the numbers of their names: the first one is {}, "
        "which has row {} (from 0)",
        rows.size(), file.poses.size(), layout.scans.front().filename().string(), rows.front());
    return match;
}

/// The first of the rows that belong to the scans, if these are at the begin or the end of more
/// poses, and do not overlay better in between. Empty if it is not known.
std::optional<std::size_t> row_by_overlay(const Layout& layout, const std::vector<Pose>& poses) {
    constexpr std::size_t kTried = 16;
    constexpr double kLeast = 0.2;  // of the structures
    const std::size_t scans = layout.scans.size();
    if (layout.calib || scans < 3 || poses.size() <= scans) return std::nullopt;
    const ScanOverlay overlay(scans, [&](std::size_t i) { return layout.read(layout.scans[i]); });
    const auto share_from = [&](std::size_t row) {
        return overlay.share([&](std::size_t i) { return poses[row + i]; }, layout.points_in_world);
    };
    const std::size_t last = poses.size() - scans;
    std::size_t best = 0;
    double most = share_from(0);
    for (std::size_t k = std::min(last, kTried); k > 0; --k) {
        const std::size_t row = k * last / std::min(last, kTried);
        const double share = share_from(row);
        if (!overlays_better(share, most)) continue;
        most = share;
        best = row;
    }
    return most > kLeast && (best == 0 || best == last) ? std::optional(best) : std::nullopt;
}

Match match_from_row(const Layout& layout, const PoseFile& file, std::size_t row,
                     const std::vector<double>& times) {
    const auto first = static_cast<std::ptrdiff_t>(row), scans = std::ssize(layout.scans);
    const auto part_of = [&](const auto& all) {
        return std::vector(all.begin() + first, all.begin() + first + scans);
    };
    Match match{.poses = part_of(file.poses), .stamps = times, .note = {}};
    if (times.empty() && !file.stamps.empty()) match.stamps = part_of(file.stamps);
    match.note = fmt::format(
        "{} scans but {} poses, and names without gaps: the {} rows are taken for theirs, because "
        "scans overlay best there; --poses FILE gives others",
        scans, file.poses.size(), row == 0 ? "first" : "last");
    return match;
}

/// Stamps of poses may be in seconds although those of the scans are not.
PoseFile in_seconds(PoseFile file, const std::vector<double>& scans, std::optional<double> unit) {
    if (!unit || file.stamps.empty()) return file;
    const double span = span_of(file.stamps);
    const bool are_seconds =
        !scans.empty() && std::abs(span - span_of(scans)) < std::abs(*unit * span - span_of(scans));
    if (are_seconds) return file;
    for (double& stamp : file.stamps) stamp *= *unit;
    return file;
}

}  // namespace

Trajectory without_lost(const std::vector<double>& stamps, const std::vector<Pose>& poses) {
    Trajectory known;
    for (std::size_t i = 0; i < poses.size(); ++i) {
        if (!poses[i].matrix().allFinite()) continue;
        known.stamps.push_back(stamps[i]);
        known.poses.push_back(poses[i]);
    }
    put_in_order(known);
    return known;
}

double unit_between(const std::vector<double>& poses, const std::vector<double>& scans) {
    if (poses.empty() || scans.empty() || !(span_of(scans) > 0.0)) return 1.0;
    // A thousand times as long, the poses may be those of a longer drive.
    if (overlap(poses, scans) && poses.size() != scans.size()) return 1.0;
    const double ratio = span_of(poses) / span_of(scans);
    for (const double factor : {1e-3, 1e-6, 1e-9, 1e3, 1e6, 1e9}) {
        if (std::abs(ratio * factor - 1.0) < 0.5) return factor;
    }
    return 1.0;
}

std::vector<std::size_t> rows_in_names(const Paths& scans, std::size_t rows) {
    constexpr std::size_t first_time = 100'000'000;  // larger numbers are times
    std::vector<std::size_t> numbers;
    for (const auto& scan : scans) {
        const auto number = index_of(scan);
        const bool follows = number && (numbers.empty() || *number > numbers.back());
        if (!follows || *number >= first_time) return {};
        numbers.push_back(*number);
    }
    if (numbers.empty() || scans.size() >= rows || numbers.back() > rows) return {};
    // If the last scan is that of the last row, this tells whether the first row is number 0 or 1.
    if (numbers.back() == rows) {
        if (numbers.front() == 0) return {};
        for (std::size_t& number : numbers) --number;
        return numbers;
    }
    if (numbers.back() + 1 == rows) return numbers;
    // Without gaps, the scans may have been numbered anew.
    const bool has_gaps = numbers.back() - numbers.front() + 1 > numbers.size();
    return has_gaps || numbers.front() > 1 ? numbers : std::vector<std::size_t>{};
}

PoseFile read_pose_file(const std::filesystem::path& file, PoseFix& fix) {
    PoseFile poses = read_poses(file);
    if (fix != PoseFix::relative) return poses;
    fix = PoseFix::none;
    poses.poses = chained(std::move(poses.poses));
    return poses;
}

Match match_poses(const Layout& layout, const PoseFile& given, const std::vector<double>& times,
                  std::optional<double> unit) {
    const std::size_t scans = layout.scans.size();
    std::vector<double> own = times.empty() ? times_in_names(layout.scans, unit) : times;
    PoseFile file = in_seconds(given, own, unit);
    const bool are_as_many = file.poses.size() == scans;
    if (!file.stamps.empty() && !own.empty()) {
        const double factor = unit_between(file.stamps, own);
        // Of poses that order can match, `check` names the unit.
        if (!are_as_many) {
            for (double& stamp : file.stamps) stamp *= factor;
        }
        const bool time_decides = factor == 1.0 && !repeat(file.stamps) && !repeat(own) &&
                                  are_of_one_clock(file.stamps, own);
        if (!are_as_many || time_decides) {
            if (!are_as_many) refuse_rounded_stamps(layout, file);
            const char* source = times.empty()  ? "file names"
                                 : layout.times ? "times.txt"
                                                : "the recording's stamps";
            return match_by_time(layout, file, own, source);
        }
    }
    if (are_as_many) {
        if (!std::is_sorted(own.begin(), own.end())) own.clear();
        return match_by_order(file, own);
    }
    if (const auto rows = rows_in_names(layout.scans, file.poses.size()); !rows.empty()) {
        return match_by_rows(layout, file, rows, times);
    }
    if (const auto row = row_by_overlay(layout, file.poses)) {
        return match_from_row(layout, file, *row, times);
    }
    throw InputError(
        *layout.poses, "",
        fmt::format("{} scans in {} but {} poses; give the matching file with --poses, "
                    "or --poses none, which finds the poses (--first, --last and --stride apply "
                    "after matching)",
                    scans, layout.scan_folder.string(), file.poses.size()));
}

}  // namespace dynamic_filter::io
