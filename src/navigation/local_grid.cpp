// SPDX-License-Identifier: MIT
#include "navigation/local_grid.hpp"

#include <tsl/robin_set.h>

#include <algorithm>
#include <cmath>

#include "dynamic_filter/error.hpp"
#include "geometry/voxel.hpp"
#include "navigation/survey.hpp"

namespace dynamic_filter::app {

namespace {

constexpr std::size_t kMostScans = 40;
constexpr double kStorey = 2.0;     // [m] of height: what was seen farther up is another floor
constexpr double kOften = 0.25;     // [s] between scans
constexpr double kPlaceStep = 0.1;  // [m]

io::OccupancyCells square_around(const Eigen::Vector3d& place, double radius,
                                 const NavigationMap& map, const Survey& survey) {
    const double cell = survey.cell();
    const auto half = static_cast<int>(std::ceil(radius / cell));
    const Eigen::Vector3d in_map = (place - survey.origin()) / cell;
    const int x0 = static_cast<int>(std::floor(in_map.x())) - half;
    const int y0 = static_cast<int>(std::floor(in_map.y())) - half;
    io::OccupancyCells cells;
    cells.cell = cell;
    cells.width = cells.height = static_cast<std::uint32_t>(2 * half);
    cells.origin = survey.origin() + cell * Eigen::Vector3d(x0, y0, 0.0);
    cells.origin.z() = place.z() - static_cast<double>(map.floor.sensor_height);
    cells.values.reserve(static_cast<std::size_t>(4 * half * half));
    for (int y = y0; y < y0 + 2 * half; ++y) {
        for (int x = x0; x < x0 + 2 * half; ++x) {
            const Passage passage =
                map.area.holds(x, y) ? map.cells[map.area.index(x, y)] : Passage::unknown;
            cells.values.push_back(passage == Passage::free       ? std::int8_t{0}
                                   : passage == Passage::occupied ? std::int8_t{100}
                                                                  : std::int8_t{-1});
        }
    }
    return cells;
}

}  // namespace

/// One point of all scans for each voxel as wide as a cell, as if the newest scan had seen them: so
/// they are judged once, by what is known now.
Scan LocalGrid::united(const std::deque<Kept>& kept) const {
    const Scan& newest = *kept.back().scan;
    Scan all{{}, newest.T_world_sensor, newest.stamp, newest.index, true, {}};
    const auto inverse = static_cast<float>(1.0 / options_.cell);
    tsl::robin_set<VoxelKey, VoxelHash> taken;
    for (const Kept& k : kept) {
        const Eigen::Isometry3f T =
            (newest.T_world_sensor.inverse() * k.scan->T_world_sensor).cast<float>();
        for (const Point& point : k.scan->points) {
            const Point there = T * point;
            const auto voxel = cell_of(there, inverse);
            if (voxel && taken.insert(pack(*voxel)).second) all.points.push_back(there);
        }
    }
    return all;
}

/// One point for each voxel as wide as a cell, within the grid or the reach of free beams.
Scan LocalGrid::thinned(const Scan& scan) const {
    const auto reach = std::max(static_cast<float>(options_.radius), kFarthestLook);
    const auto inverse = static_cast<float>(1.0 / options_.cell);
    tsl::robin_set<VoxelKey, VoxelHash> taken;
    Scan thin{{}, scan.T_world_sensor, scan.stamp, scan.index, true, {}};
    for (const Point& point : scan.points) {
        if (!is_measured(point) || !(point.norm() <= reach)) continue;
        const auto voxel = cell_of(point, inverse);
        if (voxel && taken.insert(pack(*voxel)).second) thin.points.push_back(point);
    }
    return thin;
}

void LocalGrid::add(const Scan& scan) {
    {
        const std::lock_guard hold(lock_);
        const bool is_soon =
            !kept_.empty() && std::abs(scan.stamp - kept_.back().scan->stamp) < kOften;
        if (is_soon) return;
    }
    const auto thin = std::make_shared<const Scan>(thinned(scan));
    const Eigen::Vector3d place = scan.T_world_sensor.translation();
    const std::lock_guard hold(lock_);
    if (!kept_.empty() && !kept_.back().is_lasting) kept_.pop_back();
    kept_.push_back({thin, chooser_.chooses(place, scan.stamp)});
    const auto is_away = [&](const Eigen::Vector3d& other) {
        const Eigen::Vector3d way = other - place;
        return way.head<2>().norm() > options_.radius || std::abs(way.z()) > kStorey;
    };
    std::erase_if(kept_,
                  [&](const Kept& k) { return is_away(k.scan->T_world_sensor.translation()); });
    while (kept_.size() > kMostScans) kept_.pop_front();
    if (path_.empty() || (path_.back().place - place).norm() >= kPlaceStep) {
        path_.push_back({place, scan.stamp});
    }
    std::erase_if(path_, [&](const Place& p) { return is_away(p.place); });
}

void LocalGrid::clear() {
    const std::lock_guard hold(lock_);
    kept_.clear();
    path_.clear();
    chooser_ = {};
}

std::optional<io::OccupancyCells> LocalGrid::cells(const Judge& judge) const {
    std::deque<Kept> kept;
    std::deque<Place> path;
    {
        const std::lock_guard hold(lock_);
        kept = kept_;
        path = path_;
    }
    if (kept.empty()) return std::nullopt;
    Survey survey(options_.cell);
    auto next = path.begin();
    for (const Kept& k : kept) {
        for (; next != path.end() && next->stamp <= k.scan->stamp; ++next) survey.pass(next->place);
        survey.add_beams(k.scan->points, k.scan->T_world_sensor);
    }
    const Scan all = united(kept);
    survey.add_surfaces(all.points, judge(all).labels, all.T_world_sensor);
    try {
        const NavigationMap map = survey.map(options_.robot, 0);
        const bool has_floor =
            std::find(map.cells.begin(), map.cells.end(), Passage::free) != map.cells.end();
        if (!has_floor) return std::nullopt;
        return square_around(kept.back().scan->T_world_sensor.translation(), options_.radius, map,
                             survey);
    } catch (const ConfigError&) {  // no floor below the sensor yet
        return std::nullopt;
    }
}

}  // namespace dynamic_filter::app
