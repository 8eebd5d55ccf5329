// SPDX-License-Identifier: MIT
/// What is known of all drives before they are filtered: which scans can be used, which tiles each
/// scan reaches, and how much work each tile is.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "dynamic_filter/settings.hpp"
#include "recording/drives.hpp"
#include "run/remarks.hpp"
#include "run/tiles.hpp"

namespace dynamic_filter::app {

struct PlannedScan {
    bool is_used = false;       ///< false: it was rejected
    std::uint32_t stretch = 0;  ///< of the drive: a jump of the poses begins the next one
    Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m] of the sensor, in the world
    std::vector<PlaneCell> cells;                        ///< in which it has points, ascending
    std::vector<PlaneCell> around;  ///< others that have points in their halo, ascending
};

struct PlannedDrive {
    std::vector<PlannedScan> scans;  ///< parallel to the recording
    Remarks remarks;                 ///< on the recording
    std::size_t most_points = 0;     ///< in a scan
    /// How the motion during each scan is undone, as Recording has it.
    bool deskew = false;
    std::optional<Sweep> sweep;
    Eigen::Vector3d sensor_at = Eigen::Vector3d::Zero();  ///< [m] as in io::Info
    io::Boxes own_body{};                                 ///< as in io::Info
};

/// Indices of the scans that were not rejected.
std::vector<std::size_t> used_scans(const PlannedDrive& drive);

/// A scan of one of the drives.
struct ScanOfDrive {
    std::uint32_t drive = 0, scan = 0;
    auto operator<=>(const ScanOfDrive&) const = default;
};

/// A tile and what it takes to filter it.
struct TileWork {
    Tile tile;
    std::size_t voxels = 0;           ///< estimated
    std::size_t points = 0;           ///< of the scans that reach it, at most
    std::vector<ScanOfDrive> scans;   ///< that reach it, in order
    std::vector<ScanOfDrive> inside;  ///< those of them with points inside of it, in order
    /// [s] estimated, of one core; see docs/city.md.
    [[nodiscard]] double cost() const;
};

struct Plan {
    double cell = 0.0;  ///< [m] edge of a cell
    std::vector<PlannedDrive> drives;
    Remarks remarks;                          ///< on how the drives fit each other
    std::map<PlaneCell, std::size_t> voxels;  ///< estimated, by cell
    std::vector<std::uint64_t> sampled;       ///< hashes of the voxels that were counted, ascending

    std::size_t most_voxels = 0;  ///< in a tile
    std::vector<TileWork> tiles;
};

inline constexpr const char* kPlanFile = "plan";  ///< beside the tiles, and beside the evidence

/// Reads every scan once, in parallel. Decides how motion is undone where `how.deskew` is "auto".
/// `earlier`: the plan of the first drives, whose scans are not read again; empty: none.
Plan make_plan(std::vector<Drive>& drives, const Config& config, const DataOptions& how,
               std::size_t most_voxels, bool quiet, const Plan& earlier = {});

/// Gives the recordings what the plan decided about them. make_plan() has done so.
void prepare(std::vector<Drive>& drives, const Plan& plan);

/// Cuts the area of the plan into tiles, and finds the scans of each. Part of make_plan() and of
/// read_plan().
void cut_into_tiles(Plan& plan, const Config& config);

/// Indices of the tiles, the most work first.
std::vector<std::size_t> by_cost(const std::vector<TileWork>& tiles);

/// The part of each tile, counted from 1: the tiles with the most work come first, and each goes to
/// the part that has the least work so far.
std::vector<std::size_t> part_of_tiles(const std::vector<TileWork>& tiles, std::size_t parts);

/// The tiles of part `part` of `parts`, the most work first.
std::vector<std::size_t> tiles_of_part(const std::vector<TileWork>& tiles, std::size_t part,
                                       std::size_t parts);

/// Writes a plan. `run` is what the run was begun with.
void write_plan(const std::filesystem::path& file, const Plan& plan, const std::string& run);
/// Throws InputError if the file is damaged, and ConfigError if it is the plan of another run.
Plan read_plan(const std::filesystem::path& file, const std::string& run, const Config& config);

}  // namespace dynamic_filter::app
