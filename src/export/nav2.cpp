// SPDX-License-Identifier: MIT
/// `convert --to nav2`: a map as map_server of nav2 and of ROS 1 reads it.
#include <fmt/format.h>

#include <algorithm>

#include "base/output_folder.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/file.hpp"
#include "export/outputs.hpp"
#include "navigation/survey.hpp"

namespace dynamic_filter::app {

namespace {

/// The rectangle that holds all cells that are not unknown.
Area known_area(const NavigationMap& map) {
    const Area& all = map.area;
    int x0 = all.x + all.width, y0 = all.y + all.height, x1 = all.x, y1 = all.y;
    for (int y = all.y; y < all.y + all.height; ++y) {
        for (int x = all.x; x < all.x + all.width; ++x) {
            if (map.cells[all.index(x, y)] == Passage::unknown) continue;
            x0 = std::min(x0, x), x1 = std::max(x1, x + 1);
            y0 = std::min(y0, y), y1 = std::max(y1, y + 1);
        }
    }
    return {x0, y0, x1 - x0, y1 - y0};
}

/// Binary PGM. The first row is the one with the largest y.
std::string pgm_of(const NavigationMap& map, const Area& part) {
    constexpr char kFree = static_cast<char>(254), kOccupied = 0, kUnknown = static_cast<char>(205);
    std::string text = fmt::format("P5\n{} {}\n255\n", part.width, part.height);
    text.reserve(text.size() + part.size());
    for (int y = part.y + part.height - 1; y >= part.y; --y) {
        for (int x = part.x; x < part.x + part.width; ++x) {
            const Passage cell = map.cells[map.area.index(x, y)];
            text += cell == Passage::free       ? kFree
                    : cell == Passage::occupied ? kOccupied
                                                : kUnknown;
        }
    }
    return text;
}

/// With a larger free_thresh, unknown cells would load as free.
std::string yaml_of(const Area& part, const Survey& survey) {
    return fmt::format(
        "image: map.pgm\nmode: trinary\nresolution: {}\norigin: [{:.4f}, {:.4f}, 0]\nnegate: 0\n"
        "occupied_thresh: 0.65\nfree_thresh: 0.196\n",
        survey.cell(), survey.origin().x() + part.x * survey.cell(),
        survey.origin().y() + part.y * survey.cell());
}

constexpr double kUsualCell = 0.05, kWidestCell = 0.25;  // [m]

class Nav2Sink final : public Sink {
public:
    explicit Nav2Sink(const ConvertOptions& o)
        : options_(o),
          output_(o.output, nav2_files(), replaced_if(o.overwrite)),
          survey_(o.cell > 0.0 ? o.cell : kUsualCell) {
        if (o.cell > kWidestCell) {
            throw ConfigError(fmt::format(
                "--cell {}: cells of a map for nav2 are at most {} m wide", o.cell, kWidestCell));
        }
        if (o.robot_height > o.step) return;
        throw ConfigError(fmt::format("--robot-height {} must be greater than --step {}",
                                      o.robot_height, o.step));
    }

    void append(const io::FullScan& scan, const Labels& labels, const std::string&) override {
        require_labels(labels, "--to nav2");
        survey_.add(scan.points, labels, scan.T_world_sensor, scan.stamp);
    }

    std::string commit() override {
        const NavigationMap map = survey_.map(
            {static_cast<float>(options_.robot_height), static_cast<float>(options_.step)},
            options_.storey);
        check(map);
        const Area part = known_area(map);
        io::write_file(output_.path() / "map.pgm", pgm_of(map, part));
        io::write_file(output_.path() / "map.yaml", yaml_of(part, survey_));
        output_.commit();
        return summary(map);
    }

private:
    void check(const NavigationMap& map) const {
        if (!map.has_free_cell()) {
            throw ConfigError(
                "no floor was seen below the sensor, so there is no map to drive on; z of the "
                "poses "
                "must point up");
        }
        constexpr double kSomewhere = 1.0;  // [m2]
        const double overlap =
            static_cast<double>(map.floor.overlapping) * survey_.cell() * survey_.cell();
        if (options_.storey > 0 || overlap < kSomewhere || map.floor.storeys.size() < 2) return;
        throw ConfigError(fmt::format(
            "{} storeys lie one above the other, and one map can hold one of them; --storey 1 is "
            "the lowest",
            map.floor.storeys.size()));
    }
    [[nodiscard]] std::string summary(const NavigationMap& map) const {
        const auto area_of_kind = [&](Passage kind) {
            const auto count = std::count(map.cells.begin(), map.cells.end(), kind);
            return static_cast<double>(count) * survey_.cell() * survey_.cell();
        };
        return fmt::format(
            "{:.0f} m2 are free and {:.0f} m2 occupied; the sensor is {:.2f} m above "
            "the floor",
            area_of_kind(Passage::free), area_of_kind(Passage::occupied), map.floor.sensor_height);
    }

    const ConvertOptions options_;
    OutputFolder output_;
    Survey survey_;
};

}  // namespace

const FolderFiles& nav2_files() {
    static const FolderFiles files{.files = {"map.yaml", "map.pgm"}};
    return files;
}

std::unique_ptr<Sink> make_nav2_sink(const ConvertOptions& o) {
    return std::make_unique<Nav2Sink>(o);
}

}  // namespace dynamic_filter::app
