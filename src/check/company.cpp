// SPDX-License-Identifier: MIT
#include "check/company.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace dynamic_filter::io {
namespace {

constexpr std::size_t kSectors = DynamicBeside::kSectors;
constexpr double kNearest = 0.5, kFarthest = 5.0;  // [m] from the sensor
constexpr std::size_t kFewPoints = 5;
constexpr double kStep = 0.5;          // [m] from one counted scan to the next
constexpr std::size_t kFewScans = 20;  // 10 m of way
constexpr double kAlways = 0.9;        // of the scans, on the side of the company
constexpr double kElsewhere = 0.3;     // of the scans, on the side with the median

/// One side: a sector and those beside it.
std::array<std::size_t, 3> side_of(std::size_t sector) {
    return {(sector + kSectors - 1) % kSectors, sector, (sector + 1) % kSectors};
}

/// The scans at least kStep from each other: a sensor that rests sees the same place all the time.
std::vector<const DynamicBeside*> on_the_way(std::span<const DynamicBeside> scans) {
    std::vector<const DynamicBeside*> chosen;
    for (const DynamicBeside& scan : scans) {
        if (chosen.empty() || (scan.sensor - chosen.back()->sensor).norm() >= kStep) {
            chosen.push_back(&scan);
        }
    }
    return chosen;
}

}  // namespace

DynamicBeside dynamic_beside(const Points& points, const Pose& T_world_sensor,
                             const Labels& labels) {
    DynamicBeside beside;
    beside.sensor = T_world_sensor.translation();
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (labels[i] != Label::dynamic) continue;
        const double distance = std::hypot(points[i].x(), points[i].y());
        if (!(distance >= kNearest && distance <= kFarthest)) continue;
        const double turn =
            std::atan2(points[i].y(), points[i].x()) / (2.0 * std::numbers::pi) + 1.0;
        const std::size_t sector = static_cast<std::size_t>(turn * kSectors) % kSectors;
        ++beside.points[sector];
        beside.distance[sector] += distance;
    }
    return beside;
}

std::optional<std::string> company_of(std::span<const DynamicBeside> scans) {
    const std::vector<const DynamicBeside*> way = on_the_way(scans);
    if (way.size() < kFewScans) return std::nullopt;
    std::array<std::size_t, kSectors> seen{};
    for (const DynamicBeside* scan : way) {
        for (std::size_t s = 0; s < kSectors; ++s) {
            std::size_t points = 0;
            for (const std::size_t k : side_of(s)) points += scan->points[k];
            seen[s] += points >= kFewPoints ? 1 : 0;
        }
    }
    const auto most =
        static_cast<std::size_t>(std::max_element(seen.begin(), seen.end()) - seen.begin());
    std::array<std::size_t, kSectors> sorted = seen;
    std::sort(sorted.begin(), sorted.end());
    const auto all = static_cast<double>(way.size());
    const double share = static_cast<double>(seen[most]) / all;
    if (share < kAlways || static_cast<double>(sorted[kSectors / 2]) > kElsewhere * all) {
        return std::nullopt;
    }
    double distance = 0.0;
    std::size_t points = 0;
    for (const DynamicBeside* scan : way) {
        for (const std::size_t k : side_of(most)) {
            distance += scan->distance[k];
            points += scan->points[k];
        }
    }
    return fmt::format(
        "something that moves goes along with the sensor, such as a person who follows: in {:.0f} "
        "% "
        "of the scans on the way, about {:.1f} m from it, at {:.0f} deg counterclockwise from its "
        "x axis; it is removed with all else that moves",
        100.0 * share, distance / static_cast<double>(points),
        (static_cast<double>(most) + 0.5) * 360.0 / kSectors);
}

}  // namespace dynamic_filter::io
