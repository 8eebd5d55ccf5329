// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

#include "base/degree.hpp"
#include "dynamic_filter/check.hpp"

namespace dynamic_filter::io {
namespace {

using Drives = std::span<const Recording* const>;

constexpr double kNoTurn = 0.2;         // [deg] smaller turns are not mentioned
constexpr double kOneWorld = 20'000.0;  // [m] drives of one map are not farther apart
constexpr double kUnrelated = 2.0;      // [m] drift is smaller than this spread
constexpr const char* kTogether =
    "find the poses of all drives together, with a program that closes loops between them, or "
    "register the trajectories to each other";

/// The last part of the path; the whole path if two drives have the same last part.
std::string name_of(Drives drives, std::size_t i) {
    const auto last = [](const Recording& drive) {
        const auto name = drive.info().root.filename();
        return name.empty() ? drive.info().root.parent_path().filename() : name;
    };
    const auto has_it = [&](const Recording* drive) { return last(*drive) == last(*drives[i]); };
    const bool unique = std::count_if(drives.begin(), drives.end(), has_it) == 1;
    return (unique ? last(*drives[i]) : drives[i]->info().root).string();
}

std::string vector_text(const Eigen::Vector3d& v) {
    return fmt::format("({:.2f}, {:.2f}, {:.2f}) m", v.x(), v.y(), v.z());
}

/// Rounds to centimetres, and takes the minus from zeros.
Eigen::Vector3d rounded(const Eigen::Vector3d& v) {
    Eigen::Vector3d cm = (100.0 * v).array().round().matrix() / 100.0;
    for (double& along : cm) along = along == 0.0 ? 0.0 : along;
    return cm;
}

std::string distance_text(double metres) {
    return metres < 1000.0 ? fmt::format("{:.0f} m", metres)
                           : fmt::format("{:.1f} km", metres / 1000.0);
}

/// Names a frequent cause of such an offset.
std::string likely_cause(const DriveOffset& offset) {
    constexpr double kSmall = 0.05;  // [m]
    const double flat = offset.shift.head<2>().norm(), height = std::abs(offset.shift.z());
    if (std::abs(offset.yaw_deg) >= kNoTurn) return "another heading of the world frame";
    if (flat < kSmall && height > 10.0) {
        return "heights above the ellipsoid and above the sea level";
    }
    if (flat < kSmall) return "another reference of the height, or of the sensor's mounting height";
    return "another origin, or a constant error of the satellite positions";
}

/// `to_move`: names of the drives whose poses have the offset.
Finding shifted_finding(Drives drives, const DriveOffset& o,
                        const std::vector<std::string>& to_move) {
    const std::string a = name_of(drives, o.a), b = name_of(drives, o.b);
    const bool turns = std::abs(o.yaw_deg) >= kNoTurn;
    const Eigen::Vector3d shift = rounded(o.shift), back = rounded(-o.shift);
    const std::string about =
        fmt::format("about the vertical through ({:.1f}, {:.1f})", o.pivot.x(), o.pivot.y());
    std::string what = fmt::format(
        "the world frames of {} and {} differ: {} shows things {} from where {} shows them", a, b,
        b, vector_text(shift), a);
    if (turns) what += fmt::format(", and turned by {:.2f} deg {}", o.yaw_deg, about);
    what += fmt::format("; this holds at {} of {} places where they meet", o.agreeing, o.fitting);
    std::string advice = fmt::format("add {} to the positions of the poses of {}",
                                     vector_text(back), fmt::join(to_move, " and "));
    if (turns) advice += fmt::format(", and then turn them by {:.2f} deg {}", -o.yaw_deg, about);
    advice += fmt::format("; the cause may be {}", likely_cause(o));
    return {what, advice};
}

Finding drifting_finding(Drives drives, const DriveOffset& o) {
    const std::string a = name_of(drives, o.a), b = name_of(drives, o.b);
    const std::string what = fmt::format(
        "{} and {} do not lie on each other: at the {} places where they meet, {} is off by {:.2f} "
        "to {:.2f} m, and no constant offset explains this (differences up to {:.2f} m)",
        a, b, o.fitting, b, o.least, o.most, o.spread);
    const std::string cause = o.spread > kUnrelated
                                  ? "the poses drift much, or the drives have frames of their own; "
                                  : "the poses of at least one drive drift; ";
    return {what, cause + kTogether};
}

Finding unlike_finding(Drives drives, const DriveOffset& o) {
    return {fmt::format("the poses of {} and {} meet at {} places, but their scans show different "
                        "surroundings there",
                        name_of(drives, o.a), name_of(drives, o.b), o.places),
            fmt::format("each drive seems to have a frame of its own, with its origin at its start "
                        "for instance: {}",
                        kTogether)};
}

Finding same_finding(Drives drives, const DriveOffset& o) {
    return {fmt::format("{} and {} have the same poses, as if one recording was given twice",
                        name_of(drives, o.a), name_of(drives, o.b)),
            "give each recording once, and check that each has its own pose file"};
}

Finding apart_finding(Drives drives, const DriveOffset& o) {
    return {fmt::format("{} and {} do not meet: they are {} apart at their nearest",
                        name_of(drives, o.a), name_of(drives, o.b), distance_text(o.gap)),
            o.gap > kOneWorld
                ? "their frames seem to differ: check the zone of UTM and the local origin of each"
                : "check whether they have the same origin; if they are truly apart, map them in "
                  "separate runs"};
}

/// Groups of drives.
class Groups {
public:
    explicit Groups(std::size_t drives) : group_(drives) {
        std::iota(group_.begin(), group_.end(), std::size_t{0});
    }
    [[nodiscard]] bool together(std::size_t a, std::size_t b) const {
        return group_[a] == group_[b];
    }
    [[nodiscard]] std::ptrdiff_t size_of(std::size_t drive) const {
        return std::count(group_.begin(), group_.end(), group_[drive]);
    }
    void join(std::size_t a, std::size_t b) {
        std::replace(group_.begin(), group_.end(), std::size_t{group_[b]}, std::size_t{group_[a]});
    }

private:
    std::vector<std::size_t> group_;
};

/// The same offset, seen from the other drive.
DriveOffset turned_round(DriveOffset offset) {
    std::swap(offset.a, offset.b);
    const Eigen::AngleAxisd back(-offset.yaw_deg * kDegree, Eigen::Vector3d::UnitZ());
    offset.shift = -(back * offset.shift);
    offset.yaw_deg = -offset.yaw_deg;
    return offset;
}

/// One finding for each drive that is off, and none that follows from others. Of two drives, the
/// one with which fewer drives agree is to be moved; otherwise the later one.
void add_shifted(Drives drives, std::span<const DriveOffset> offsets,
                 std::vector<Finding>& findings) {
    Groups equal(drives.size());
    std::vector<DriveOffset> shifted;
    for (const DriveOffset& offset : offsets) {
        if (offset.match == FrameMatch::equal) equal.join(offset.a, offset.b);
        if (offset.match == FrameMatch::shifted) shifted.push_back(offset);
    }
    for (DriveOffset& offset : shifted) {
        if (equal.size_of(offset.a) < equal.size_of(offset.b)) offset = turned_round(offset);
    }
    std::stable_sort(shifted.begin(), shifted.end(), [&](const auto& a, const auto& b) {
        return equal.size_of(a.a) > equal.size_of(b.a);
    });
    Groups told = equal;
    for (const DriveOffset& offset : shifted) {
        if (told.together(offset.a, offset.b)) continue;
        told.join(offset.a, offset.b);
        std::vector<std::string> to_move;
        for (std::size_t i = 0; i < drives.size(); ++i) {
            if (equal.together(i, offset.b)) to_move.push_back(name_of(drives, i));
        }
        findings.push_back(shifted_finding(drives, offset, to_move));
    }
}

void add_differing(Drives drives, std::span<const DriveOffset> offsets,
                   std::vector<Finding>& findings) {
    for (const DriveOffset& offset : offsets) {
        switch (offset.match) {
            case FrameMatch::drifting:
                findings.push_back(drifting_finding(drives, offset));
                break;
            case FrameMatch::unlike:
                findings.push_back(unlike_finding(drives, offset));
                break;
            case FrameMatch::same_poses:
                findings.push_back(same_finding(drives, offset));
                break;
            case FrameMatch::equal:
            case FrameMatch::shifted:
            case FrameMatch::apart:
            case FrameMatch::not_known:
                break;
        }
    }
}

/// The nearest of the other drives; null if one is met, or if there is none.
const DriveOffset* nearest_of_lonely(std::span<const DriveOffset> offsets, std::size_t drive) {
    const DriveOffset* nearest = nullptr;
    for (const DriveOffset& offset : offsets) {
        if (offset.a != drive && offset.b != drive) continue;
        if (offset.match != FrameMatch::apart) return nullptr;
        if (nearest == nullptr || offset.gap < nearest->gap) nearest = &offset;
    }
    return nearest;
}

/// Drives in other quarters of a city are usual, so that a drive is reported only if it is far
/// away, or if no two drives meet.
void add_apart(Drives drives, std::span<const DriveOffset> offsets,
               std::vector<Finding>& findings) {
    const bool none_meet = std::all_of(offsets.begin(), offsets.end(), [](const DriveOffset& o) {
        return o.match == FrameMatch::apart;
    });
    std::vector<const DriveOffset*> reported;
    for (std::size_t i = 0; i < drives.size(); ++i) {
        const DriveOffset* nearest = nearest_of_lonely(offsets, i);
        if (nearest == nullptr || (!none_meet && nearest->gap < kOneWorld)) continue;
        if (std::find(reported.begin(), reported.end(), nearest) != reported.end()) continue;
        reported.push_back(nearest);
        findings.push_back(apart_finding(drives, *nearest));
    }
}

void add_without_poses(Drives drives, std::vector<Finding>& findings) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < drives.size(); ++i) {
        if (!drives[i]->info().has_poses) names.push_back(name_of(drives, i));
    }
    if (names.empty()) return;
    findings.push_back(
        {fmt::format("{} {} no poses; poses that odometry finds have a frame of their own, which "
                     "begins with the first scan, so the frames of the drives cannot be compared",
                     fmt::join(names, ", "), names.size() == 1 ? "has" : "have"),
         kTogether});
}

}  // namespace

std::vector<Finding> findings_of(std::span<const Recording* const> drives,
                                 std::span<const DriveOffset> offsets) {
    std::vector<Finding> findings;
    if (drives.size() < 2) return findings;
    add_without_poses(drives, findings);
    add_shifted(drives, offsets, findings);
    add_differing(drives, offsets, findings);
    if (!offsets.empty()) add_apart(drives, offsets, findings);
    return findings;
}

}  // namespace dynamic_filter::io
