// SPDX-License-Identifier: MIT
#include "navigation/local_grid.hpp"

#include <tsl/robin_map.h>

#include <algorithm>
#include <cmath>

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

/// Keeps the first point of each voxel, and counts those that lie in it.
class VoxelCounts {
public:
    explicit VoxelCounts(double voxel) : inverse_(static_cast<float>(1.0 / voxel)) {}

    void add(const Point& point, std::uint32_t count, Points& points,
             std::vector<std::uint32_t>& counts) {
        const auto voxel = cell_of(point, inverse_);
        if (!voxel) return;
        const auto next = static_cast<std::uint32_t>(points.size());
        const auto [at, is_new] = numbers_.try_emplace(pack(*voxel), next);
        if (is_new) {
            points.push_back(point);
            counts.push_back(count);
        } else {
            counts[at->second] += count;
        }
    }

private:
    float inverse_;
    tsl::robin_map<VoxelKey, std::uint32_t, VoxelHash> numbers_;
};

}  // namespace

bool LocalGrid::is_due(double stamp) const {
    const std::lock_guard hold(lock_);
    return kept_.empty() || std::abs(stamp - kept_.back().scan().stamp) >= kOften;
}

/// One point of all scans for each voxel as wide as a cell, as if the newest scan had seen them: so
/// they are judged once, by what is known now. Those beyond the grid tell nothing of it.
LocalGrid::Thinned LocalGrid::united(const std::deque<Kept>& kept) const {
    constexpr float kBeside = 2.0F;  // [m]
    const float reach = static_cast<float>(options_.radius) + kBeside;
    const Scan& newest = kept.back().scan();
    const Eigen::Matrix3f turn = newest.T_world_sensor.linear().cast<float>();
    Thinned all{{{}, newest.T_world_sensor, newest.stamp, newest.index, true, {}}, {}};
    VoxelCounts voxels(options_.cell);
    for (const Kept& k : kept) {
        const Eigen::Isometry3f T =
            (newest.T_world_sensor.inverse() * k.scan().T_world_sensor).cast<float>();
        for (std::size_t i = 0; i < k.scan().points.size(); ++i) {
            const Point there = T * k.scan().points[i];
            if ((turn * there).head<2>().cwiseAbs().maxCoeff() > reach) continue;
            voxels.add(there, k.thinned->counts[i], all.scan.points, all.counts);
        }
    }
    return all;
}

/// One point for each voxel as wide as a cell, within the grid or the reach of free beams.
LocalGrid::Thinned LocalGrid::thinned(const Scan& scan) const {
    const auto reach = std::max(static_cast<float>(options_.radius), kFarthestLook);
    Thinned thin{{{}, scan.T_world_sensor, scan.stamp, scan.index, true, {}}, {}};
    VoxelCounts voxels(options_.cell);
    for (const Point& point : scan.points) {
        if (!is_measured(point) || !(point.norm() <= reach)) continue;
        voxels.add(point, 1, thin.scan.points, thin.counts);
    }
    return thin;
}

void LocalGrid::add(const Scan& scan) {
    if (!is_due(scan.stamp)) return;
    const auto thin = std::make_shared<const Thinned>(thinned(scan));
    const Eigen::Vector3d place = scan.T_world_sensor.translation();
    const std::lock_guard hold(lock_);
    if (scan.index < first_index_) return;
    if (!kept_.empty() && !kept_.back().is_lasting) kept_.pop_back();
    kept_.push_back({thin, chooser_.chooses(place, scan.stamp)});
    const auto is_away = [&](const Eigen::Vector3d& other) {
        const Eigen::Vector3d way = other - place;
        return way.head<2>().norm() > options_.radius || std::abs(way.z()) > kStorey;
    };
    std::erase_if(kept_,
                  [&](const Kept& k) { return is_away(k.scan().T_world_sensor.translation()); });
    while (kept_.size() > kMostScans) kept_.pop_front();
    if (path_.empty() || (path_.back().place - place).norm() >= kPlaceStep) {
        path_.push_back({place, scan.stamp});
    }
    const double oldest = kept_.front().scan().stamp;
    std::erase_if(path_, [&](const Place& p) { return p.stamp < oldest || is_away(p.place); });
}

void LocalGrid::begin_world(std::size_t first_index) {
    const std::lock_guard hold(lock_);
    kept_.clear();
    path_.clear();
    chooser_ = {};
    first_index_ = first_index;
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
        for (; next != path.end() && next->stamp <= k.scan().stamp; ++next)
            survey.pass(next->place);
        survey.add_beams(k.scan().points, k.scan().T_world_sensor);
    }
    const Thinned all = united(kept);
    survey.add_surfaces(all.scan.points, judge(all.scan).labels, all.scan.T_world_sensor,
                        all.counts);
    const NavigationMap map = survey.map(options_.robot, 0);
    if (!map.has_free_cell()) return std::nullopt;  // no floor was seen
    return square_around(kept.back().scan().T_world_sensor.translation(), options_.radius, map,
                         survey);
}

}  // namespace dynamic_filter::app
