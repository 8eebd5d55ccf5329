// SPDX-License-Identifier: MIT
/// Measures how long it takes until an object that stood and left is out of the map, and until an
/// object that comes and stays is in it; with the word `grid` first, how long until the occupancy
/// grid of `live` has the place of who left free. Ten people stand on a circle in a walled yard:
/// five are there from the start and leave one after the other, five come one after the other.
/// Prints Markdown tables: seconds, and the share of the voxels of the person in the map at the
/// end.
#include <fmt/format.h>
#include <tsl/robin_set.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "dynamic_filter/filter.hpp"
#include "geometry/voxel.hpp"
#include "navigation/local_grid.hpp"
#include "sim/bodies.hpp"
#include "sim/lidar.hpp"
#include "sim/prototypes.hpp"

namespace {

using namespace dynamic_filter;

// [s] times at which one person leaves and one comes.
constexpr std::array kChanges = {5, 10, 20, 40, 60};
constexpr std::size_t kPeople = 2 * kChanges.size();
constexpr int kEnd = 150;          // [s]
constexpr int kRate = 5;           // scans per second
constexpr double kCircle = 7.0;    // [m] radius
constexpr double kGround = 0.05;   // [m] not on a boundary of voxels
constexpr float kPerMetre = 5.0F;  // voxels per metre
constexpr double kMost = 0.9;  // share of the voxels at which a person counts as gone, or as there

using Cells = tsl::robin_set<VoxelKey, VoxelHash>;

/// Whether the grid is free where a person stood: no cell is occupied, and few are unknown.
bool is_free(const io::OccupancyCells& cells, const Eigen::Vector2d& at) {
    constexpr double kFoot = 0.3, kFree = 0.9;  // [m], share of the cells
    std::size_t free = 0, all = 0;
    for (std::size_t i = 0; i < cells.values.size(); ++i) {
        const Eigen::Vector2d middle =
            cells.origin.head<2>() +
            cells.cell * Eigen::Vector2d(static_cast<double>(i % cells.width) + 0.5,
                                         static_cast<double>(i / cells.width) + 0.5);
        if ((middle - at).norm() >= kFoot) continue;
        if (cells.values[i] > 0) return false;
        ++all;
        free += cells.values[i] == 0 ? 1U : 0U;
    }
    return static_cast<double>(free) >= kFree * static_cast<double>(all);
}

/// Time from the change until the map shows it, and the share of the person's voxels in the map at
/// the end.
struct Delay {
    std::optional<int> seconds;
    std::optional<double> free;  // [s] until the grid is free there
    double share = 0.0;
};
using Delays = std::array<Delay, kPeople>;

bool leaves(std::size_t person) { return person % 2 == 0; }
int change(std::size_t person) { return kChanges[person / 2]; }
bool is_there(std::size_t person, double t) { return (t < change(person)) == leaves(person); }

Eigen::Vector2d place(std::size_t person) {
    const double angle = (static_cast<double>(person) + 0.5) * 2.0 * std::numbers::pi / kPeople;
    return kCircle * Eigen::Vector2d(std::cos(angle), std::sin(angle));
}

sim::Mesh yard() {
    sim::Mesh mesh;
    const auto box = [&](double x0, double y0, double z0, double x1, double y1, double z1) {
        sim::add_box(mesh, Eigen::Affine3d::Identity(),
                     {Eigen::Vector3d(x0, y0, z0), Eigen::Vector3d(x1, y1, z1)}, 0.4F);
    };
    box(-20, -20, -1, 20, 20, kGround);
    for (const double side : {-20.0, 20.0}) {
        box(side - 0.2, -20, 0, side + 0.2, 20, 4);
        box(-20, side - 0.2, 0, 20, side + 0.2, 4);
    }
    return mesh;
}

sim::Caster caster() {
    std::vector<sim::Part> parts;
    for (std::size_t i = 0; i < kPeople; ++i) {
        const auto more = sim::walker_parts(i);
        parts.insert(parts.end(), more.begin(), more.end());
    }
    return {yard(), sim::prototypes(), parts};
}

sim::Placements placements(double t) {
    const Eigen::Vector2d away(1000.0, 1000.0);  // out of range of the sensor
    sim::Placements out;
    for (std::size_t i = 0; i < kPeople; ++i) {
        const Eigen::Vector2d at = is_there(i, t) ? place(i) : away;
        sim::place_walker({}, {.position = at.cast<float>()}, kGround, out);
    }
    return out;
}

/// In the middle, or back and forth over 10 m at 1 m/s.
Pose sensor_pose(bool walking, double t) {
    constexpr double kWay = 10.0, kHeight = 0.8;
    const double phase = std::fmod(t, 2.0 * kWay);
    const double along = (phase < kWay ? phase : 2.0 * kWay - phase) - 0.5 * kWay;
    return Pose(Eigen::Translation3d(walking ? along : 0.0, 0.0, kHeight));
}

/// The person to whom a point belongs.
std::size_t nearest_person(const Eigen::Vector2d& p) {
    std::size_t nearest = 0;
    for (std::size_t i = 1; i < kPeople; ++i) {
        if ((place(i) - p).norm() < (place(nearest) - p).norm()) nearest = i;
    }
    return nearest;
}

/// Voxels that hold points of a person or of the yard.
struct Seen {
    std::array<Cells, kPeople> people;
    Cells yard;

    void add(const sim::Returns& scan, const Pose& T_world_sensor) {
        for (std::size_t i = 0; i < scan.points.size(); ++i) {
            const Eigen::Vector3d world = T_world_sensor * scan.points[i].cast<double>();
            const auto cell = cell_of(world.cast<float>(), kPerMetre);
            if (!cell) continue;
            const bool moves = sim::is_dynamic(scan.kinds[i]);
            (moves ? people[nearest_person(world.head<2>())] : yard).insert(pack(*cell));
        }
    }

