// SPDX-License-Identifier: MIT
/// Draws the voxels of a run from above. `errors`: kept voxels in grey, lost static ones in blue,
/// kept dynamic ones in red. `submaps`: kept voxels in the color of the submap that decides them,
/// which is the nearest one, with the windows of preset `paper`.
#include <fmt/format.h>
#include <tsl/robin_map.h>

#include <algorithm>
#include <array>
#include <functional>
#include <string_view>
#include <vector>

#include "draw/png.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/settings.hpp"
#include "geometry/pose.hpp"
#include "geometry/voxel.hpp"
#include "paper/window.hpp"
#include "recording/scans.hpp"

namespace {

using namespace dynamic_filter;

constexpr float kVoxel = 0.2F;   // [m] voxels of the scores
constexpr float kFloor = -0.5F;  // [m] relative to the sensor; lower voxels are drawn paler
constexpr int kScale = 2;        // pixels per voxel
constexpr io::Color kBackground{255, 255, 255};

/// The contents of a voxel, and the result of the run.
struct Voxel {
    bool still = false, dynamic = false, kept = false;
    bool high = false;  // above the floor
};

using Voxels = tsl::robin_map<VoxelKey, Voxel, VoxelHash>;

/// How a voxel is drawn. Of several voxels above each other, the one with the highest rank is
/// visible.
struct Mark {
    int rank = 0;
    io::Color color = kBackground;
};

using Painter = std::function<Mark(const Point& center, const Voxel& voxel)>;

/// Voxels that hold both kinds are no errors, as in the scores: they are drawn if kept.
Mark error_mark(const Point&, const Voxel& v) {
    if (v.kept && !v.still) return {4, {214, 39, 40}};
    if (!v.kept && !v.dynamic) return {3, {31, 119, 180}};
    if (!v.kept) return {};
    return v.high ? Mark{2, {120, 120, 120}} : Mark{1, {215, 215, 215}};
}

io::Color paler(io::Color color) {
    for (std::uint8_t& c : color) c = static_cast<std::uint8_t>((c + 2 * 255) / 3);
    return color;
}

std::vector<Point> submap_positions(const io::Recording& recording) {
    std::vector<Point> positions;
    const Config paper = preset("paper");
    WindowCutter cutter(paper.keyframe, paper.submap.keyframes);
    const auto add = [&](const std::optional<Window>& window) {
        if (!window) return;
        std::vector<Pose> poses;
        for (const Scan& scan : window->scans) poses.push_back(scan.T_world_sensor);
        positions.emplace_back(mean_pose(poses).translation().cast<float>());
    };
    for (std::size_t i = 0; i < recording.size(); ++i) {
        add(cutter.push({{}, recording.info().T_world_sensor[i], recording.info().stamps[i], i}));
    }
    add(cutter.flush());
    return positions;
}

Painter by_submap(const io::Recording& recording) {
    static constexpr std::array<io::Color, 8> kColors{{{31, 119, 180},
                                                       {255, 127, 14},
                                                       {44, 160, 44},
                                                       {214, 39, 40},
                                                       {148, 103, 189},
                                                       {140, 86, 75},
                                                       {227, 119, 194},
                                                       {188, 189, 34}}};
    return [positions = submap_positions(recording)](const Point& center, const Voxel& v) -> Mark {
        if (!v.kept) return {};
        const auto nearest = std::min_element(
            positions.begin(), positions.end(), [&](const Point& a, const Point& b) {
                return (a - center).squaredNorm() < (b - center).squaredNorm();
            });
        const auto submap = static_cast<std::size_t>(nearest - positions.begin());
        const io::Color color = kColors[submap % kColors.size()];
        return v.high ? Mark{2, color} : Mark{1, paler(color)};
    };
}

void add(Voxels& voxels, const io::FullScan& scan, const Labels& verdict) {
    if (verdict.size() != scan.points.size()) {
        throw ConfigError("a scan and its labels differ in number: are they of one recording?");
    }
    const Points world = app::shifted_world(scan, Eigen::Vector3d::Zero());
    const auto floor = static_cast<float>(scan.T_world_sensor.translation().z()) + kFloor;
    for (std::size_t i = 0; i < world.size(); ++i) {
        if (!is_measured(scan.points[i]) || scan.truth[i] == Label::unknown) continue;
        const auto cell = cell_of(world[i], 1.0F / kVoxel);
        if (!cell) continue;
        Voxel& voxel = voxels[pack(*cell)];
        (scan.truth[i] == Label::dynamic ? voxel.dynamic : voxel.still) = true;
        voxel.kept |= verdict[i] != Label::dynamic;
        voxel.high |= world[i].z() > floor;
    }
}

using Columns = tsl::robin_map<VoxelKey, Mark, VoxelHash>;

Columns from_above(const Voxels& voxels, const Painter& paint) {
    Columns columns;
    for (const auto& [key, voxel] : voxels) {
        const Cell cell = unpack(key);
        Mark& mark = columns[pack({cell.x(), cell.y(), 0})];
        const Mark now = paint(center(key, kVoxel), voxel);
        if (now.rank > mark.rank) mark = now;
    }
    return columns;
}

/// Range of all values except a few outliers.
std::pair<int, int> span(std::vector<int> values) {
    std::sort(values.begin(), values.end());
    const std::size_t few = values.size() / 500;
    return {values[few], values[values.size() - 1 - few]};
}

io::Image draw(const Columns& columns) {
    if (columns.empty())
        throw ConfigError("nothing to draw: no point with ground truth near the origin");
    std::vector<int> xs, ys;
    for (const auto& [key, mark] : columns) {
        xs.push_back(unpack(key).x());
        ys.push_back(unpack(key).y());
    }
    const auto [x0, x1] = span(xs);
    const auto [y0, y1] = span(ys);
    io::Image image{kScale * (x1 - x0 + 1), kScale * (y1 - y0 + 1), {}};
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const auto found = columns.find(pack({x0 + x / kScale, y1 - y / kScale, 0}));
            image.pixels.push_back(found == columns.end() ? kBackground : found->second.color);
        }
    }
    return image;
}

}  // namespace

int main(int argc, char** argv) {
    const std::vector<std::string_view> words(argv + 1, argv + argc);
    if (words.size() != 4 || (words[0] != "errors" && words[0] != "submaps")) {
        fmt::print(stderr, "usage: map_picture errors|submaps RECORDING RUN PNG\n");
        return 2;
    }
    try {
        const io::Recording recording = io::open_recording(words[1]);
        if (!recording.info().has_truth()) throw ConfigError("the recording has no ground truth");
        const Painter paint = words[0] == "errors" ? error_mark : by_submap(recording);
        const std::filesystem::path labels = std::filesystem::path(words[2]) / "labels";
        Voxels voxels;
        for (std::size_t i = 0; i < recording.size(); ++i) {
            add(voxels, recording.read(i),
                io::read_labels(labels / (io::stem(recording, i) + ".label")));
        }
        io::write_png(words[3], draw(from_above(voxels, paint)));
        return 0;
    } catch (const Error& error) {
        fmt::print(stderr, "map_picture: {}\n", error.what());
        return 2;
    }
}
