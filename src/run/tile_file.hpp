// SPDX-License-Identifier: MIT
/// The result of one tile, on disk until all tiles are done: the verdicts on the points inside of
/// it, scan by scan, and its counts. docs/formats.md describes the file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "dynamic_filter/file.hpp"
#include "dynamic_filter/scores.hpp"
#include "dynamic_filter/types.hpp"
#include "run/plan.hpp"

namespace dynamic_filter::app {

/// The verdict on a point.
struct PointVerdict {
    Label final = Label::unknown, instant = Label::unknown;
    bool stays = false;  ///< Verdict::stays
};
using PointVerdicts = std::vector<PointVerdict>;

/// Counts of one drive in one tile.
struct DriveCounts {
    std::uint32_t drive = 0;
    eval::ScoreSums final, instant;  ///< empty without ground truth
};

/// What is known of a tile that is done.
struct TileSummary {
    Tile tile;
    std::size_t voxels = 0, still = 0;  ///< inside: all of them, and those in the map
    std::size_t keyframes = 0;
    Eigen::Vector3d low = Eigen::Vector3d::Zero(), high = Eigen::Vector3d::Zero();  ///< of the map
    std::vector<DriveCounts> drives;
    /// Mark of the file of voxels beside it, see file_mark_of(); empty: there is no such file.
    std::string map_mark;
};

inline std::string tile_file(const Tile& tile) { return name_of(tile) + ".tile"; }
inline std::string tile_map_file(const Tile& tile) { return name_of(tile) + ".pcd"; }

/// Writes a tile scan by scan; without commit(), no file is left. Single caller.
class TileWriter {
public:
    /// `run`: what the run was begun with.
    TileWriter(const std::filesystem::path& file, const std::string& run);
    /// The verdicts on the points inside of the tile, in their order.
    void add(const ScanOfDrive& scan, const PointVerdicts& verdicts);
    void commit(const TileSummary& summary);

private:
    struct Block {
        ScanOfDrive scan;
        std::uint32_t points = 0, bytes = 0, crc = 0;
        std::uint64_t offset = 0;
    };
    io::AtomicFile file_;
    std::uint64_t end_ = 0;
    std::vector<Block> blocks_;
};

/// A tile that is done. Thread-safe after it is open.
class TileReader {
public:
    /// Throws InputError if the file is damaged, and ConfigError if it is of another run.
    TileReader(std::filesystem::path file, const std::string& run);
    /// Empty if the scan has no points in the tile.
    [[nodiscard]] PointVerdicts read(const ScanOfDrive& scan) const;
    [[nodiscard]] const TileSummary& summary() const { return summary_; }
    /// Reads all of it, and the voxels beside it. Throws InputError if a byte is damaged.
    void check_all() const;

private:
    struct Block {
        std::uint64_t offset = 0;
        std::uint32_t points = 0, bytes = 0, crc = 0;
    };
    [[nodiscard]] std::string packed_bytes_of(const Block& block) const;

    std::filesystem::path path_;
    std::map<ScanOfDrive, Block> blocks_;
    TileSummary summary_;
};

/// "SIZE CRC" of all bytes of a file.
std::string file_mark_of(const std::filesystem::path& file);

/// True if the tile is there and complete with its voxels, and belongs to this run. All bytes are
/// checked; if any is damaged, the answer is false.
bool is_done(const std::filesystem::path& file, const std::string& run);

}  // namespace dynamic_filter::app
