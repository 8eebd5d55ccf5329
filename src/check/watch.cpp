// SPDX-License-Identifier: MIT
#include "check/watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace dynamic_filter::io {
namespace {

constexpr int kAcross = 30;              // cells of the raster on each side
constexpr float kGroundCell = 2.0F;      // [m]
constexpr int kFine = 4;                 // parts of the edge of a cell, each with its highest point
constexpr float kLargestStep = 0.3F;     // [m] from the ground of one cell to that of the next
constexpr float kThick = 0.15F;          // [m]
constexpr std::size_t kSampled = 20000;  // points of a scan
constexpr std::size_t kLeastArea = 12;   // cells of a connected ground; a bus has fewer

constexpr float kNothing = std::numeric_limits<float>::infinity();

/// The height of the lowest point of each cell around the sensor, seen from above.
using Raster = std::array<float, std::size_t{kAcross} * kAcross>;

/// A sampled point, seen from above.
struct Seen {
    int x, y;  // in parts of a cell
    float height;
    bool is_gone;

    [[nodiscard]] std::size_t cell() const {
        return static_cast<std::size_t>(x / kFine * kAcross + y / kFine);
    }
    [[nodiscard]] std::size_t part() const {
        return static_cast<std::size_t>(x * kFine * kAcross + y);
    }
};

std::vector<Seen> seen_from_above(const Points& points, const Pose& T_world_sensor,
                                  const Labels& labels) {
    const Eigen::Matrix3f upright = T_world_sensor.linear().cast<float>();
    const std::size_t stride = points.size() / kSampled + 1;
    std::vector<Seen> seen;
    for (std::size_t i = 0; i < points.size(); i += stride) {
        if (!is_measured(points[i])) continue;
        const Point p = upright * points[i];
        const Eigen::Vector2f at =
            p.head<2>() * (kFine / kGroundCell) + Eigen::Vector2f::Constant(0.5F * kFine * kAcross);
        if (!(at.minCoeff() >= 0.0F && at.maxCoeff() < kFine * kAcross)) continue;
        seen.push_back({static_cast<int>(at.x()), static_cast<int>(at.y()), p.z(),
                        labels[i] == Label::dynamic});
    }
    return seen;
}

/// Keeps the cells of large areas without steps.
void keep_ground(Raster& low) {
    std::array<bool, std::tuple_size_v<Raster>> seen{};
    for (std::size_t start = 0; start < low.size(); ++start) {
        if (seen[start] || low[start] == kNothing) continue;
        std::vector<std::size_t> area = {start};
        seen[start] = true;
        for (std::size_t k = 0; k < area.size(); ++k) {
            const int x = static_cast<int>(area[k]) / kAcross,
                      y = static_cast<int>(area[k]) % kAcross;
            for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
                if (x + dx < 0 || x + dx >= kAcross || y + dy < 0 || y + dy >= kAcross) continue;
                const auto next = static_cast<std::size_t>((x + dx) * kAcross + y + dy);
                if (seen[next] || !(std::abs(low[next] - low[area[k]]) < kLargestStep)) continue;
                seen[next] = true;
                area.push_back(next);
            }
        }
        if (area.size() >= kLeastArea) continue;
        for (const std::size_t cell : area) low[cell] = kNothing;
    }
}

double share(std::size_t part, std::size_t all) {
    return all == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(all);
}

/// `part`: the points that are too many.
std::optional<Alarm> share_alarm(std::span<const ScanWatch> scans, std::size_t ScanWatch::*part,
                                 double most, const char* meaning) {
    Alarm alarm{.first = scans.front().scan, .last = scans.back().scan};
    std::size_t count = 0, all = 0;
    double worst = -1.0;
    for (const ScanWatch& s : scans) {
        count += s.*part;
        all += s.points;
        if (share(s.*part, s.points) <= worst) continue;
        worst = share(s.*part, s.points);
        alarm.worst = s.scan;
    }
    if (share(count, all) < most) return std::nullopt;
    alarm.what = fmt::format("{:.0f} % of all points are {}", 100.0 * share(count, all), meaning);
    return alarm;
}

std::string centimetres(double metres) { return fmt::format("{:.1f} cm", 100.0 * metres); }

}  // namespace

