// SPDX-License-Identifier: MIT
/// Counts the things that rest during a drive but are absent from another (parked cars, fences)
/// which a result has found, in recordings of `dynamicfilter simulate city`.
///   parked TRUTH OUT [LEAST_POINTS RANGE SHARE]
/// TRUTH holds the drives, and OUT the result of all (OUT/drives/NAME/labels); or TRUTH is one
/// drive, and OUT the result of one recording (OUT/labels). A thing with at least LEAST_POINTS (50)
/// points within RANGE (40 m) in a drive counts as found there if at least SHARE (0.5) of these
/// points are labelled dynamic. Prints a Markdown table with a row per drive, also of the shares of
/// all such points and of the points of moving things that are labelled dynamic.
///
/// Not every such thing can be found: another car may stand in its place, a fence may hide it, or
/// no other drive came by. So things whose place another drive saw through are counted apart: of
/// the beams of a drive without the thing that pass its middle within 0.4 m, from within 12 m, at
/// least 40 end behind it, and four times as many as in it or before it. Every fourth scan is
/// looked at.
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/natural_order.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/recording.hpp"

using namespace dynamic_filter;
namespace fs = std::filesystem;

namespace {

struct Rule {
    double least_points = 50.0, range = 40.0, share = 0.5;
};

struct Count {
    std::size_t points = 0, found = 0;

    void add(bool is_found) { ++points, found += is_found ? 1 : 0; }
    [[nodiscard]] double share() const {
        return points == 0 ? 0.0 : static_cast<double>(found) / static_cast<double>(points);
    }
};

struct Thing {
    Count near;                                     ///< its points within the range
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();  ///< [m] of their coordinates in the world
    bool is_seen_through = false;                   ///< its place, by another drive

