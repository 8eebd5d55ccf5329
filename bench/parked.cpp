// SPDX-License-Identifier: MIT
/// Counts the things that rest during a drive but are absent from another (parked cars, fences)
/// which a result has found, in recordings of `dynamicfilter simulate city`.
///   parked TRUTH OUT [LEAST_POINTS RANGE SHARE]
/// TRUTH holds the drives, and OUT the result of all (OUT/drives/NAME/labels); or TRUTH is one
/// drive, and OUT the result of one recording (OUT/labels). A thing with at least LEAST_POINTS (50)
/// points within RANGE (40 m) in a drive counts as found there if at least SHARE (0.5) of these
/// points are labelled dynamic. Prints a Markdown table with a row per drive, also of the shares of
/// all such points and of the points of moving things that are labelled dynamic.
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include "dynamic_filter/error.hpp"
#include "dynamic_filter/io/sequence.hpp"

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

struct Row {
    Count things, resting, moving;  ///< numbers of things; points; points
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
    const io::Sequence sequence = io::open_sequence(drive);
    Row row;
    std::map<std::uint32_t, Count> things;
    for (std::size_t i = 0; i < sequence.size(); ++i) {
        const std::string name = io::stem(sequence, i) + ".label";
        const Points points = io::read_frame(sequence, i).points;
        const std::vector<std::uint32_t> truth = raw_labels(drive / "labels" / name);
        const Labels result = io::read_labels(labels / name);
        check_sizes(drive / "labels" / name, points.size(), truth.size());
        check_sizes(labels / name, points.size(), result.size());
        for (std::size_t k = 0; k < points.size(); ++k) {
            const bool found = result[k] == Label::dynamic;
            if ((truth[k] & low) == moving) row.moving.add(found);
            if ((truth[k] & low) != temporary) continue;
            row.resting.add(found);
            if (static_cast<double>(points[k].norm()) <= rule.range)
                things[truth[k] >> 16U].add(found);
        }
    }
    for (const auto& [number, count] : things) {
        if (static_cast<double>(count.points) >= rule.least_points)
            row.things.add(count.share() >= rule.share);
    }
    return row;
}

void print(const std::string& name, const Row& row) {
    fmt::print("| {} | {} | {} | {:.1f} | {:.1f} | {:.1f} |\n", name, row.things.points,
               row.things.found, 100.0 * row.things.share(), 100.0 * row.resting.share(),
               100.0 * row.moving.share());
}

void compare(const fs::path& truth, const fs::path& out, const Rule& rule) {
    fmt::print(
        "| drive | resting things | found | found [%] | their points [%] | moving points [%] |\n"
        "|---|---|---|---|---|---|\n");
    if (fs::exists(truth / "labels")) {
        return print(truth.filename().string(), measure(truth, out / "labels", rule));
    }
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(truth)) {
        if (fs::exists(entry.path() / "labels")) names.push_back(entry.path().filename());
    }
    if (names.empty())
        throw InputError(truth, "", "holds no recording with labels, expected drive_1");
    std::sort(names.begin(), names.end(), io::natural_less);
    for (const std::string& name : names)
        print(name, measure(truth / name, out / "drives" / name / "labels", rule));
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
