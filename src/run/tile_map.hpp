// SPDX-License-Identifier: MIT
/// The part of the map inside of a tile: its static voxels, and the drives that saw each.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "dynamic_filter/cloud.hpp"
#include "dynamic_filter/filter.hpp"
#include "filter/archive.hpp"
#include "formats/voxel_map/tile_points.hpp"
#include "run/plan.hpp"

namespace dynamic_filter::app {

/// Which scans and drives had points in each voxel. Scans come in order. Single caller.
class Sightings {
public:
    explicit Sightings(std::size_t drives) : words_(drive_words(drives)) {}
    void add(const ScanOfDrive& scan, const std::vector<std::uint32_t>& voxels);
    /// Makes room for more drives.
    void widen(std::size_t drives);
    /// Writes what later drives add to, or reads it.
    void archive(Archive& archive);

    [[nodiscard]] std::size_t voxels() const { return seen_; }  ///< number of voxels with points
    [[nodiscard]] std::size_t words() const { return words_; }  ///< of the drives of a voxel
    [[nodiscard]] std::uint32_t scans(std::uint32_t voxel) const;
    /// Bit d % 32 of word d / 32: drive d had points in it.
    [[nodiscard]] std::uint32_t drives(std::uint32_t voxel, std::size_t word) const;

private:
    void make_room(std::uint32_t voxel);

    std::size_t words_, seen_ = 0;
    std::vector<std::uint32_t> counts_, drives_;  // by voxel
    std::vector<ScanOfDrive> last_;               // by voxel: the last scan that was counted
};

/// Fields x y z [float64, world], probability, scans and sessions; no records.
io::Cloud empty_tile_map(std::size_t words);

/// Appends a voxel.
void append(io::Cloud& map, const StaticVoxel& voxel, const Sightings& sightings);

/// Appends the voxels [first, last) of a map of the same drives, or of fewer.
void append(io::Cloud& map, const io::Cloud& from, std::size_t first, std::size_t last);

}  // namespace dynamic_filter::app
