// SPDX-License-Identifier: MIT
#include "page/tile_page.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/numbers.hpp"
#include "page/sampling.hpp"

namespace dynamic_filter::app {

namespace {

using nlohmann::ordered_json;

/// The square of a tile in units of level 0, so that tiles of all levels compare exactly.
struct GridSquare {
    std::int64_t west, south, east, north;
};

GridSquare units_of(const MapTile& tile) {
    const std::int64_t side = std::int64_t{1} << tile.level;
    return {tile.x * side, tile.y * side, (tile.x + 1) * side, (tile.y + 1) * side};
}

/// The side of `tile` that `other` touches; "" if it touches none.
std::string direction_of(const GridSquare& tile, const GridSquare& other) {
    const bool beside = other.south < tile.north && other.north > tile.south;
    const bool above = other.west < tile.east && other.east > tile.west;
    if (beside && other.west == tile.east) return "east";
    if (beside && other.east == tile.west) return "west";
    if (above && other.south == tile.north) return "north";
    return above && other.north == tile.south ? "south" : "";
}

ordered_json neighbours_of(const MapIndex& index, const MapTile& tile) {
    ordered_json list = ordered_json::array();
    const GridSquare square = units_of(tile);
    for (const MapTile& other : index.tiles) {
        const std::string direction = direction_of(square, units_of(other));
        if (!direction.empty()) list.push_back({{"name", other.name}, {"where", direction}});
    }
    return list;
}

/// Thins the points to at most `most`, and leaves out as few as possible. `spacing` becomes the
/// edge of the cubes [m] by which they are thinned; 0: all points are kept.
TilePoints shown_of(const TilePoints& points, double voxel_size, std::size_t most,
                    double& spacing) {
    constexpr double kGrowth = 1.4;
    spacing = 0.0;
    if (points.size() <= most) return points;
    TilePoints shown = points;
    for (spacing = kGrowth * voxel_size; shown.size() > most; spacing *= kGrowth)
        shown = thinned(points, spacing);
    spacing /= kGrowth;
    return shown;
}

std::uint8_t byte_of(double share) {
    return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(share, 0.0, 1.0)));
}

/// Positions are whole voxels from a corner, which packs well; in a larger square, coarser.
void add_positions(const TilePoints& points, const std::vector<std::size_t>& order,
                   double voxel_size, PageRun& run) {
    constexpr double kMost = 65535.0;
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& p : points.positions) box.extend(p);
    if (box.isEmpty()) box.extend(Eigen::Vector3d::Zero());
    const double step = std::max(voxel_size, box.sizes().maxCoeff() / kMost);
    Eigen::Vector3d origin = box.min().array().floor();
    origin.z() = 0.0;  // so that heights on the page are those of the world
    const Eigen::Vector3d low = box.min() - origin;
    std::vector<std::uint16_t> steps;
    for (const std::size_t i : order) {
        for (int axis = 0; axis < 3; ++axis) {
            const double at = (points.positions[i][axis] - box.min()[axis]) / step;
            steps.push_back(static_cast<std::uint16_t>(std::lround(std::min(at, kMost))));
        }
    }
    run.info["origin"] = {origin.x(), origin.y(), origin.z()};
    run.info["low"] = {low.x(), low.y(), low.z()};
    run.info["step"] = step;
    run.arrays.push_back(page_array("map-position", 3, steps));
}

unsigned drives_of(const TilePoints& points, std::size_t i) {
    unsigned count = 0;
    for (std::size_t word = 0; word < points.words; ++word)
        count += static_cast<unsigned>(std::popcount(points.drives[i * points.words + word]));
    return count;
}

void add_values(const TilePoints& points, const std::vector<std::size_t>& order, std::size_t drives,
                PageRun& run) {
    constexpr std::uint8_t kStatic = 1U | 3U << 2U | 3U << 4U;
    const double most = std::max(1.0, static_cast<double>(usual_most(points.scans)));
    std::vector<std::uint8_t> scans, seen, probability;
    for (const std::size_t i : order) {
        scans.push_back(byte_of(points.scans[i] / most));
        seen.push_back(
            byte_of(drives_of(points, i) / static_cast<double>(std::max<std::size_t>(drives, 1))));
        probability.push_back(static_cast<std::uint8_t>(
            std::lround(254.0F * std::clamp(points.probability[i], 0.0F, 1.0F))));
    }
    std::vector<std::uint32_t> voxels(order.size());
    std::iota(voxels.begin(), voxels.end(), 0U);
    run.info["most_scans"] = most;
    run.arrays.push_back(
        page_array("map-verdict", 1, std::vector<std::uint8_t>(order.size(), kStatic)));
    run.arrays.push_back(page_array("map-scans", 1, scans));
    run.arrays.push_back(page_array("map-drives", 1, seen));
    run.arrays.push_back(page_array("map-voxel", 1, voxels));
    run.arrays.push_back(page_array("voxel-probability", 1, probability));
}