    [[nodiscard]] Eigen::Vector3d middle() const { return sum / static_cast<double>(near.points); }
};

struct Row {
    std::map<std::uint32_t, Thing> things;  ///< by number
    Count resting, moving;                  ///< points
};

/// The values of a label file, with the numbers in the upper 16 bits.
std::vector<std::uint32_t> raw_labels(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
    if (!stream) throw InputError(file, "", "cannot be read");
    std::vector<std::uint32_t> out(bytes.size() / sizeof(std::uint32_t));
    std::memcpy(out.data(), bytes.data(), out.size() * sizeof(std::uint32_t));
    return out;
}

void check_sizes(const fs::path& file, std::size_t expected, std::size_t got) {
    if (expected != got)
        throw InputError(file, "", fmt::format("has {} labels, expected {}", got, expected));
}

Row measure(const fs::path& drive, const fs::path& labels, const Rule& rule) {
    constexpr std::uint32_t temporary = 259, moving = 251, low = 0xffff;
    const io::Recording recording = io::open_recording(drive);
    Row row;
    for (std::size_t i = 0; i < recording.size(); ++i) {
        const std::string name = io::stem(recording, i) + ".label";
        const io::FullScan scan = recording.read(i);
        const Points& points = scan.points;
        const std::vector<std::uint32_t> truth = raw_labels(drive / "labels" / name);
        const Labels result = io::read_labels(labels / name);
        check_sizes(drive / "labels" / name, points.size(), truth.size());
        check_sizes(labels / name, points.size(), result.size());
        for (std::size_t k = 0; k < points.size(); ++k) {
            const bool found = result[k] == Label::dynamic;
            if ((truth[k] & low) == moving) row.moving.add(found);
            if ((truth[k] & low) != temporary) continue;
            row.resting.add(found);
            if (static_cast<double>(points[k].norm()) > rule.range) continue;
            Thing& thing = row.things[truth[k] >> 16U];
            thing.near.add(found);
            thing.sum += scan.T_world_sensor * points[k].cast<double>();
        }
    }
    std::erase_if(row.things, [&](const auto& entry) {
        return static_cast<double>(entry.second.near.points) < rule.least_points;
    });
    return row;
}

/// Beams past the middle of a thing that is not there.
struct Passing {
    Thing* thing;
    std::size_t through = 0, blocked = 0;
};

/// Counts the beams of a scan that pass the place within 0.4 m.
void count_beams(const Points& points, const Eigen::Vector3d& place, Passing& passing) {
    const Eigen::Vector3f at = place.cast<float>();
    for (const Point& point : points) {
        const float range = point.norm();
        const float along = range > 0.0F ? point.dot(at) / range : 0.0F;
        if (along <= 0.0F || at.squaredNorm() - along * along > 0.4F * 0.4F) continue;
        ++(range > along + 0.6F ? passing.through : passing.blocked);
    }
}

/// Marks the things of `row` whose place the drive saw through.
void look_through(const fs::path& drive, const Row& of_drive, Row& row) {
    std::vector<Passing> absent;
    for (auto& [number, thing] : row.things) {
        if (!of_drive.things.contains(number)) absent.push_back({.thing = &thing});
    }
    const io::Recording recording = io::open_recording(drive);
    for (std::size_t i = 0; i < recording.size(); i += 4) {
        const Pose T_sensor_world = recording.info().T_world_sensor[i].inverse();
        std::optional<io::FullScan> scan;
        for (Passing& passing : absent) {
            const Eigen::Vector3d place = T_sensor_world * passing.thing->middle();
            if (place.norm() > 12.0) continue;
            if (!scan) scan = recording.read(i);
            count_beams(scan->points, place, passing);
        }
    }
    for (const Passing& p : absent) {
        p.thing->is_seen_through |= p.through >= 40 && p.through >= 4 * p.blocked;
    }
}

void print(const std::string& name, const Row& row, const Rule& rule) {
    Count all, seen_through;
    for (const auto& [number, thing] : row.things) {
        const bool found = thing.near.share() >= rule.share;
        all.add(found);
        if (thing.is_seen_through) seen_through.add(found);
    }
    fmt::print("| {} | {} | {} | {:.1f} | {} | {} | {:.1f} | {:.1f} | {:.1f} |\n", name, all.points,
               all.found, 100.0 * all.share(), seen_through.points, seen_through.found,
               100.0 * seen_through.share(), 100.0 * row.resting.share(),
               100.0 * row.moving.share());
}

void compare(const fs::path& truth, const fs::path& out, const Rule& rule) {
    fmt::print(
        "| drive | resting things | found | found [%] | seen through by another drive | found | "
        "found [%] | their points [%] | moving points [%] |\n"
        "|---|---|---|---|---|---|---|---|---|\n");
    if (fs::exists(truth / "labels")) {
        return print(truth.filename().string(), measure(truth, out / "labels", rule), rule);
    }
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(truth)) {
        if (fs::exists(entry.path() / "labels")) names.push_back(entry.path().filename());
    }
    if (names.empty())
        throw InputError(truth, "", "holds no recording with labels, expected drive_1");
    std::sort(names.begin(), names.end(),
              [](const std::string& a, const std::string& b) { return io::natural_less(a, b); });
    std::vector<Row> rows;
    for (const std::string& name : names) {
        rows.push_back(measure(truth / name, out / "drives" / name / "labels", rule));
    }
    for (std::size_t d = 0; d < names.size(); ++d) {
        for (std::size_t other = 0; other < names.size(); ++other) {
            if (other != d) look_through(truth / names[other], rows[other], rows[d]);
        }
        print(names[d], rows[d], rule);
    }
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3 && argc != 6) {
        fmt::print(stderr, "usage: parked TRUTH OUT [LEAST_POINTS RANGE SHARE]\n");
        return 2;
    }
    try {
        Rule rule;
        if (argc == 6) {
            rule = {std::stod(argv[3]), std::stod(argv[4]), std::stod(argv[5])};
        }
        compare(argv[1], argv[2], rule);
    } catch (const std::exception& error) {
        fmt::print(stderr, "parked: {}\n", error.what());
        return 1;
    }
}
