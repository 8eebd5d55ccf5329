// SPDX-License-Identifier: MIT
#include "check/company.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/numbers.hpp"
#include "geometry/angle.hpp"

namespace dynamic_filter::io {
namespace {

constexpr std::size_t kSectors = DynamicBeside::kSectors;
constexpr double kNearest = 0.5, kFarthest = 5.0;  // [m] from the sensor
constexpr std::size_t kFewPoints = 5;
constexpr double kStep = 0.5;          // [m] from one counted scan to the next
constexpr std::size_t kFewScans = 20;  // 10 m of way
constexpr double kAlways = 0.9;        // of the scans, on the side of the company
constexpr double kSways = 0.15;        // [m] deviation of its places, in the sensor frame
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
        const double turn = angle_of(points[i].y(), points[i].x()) / (2.0 * std::numbers::pi) + 1.0;
        const std::size_t sector = static_cast<std::size_t>(turn * kSectors) % kSectors;
        ++beside.points[sector];
        beside.sums.col(static_cast<Eigen::Index>(sector)) += points[i].head<2>().cast<double>();
    }
    return beside;
}

std::optional<std::string> company_of(std::span<const DynamicBeside> scans) {
    const std::vector<const DynamicBeside*> way = on_the_way(scans);
    if (way.size() < kFewScans) return std::nullopt;
    std::array<std::vector<Eigen::Vector2d>, kSectors> places;  // one per scan that shows something
    for (const DynamicBeside* scan : way) {
        for (std::size_t s = 0; s < kSectors; ++s) {
            std::size_t points = 0;
            Eigen::Vector2d sum = Eigen::Vector2d::Zero();
            for (const std::size_t k : side_of(s)) {
                points += scan->points[k];
                sum += scan->sums.col(static_cast<Eigen::Index>(k));
            }
            if (points >= kFewPoints) places[s].emplace_back(sum / static_cast<double>(points));
        }
    }
    std::vector<double> shares;  // of the scans on the way
    for (const auto& of_side : places) {
        shares.push_back(static_cast<double>(of_side.size()) / static_cast<double>(way.size()));
    }
    const auto most = std::max_element(shares.begin(), shares.end());
    if (*most < kAlways || median(shares) > kElsewhere) return std::nullopt;
    const auto& company = places[static_cast<std::size_t>(most - shares.begin())];
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    for (const auto& place : company) mean += place / static_cast<double>(company.size());
    double deviation = 0.0;
    for (const auto& place : company) deviation += (place - mean).squaredNorm();
    if (std::sqrt(deviation / static_cast<double>(company.size())) < kSways) return std::nullopt;
    return fmt::format(
        "something that moves goes along with the sensor, such as a person who follows: in {:.0f} "
        "% of the scans on the way, around x {:.1f} m, y {:.1f} m from the sensor; it is removed "
        "with all else that moves",
        100.0 * *most, mean.x(), mean.y());
}

}  // namespace dynamic_filter::io