    /// Share of the voxels that only this person has, which are in the map.
    [[nodiscard]] double share(std::size_t person, const std::vector<StaticVoxel>& map) const {
        Cells kept;
        for (const StaticVoxel& v : map)
            kept.insert(pack(*cell_of(v.center.cast<float>(), kPerMetre)));
        double own = 0.0, in = 0.0;
        for (const VoxelKey key : people[person]) {
            if (yard.contains(key)) continue;
            own += 1.0;
            in += kept.contains(key) ? 1.0 : 0.0;
        }
        return own > 0.0 ? in / own : 0.0;
    }
};

/// Gets the map around each person who has changed, and records the first second in which it shows
/// the change.
void ask(DynamicFilter& filter, const Seen& seen, int second, Delays& delays) {
    for (std::size_t i = 0; i < kPeople; ++i) {
        if (second < change(i)) continue;
        const Eigen::Vector2d at = place(i);
        const auto map = filter.local_static_map(Pose(Eigen::Translation3d(at.x(), at.y(), 1.0)));
        Delay& delay = delays[i];
        delay.share = seen.share(i, map);
        const bool shows = leaves(i) ? delay.share <= 1.0 - kMost : delay.share >= kMost;
        if (shows && !delay.seconds) delay.seconds = second - change(i);
    }
}

/// The same for the grid, of those who left within the last ten seconds.
void ask(const app::LocalGrid& grid, const DynamicFilter& filter, double t, Delays& delays) {
    constexpr double kLong = 10.0;  // [s]
    const auto is_due = [&](std::size_t i) {
        const double since = t - change(i);
        return leaves(i) && !delays[i].free && since >= 0.0 && since < kLong;
    };
    bool any = false;
    for (std::size_t i = 0; i < kPeople; ++i) any |= is_due(i);
    if (!any) return;
    const auto cells = grid.cells([&](const Scan& scan) { return filter.settled(scan); });
    for (std::size_t i = 0; i < kPeople; ++i) {
        if (is_due(i) && cells && is_free(*cells, place(i))) delays[i].free = t - change(i);
    }
}

Delays watch(const sim::Sensor& sensor, bool walking, bool of_grid) {
    Config config = preset("default");
    config.map.search_radius = 2.0;  // the requested map is that around one person
    DynamicFilter filter(config);
    sim::Caster rays = caster();
    Seen seen;
    Delays delays;
    app::LocalGrid grid(app::GridOptions{.radius = 12.0});
    for (int i = 0; i <= kEnd * kRate; ++i) {
        const double t = static_cast<double>(i) / kRate;
        const auto index = static_cast<std::size_t>(i);
        rays.place(placements(t));
        const Pose pose = sensor_pose(walking, t);
        sim::Returns scan = sim::sense(rays, sensor, pose, 1, index);
        seen.add(scan, pose);
        const Scan pushed{std::move(scan.points), pose, t, index};
        filter.push(pushed);
        if (of_grid) grid.add(pushed);
        if (of_grid) {
            ask(grid, filter, t, delays);
        } else if (i % kRate == 0) {
            ask(filter, seen, i / kRate, delays);
        }
    }
    return delays;
}

void print(const std::string& name, const Delays& delays, bool of_leaving) {
    std::string row = "| " + name + " |";
    for (std::size_t i = of_leaving ? 0 : 1; i < kPeople; i += 2) {
        const auto& [seconds, free, share] = delays[i];
        row += seconds ? fmt::format(" {}", *seconds) : fmt::format(" > {}", kEnd - change(i));
        row += fmt::format(" ({:.0f} %) |", 100.0 * share);
    }
    fmt::print("{}\n", row);
}

void print_head(const char* what) {
    fmt::print("| {} |", what);
    for (const int seconds : kChanges) fmt::print(" {} |", seconds);
    fmt::print("\n|---|---|---|---|---|---|\n");
}

void print_free(const std::string& name, const Delays& delays) {
    std::string row = "| " + name + " |";
    for (std::size_t i = 0; i < kPeople; i += 2) {
        const std::optional<double>& free = delays[i].free;
        row += free ? fmt::format(" {:.1f} |", *free) : std::string(" > 10 |");
    }
    fmt::print("{}\n", row);
}

}  // namespace

int main(int argc, char** argv) {
    std::vector<std::string> sensors(argv + 1, argv + argc);
    const bool of_grid = !sensors.empty() && sensors.front() == "grid";
    if (of_grid) sensors.erase(sensors.begin());
    std::vector<std::pair<std::string, Delays>> all;
    for (const sim::Sensor& sensor : sim::sensor_table()) {
        if (std::find(sensors.begin(), sensors.end(), sensor.name) == sensors.end()) continue;
        for (const bool walking : {false, true}) {
            all.emplace_back(sensor.name + (walking ? ", walking" : ", at rest"),
                             watch(sensor, walking, of_grid));
        }
    }
    if (all.empty()) {
        fmt::print(stderr, "usage: resting [grid] SENSOR ...\n");
        return 2;
    }
    if (of_grid) {
        print_head("stood for [s]");
        for (const auto& [name, delays] : all) print_free(name, delays);
        return 0;
    }
    for (const bool of_leaving : {true, false}) {
        print_head(of_leaving ? "stood for [s]" : "empty for [s]");
        for (const auto& [name, delays] : all) print(name, delays, of_leaving);
        fmt::print("\n");
    }
    return 0;
}