/// Which drives saw each voxel, so that each date can be shown alone. A word has room for 32 of
/// them; the earliest of more share its first bit.
void add_drives(const MapIndex& index, const std::vector<std::uint64_t>& voxels,
                const TilePoints& points, const std::vector<std::size_t>& order, PageRun& run) {
    constexpr std::size_t kMost = 32;
    std::vector<std::size_t> seen;  // drives with a voxel in the tile
    for (std::size_t d = 0; d < voxels.size(); ++d) {
        if (voxels[d] > 0) seen.push_back(d);
    }
    const std::size_t shared = std::max(seen.size(), kMost) - kMost;
    const auto bit_of = [&](std::size_t k) { return k < shared ? 0 : k - shared; };
    ordered_json names = ordered_json::array();
    for (std::size_t k = shared; k < seen.size(); ++k) names.push_back(index.drives[seen[k]].name);
    if (shared > 0) names[0] = names[0].get<std::string>() + " and earlier";
    std::vector<std::uint32_t> groups(order.size(), 0);
    for (std::size_t row = 0; row < order.size(); ++row) {
        for (std::size_t k = 0; k < seen.size(); ++k) {
            if (points.saw(seen[k], order[row])) groups[row] |= std::uint32_t{1} << bit_of(k);
        }
    }
    run.info["groups"] = {{"kind", "drive"}, {"names", names}};
    run.arrays.push_back(page_array("map-groups", 1, groups));
}

ordered_json facts_of(const MapIndex& index, const MapTile& tile,
                      const std::vector<std::uint64_t>& voxels) {
    ordered_json drives = ordered_json::array();
    for (std::size_t d = 0; d < voxels.size(); ++d)
        if (voxels[d] > 0)
            drives.push_back({{"name", index.drives[d].name}, {"voxels", voxels[d]}});
    return {{"overview", "../report.html"},
            {"side", square_of(index, tile).side},
            {"voxels", tile.voxels},
            {"scans", tile.scans},
            {"drives", drives},
            {"drives_total", index.drives.size()},
            {"neighbours", neighbours_of(index, tile)}};
}

}  // namespace

std::vector<std::uint64_t> voxels_by_drive(const TilePoints& points, std::size_t drives) {
    std::vector<std::uint64_t> voxels(drives);
    for (std::size_t i = 0; i < points.size(); ++i)
        for (std::size_t d = 0; d < drives; ++d) voxels[d] += points.saw(d, i) ? 1 : 0;
    return voxels;
}

PageRun view_of_tile(const MapIndex& index, const MapTile& tile, const TilePoints& points,
                     std::size_t most) {
    PageRun run;
    double spacing = 0.0;
    const TilePoints shown = shown_of(points, index.voxel_size, most, spacing);
    run.info["kind"] = "tile";
    run.info["name"] = tile.name;
    run.info["command"] = "run";
    run.info["version"] = DYNAMIC_FILTER_VERSION;
    run.info["voxel_size"] = index.voxel_size;
    run.info["scans"] = 0;
    for (const char* no : {"has_truth", "has_instant", "has_evidence"}) run.info[no] = false;
    run.info["points_total"] = points.size();
    run.info["points_shown"] = shown.size();
    run.info["spacing"] = spacing;
    run.info["scores"] = nullptr;
    const std::vector<std::uint64_t> voxels = voxels_by_drive(points, index.drives.size());
    run.info["tile"] = facts_of(index, tile, voxels);
    std::vector<std::size_t> order(shown.size());
    std::iota(order.begin(), order.end(), 0U);
    order = shuffled(std::move(order));
    add_positions(shown, order, index.voxel_size, run);
    add_values(shown, order, index.drives.size(), run);
    add_drives(index, voxels, shown, order, run);
    return run;
}

}  // namespace dynamic_filter::app
