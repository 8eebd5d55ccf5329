// SPDX-License-Identifier: MIT
/// Shows for which kinds of surfaces, people and vehicles the final verdicts are wrong. Simulates a
/// scene, filters it, and prints Markdown tables.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "bench/parse_number.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/online.hpp"
#include "dynamic_filter/scores.hpp"
#include "dynamic_filter/simulation.hpp"
#include "geometry/voxel_index.hpp"

namespace {

using namespace dynamic_filter;
using sim::kind_names;

constexpr double kVoxel = 0.2;  // [m] voxels of the scores, independent of those of the filter
constexpr std::size_t kKinds = kind_names.size();

struct Arguments {
    sim::SimulationOptions scene;
    Config config;
};

Arguments read_arguments(const std::vector<std::string_view>& words) {
    if (words.size() < 5) {
        throw ConfigError(
            "usage: error_table PRESET SCENE SENSOR PEDESTRIANS SEED [KEY=VALUE ...]");
    }
    Arguments arguments;
    arguments.config = preset(words[0]);
    arguments.scene.scene = words[1];
    arguments.scene.sensor = words[2];
    arguments.scene.pedestrians = parse<int>("PEDESTRIANS", words[3]);
    arguments.scene.seed = parse<std::uint64_t>("SEED", words[4]);
    for (std::size_t i = 5; i < words.size(); ++i) {
        const std::size_t equals = words[i].find('=');
        if (equals == std::string_view::npos) {
            throw ConfigError(fmt::format("\"{}\" is not KEY=VALUE", words[i]));
        }
        set(arguments.config, words[i].substr(0, equals), words[i].substr(equals + 1));
    }
    return arguments;
}

/// The points of one voxel.
struct VoxelKinds {
    std::array<std::uint32_t, kKinds> points{};
    bool kept = false;  // true if at least one of the points is kept
};

/// The voxels of one kind.
struct Row {
    std::size_t voxels = 0, wrong = 0;
    void operator+=(const Row& other) { voxels += other.voxels, wrong += other.wrong; }
};

struct Table {
    std::array<Row, kKinds> rows{};
    std::size_t mixed = 0;