ScanWatch watch_scan(std::size_t scan, const Points& points, const Pose& T_world_sensor,
                     const Labels& labels) {
    ScanWatch watch{.scan = scan};
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (!is_measured(points[i])) continue;
        ++watch.points;
        watch.dynamic += labels[i] == Label::dynamic ? 1 : 0;
        watch.unknown += labels[i] == Label::unknown ? 1 : 0;
    }
    const std::vector<Seen> seen = seen_from_above(points, T_world_sensor, labels);
    Raster low;
    low.fill(kNothing);
    struct Part {
        std::size_t cell = 0;
        float high = -kNothing;
        int points = 0, gone = 0;
    };
    std::vector<Part> parts(low.size() * kFine * kFine);
    for (const Seen& s : seen) {
        low[s.cell()] = std::min(low[s.cell()], s.height);
        Part& part = parts[s.part()];
        part.cell = s.cell();
        part.high = std::max(part.high, s.height);
        ++part.points;
        part.gone += s.is_gone ? 1 : 0;
    }
    keep_ground(low);
    for (const Part& part : parts) {
        // Where something stands on the ground, its foot is not told from it.
        const float ground = low[part.cell];
        const bool is_ground = ground < kNothing && part.high < ground + kThick;
        if (part.points == 0 || !is_ground) continue;
        ++watch.ground;
        watch.ground_gone += 2 * part.gone > part.points ? 1 : 0;
    }
    return watch;
}

std::optional<Alarm> ground_alarm(std::span<const ScanWatch> scans) {
    constexpr double kMuch = 0.15;           // of the ground of a scan
    constexpr std::size_t kFewGround = 100;  // parts of the ground, 25 m2
    constexpr double kMany = 0.05;           // of the scans
    constexpr std::size_t kLeast = 3;        // scans
    Alarm alarm;
    std::size_t count = 0, first = 0, ground = 0, gone = 0;
    double most = 0.0;
    for (std::size_t i = 0; i < scans.size(); ++i) {
        ground += scans[i].ground;
        gone += scans[i].ground_gone;
        if (ground < kFewGround) continue;
        const double lost = share(std::exchange(gone, 0), std::exchange(ground, 0));
        const std::size_t begin = std::exchange(first, i + 1);
        if (lost < kMuch) continue;
        if (count == 0) alarm.first = scans[begin].scan;
        count += i + 1 - begin;
        alarm.last = scans[i].scan;
        if (lost > most) alarm.worst = scans[i].scan;
        most = std::max(most, lost);
    }
    if (count < kLeast || share(count, scans.size()) < kMany) return std::nullopt;
    alarm.what =
        fmt::format("{} of {} scans lose more than {:.0f} % of their ground, up to {:.0f} %", count,
                    scans.size(), 100.0 * kMuch, 100.0 * most);
    return alarm;
}

std::vector<Alarm> alarms_of(std::span<const ScanWatch> scans) {
    constexpr double kMostDynamic = 0.4, kMostUnknown = 0.3;  // shares of all points
    constexpr std::size_t kFewScans = 10;                     // of which much may stay unknown
    std::vector<Alarm> alarms;
    const auto add = [&](std::optional<Alarm> alarm) {
        if (alarm) alarms.push_back(*std::move(alarm));
    };
    if (scans.size() < kFewScans) return alarms;
    add(ground_alarm(scans));
    if (alarms.empty()) add(share_alarm(scans, &ScanWatch::dynamic, kMostDynamic, "removed"));
    add(share_alarm(scans, &ScanWatch::unknown, kMostUnknown,
                    "unknown: no other scan hit their places or looked through them"));
    return alarms;
}

Alarm explain(Alarm alarm, const Recording& used, PosesFrom from, const OdometryConfig& config) {
    const MotionQuality quality = measure_motion_at(used, alarm.worst, config);
    if (quality.has_bad_poses()) {
        alarm.what += fmt::format(
            "; there, scans blur by {} at the poses of the run and by {} at "
            "those of odometry over a few scans, so the poses are wrong",
            centimetres(quality.given.least()), centimetres(quality.found.least()));
        alarm.advice = from == PosesFrom::given     ? "--refine on"
                       : from == PosesFrom::refined ? "--poses none"
                                                    : "give poses with --poses FILE";
        return alarm;
    }
    if (!used.info().deskewed && quality.found.is_distorted()) {
        alarm.what += "; there, scans are sharper with the motion during each of them undone";
        alarm.advice = "--deskew on";
        return alarm;
    }
    if (!quality.shows_motion()) {
        alarm.what += "; there, scans do not show how far the sensor went";
        alarm.advice = from == PosesFrom::given ? "check the poses of these scans"
                                                : "give poses with --poses FILE";
        return alarm;
    }
    alarm.what += "; there, neighbouring scans fit the poses of the run";
    alarm.advice =
        "look at these scans in report.html: poses may be off between passages of the same place, "
        "the points may be those of several sensors, or the format may have been misread; "
        "--first and --last leave scans out";
    return alarm;
}

std::string to_text(const Alarm& alarm, const Recording& recording) {
    return fmt::format("scans {} to {}: {}", stem(recording, alarm.first),
                       stem(recording, alarm.last), alarm.what);
}

}  // namespace dynamic_filter::io