    /// Sum over all static or all dynamic kinds.
    [[nodiscard]] Row sum(bool dynamic) const {
        Row total;
        for (std::size_t k = 0; k < kKinds; ++k) {
            if (is_dynamic(sim::Kind{static_cast<std::uint8_t>(k)}) == dynamic) total += rows[k];
        }
        return total;
    }
};

Scan to_scan(const sim::SimulatedScan& scan, std::size_t index) {
    return {scan.points, scan.T_world_sensor, scan.stamp, index};
}

/// A person or a vehicle.
struct Instance {
    std::size_t points = 0, kept = 0, standing = 0;
    bool vehicle = false;
};

struct Tally {
    std::vector<VoxelKinds> voxels;
    std::vector<Instance> instances;  // indexed by their numbers
};

void count(Instance& instance, sim::Kind kind, Label verdict) {
    ++instance.points;
    instance.kept += verdict != Label::dynamic ? 1 : 0;
    instance.standing += kind == sim::Kind::standing ? 1 : 0;
    instance.vehicle = kind == sim::Kind::vehicle;
}

/// Simulates the scans a second time, because that needs less memory than keeping them.
Tally tally(sim::Simulation& simulation, const OnlineFilter& filter) {
    VoxelIndex index;
    Tally out;
    auto& [voxels, instances] = out;
    for (std::size_t i = 0; i < simulation.size(); ++i) {
        const sim::SimulatedScan scan = simulation.scan(i);
        const Labels verdict = filter.verdict(to_scan(scan, i)).labels;
        for (std::size_t p = 0; p < scan.points.size(); ++p) {
            const std::uint16_t instance = scan.instances[p];
            if (instance >= instances.size()) instances.resize(instance + 1U);
            if (instance > 0) count(instances[instance], scan.kinds[p], verdict[p]);
            const Eigen::Vector3d world = scan.T_world_sensor * scan.points[p].cast<double>();
            const auto cell = cell_of(world.cast<float>(), static_cast<float>(1.0 / kVoxel));
            if (!cell) continue;
            const std::uint32_t id = index.insert(pack(*cell));
            if (id == voxels.size()) voxels.emplace_back();
            ++voxels[id].points[static_cast<std::size_t>(scan.kinds[p])];
            voxels[id].kept |= verdict[p] != Label::dynamic;
        }
    }
    return out;
}

/// Voxels with both static and dynamic points are not counted, as with "excluded" in eval.
Table tabulate(const std::vector<VoxelKinds>& voxels) {
    constexpr auto first_dynamic = static_cast<std::ptrdiff_t>(sim::Kind::walking);
    Table table;
    for (const auto& [points, kept] : voxels) {
        const auto has_points = [](std::uint32_t n) { return n > 0; };
        const bool still = std::any_of(points.begin(), points.begin() + first_dynamic, has_points);
        const bool dynamic = std::any_of(points.begin() + first_dynamic, points.end(), has_points);
        if (still && dynamic) {
            ++table.mixed;
            continue;
        }
        const auto most = std::max_element(points.begin(), points.end()) - points.begin();
        table.rows[static_cast<std::size_t>(most)] += {1, kept == dynamic ? 1U : 0U};
    }
    return table;
}

double percent(std::size_t part, std::size_t whole) {
    return whole > 0 ? 100.0 * static_cast<double>(part) / static_cast<double>(whole) : 0.0;
}

void print_row(std::string_view name, std::string_view error, const Row& row, std::size_t errors) {
    fmt::print("| {:<11} | {:<12} | {:>8} | {:>7} | {:>9.2f} | {:>19.1f} |\n", name, error,
               row.voxels, row.wrong, percent(row.wrong, row.voxels), percent(row.wrong, errors));
}

void print(const Table& table) {
    const Row still = table.sum(false), dynamic = table.sum(true);
    const std::size_t errors = still.wrong + dynamic.wrong;
    fmt::print("| {:<11} | {:<12} | {:>8} | {:>7} | {:>9} | {:>19} |\n", "kind", "error", "voxels",
               "wrong", "wrong [%]", "share of errors [%]");
    fmt::print("|:{0:-<11}-|:{0:-<12}-|-{0:->8}:|-{0:->7}:|-{0:->9}:|-{0:->19}:|\n", "");
    for (std::size_t k = 0; k < kKinds; ++k) {
        if (table.rows[k].voxels == 0) continue;  // the scene has no such voxels
        const bool moves = is_dynamic(sim::Kind{static_cast<std::uint8_t>(k)});
        print_row(kind_names[k], moves ? "dynamic kept" : "static lost", table.rows[k], errors);
    }
    print_row("all static", "static lost", still, errors);
    print_row("all dynamic", "dynamic kept", dynamic, errors);

    const auto count = [](std::size_t n) { return static_cast<double>(n); };
    const auto score = eval::voxel_score(count(still.voxels), count(still.voxels - still.wrong),
                                         count(dynamic.voxels), count(dynamic.wrong));
    fmt::print("\nPR {:.2f} %, RR {:.2f} %, F1 {:.4f}; {} mixed voxels are left out\n",
               100.0 * score.pr.value_or(0.0), 100.0 * score.rr.value_or(0.0),
               score.f1.value_or(0.0), table.mixed);
}

/// Prints how much of each instance with at least 20 points is removed.
void print_instances(const std::vector<Instance>& instances) {
    constexpr std::size_t fewest = 20;
    fmt::print(
        "\n| instances          | number | points removed [%] | of 97 % or more | of less than "
        "half |\n"
        "|:-------------------|-------:|-------------------:|----------------:|------------------:|"
        "\n");
    const auto print_group = [&](std::string_view name, const auto& belongs) {
        std::size_t number = 0, whole = 0, poor = 0, points = 0, kept = 0;
        for (const Instance& i : instances) {
            if (i.points < fewest || !belongs(i)) continue;
            const double removed = 100.0 - percent(i.kept, i.points);
            ++number, points += i.points, kept += i.kept;
            whole += removed >= 97.0 ? 1 : 0;
            poor += removed < 50.0 ? 1 : 0;
        }
        if (number == 0) return;
        fmt::print("| {:<18} | {:>6} | {:>18.2f} | {:>15} | {:>17} |\n", name, number,
                   100.0 - percent(kept, points), whole, poor);
    };
    print_group("people who walk", [](const Instance& i) { return !i.vehicle && i.standing == 0; });
    print_group("people who halt", [](const Instance& i) { return !i.vehicle && i.standing > 0; });
    print_group("vehicles", [](const Instance& i) { return i.vehicle; });
}

}  // namespace

int main(int argc, char** argv) {
    try {
        const Arguments arguments = read_arguments({argv + 1, argv + argc});
        sim::Simulation simulation(arguments.scene);
        OnlineFilter filter(arguments.config,
                            {.overload = Overload::wait, .horizon = 0.0, .max_bytes = 0});
        for (std::size_t i = 0; i < simulation.size(); ++i) {
            filter.push(to_scan(simulation.scan(i), i));
        }
        filter.finish();
        const Tally counts = tally(simulation, filter);
        print(tabulate(counts.voxels));
        print_instances(counts.instances);
        return 0;
    } catch (const Error& error) {
        fmt::print(stderr, "error_table: {}\n", error.what());
        return 2;
    }
}
