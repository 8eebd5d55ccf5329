// SPDX-License-Identifier: MIT
#include "run/plan.hpp"

#include <fmt/format.h>
#include <tsl/robin_set.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/progress.hpp"
#include "check/advice.hpp"
#include "check/motion.hpp"
#include "dynamic_filter/check.hpp"
#include "dynamic_filter/error.hpp"
#include "geometry/voxel.hpp"
#include "recording/mask.hpp"
#include "recording/scans.hpp"
#include "run/summary.hpp"
#include "tracking/pose_jump.hpp"

namespace dynamic_filter::app {

namespace {

/// One voxel in so many is counted, chosen by the hash of its place.
constexpr std::uint64_t kSampled = 1024;

/// Where a scan has points.
struct Extent {
    std::vector<PlaneCell> cells, around;                      // as PlannedScan has them
    std::vector<std::pair<PlaneCell, std::uint64_t>> sampled;  // voxels: their cell and hash
};

std::uint64_t hash_of(const Eigen::Vector3d& world, double voxel_size) {
    std::uint64_t hash = 0;
    for (const double coordinate : world) {
        const auto cell = static_cast<std::int64_t>(std::floor(coordinate / voxel_size));
        hash = VoxelHash{}(hash ^ static_cast<std::uint64_t>(cell));
    }
    return hash;
}

template <class T>
void sort_unique(std::vector<T>& values) {
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
}

/// Adds the other cells whose halo holds the place.
void add_around(const Eigen::Vector3d& world, const PlaneCell& cell, double edge,
                std::vector<PlaneCell>& around) {
    constexpr double kHalo = double{kHaloVoxels} / kVoxelsPerCell;
    const auto side = [&](double coordinate, std::int32_t number) {
        const double within = coordinate / edge - number;
        return within < kHalo ? -1 : within >= 1.0 - kHalo ? 1 : 0;
    };
    const int dx = side(world.x(), cell.x), dy = side(world.y(), cell.y);
    const auto add = [&](const PlaneCell& other) {
        if (around.empty() || around.back() != other) around.push_back(other);
    };
    if (dx != 0) add({cell.x + dx, cell.y});
    if (dy != 0) add({cell.x, cell.y + dy});
    if (dx != 0 && dy != 0) add({cell.x + dx, cell.y + dy});
}

Extent extent_of(const io::FullScan& full, double voxel_size) {
    const double edge = cell_edge(voxel_size);
    Extent extent;
    each_measured(full, [&](std::size_t, const Eigen::Vector3d& world) {
        const PlaneCell cell = cell_at(world, edge);
        if (extent.cells.empty() || extent.cells.back() != cell) extent.cells.push_back(cell);
        add_around(world, cell, edge, extent.around);
        const std::uint64_t hash = hash_of(world, voxel_size);
        if (hash % kSampled == 0) extent.sampled.emplace_back(cell, hash);
    });
    sort_unique(extent.cells);
    sort_unique(extent.around);
    std::erase_if(extent.around, [&](const PlaneCell& cell) {
        return std::binary_search(extent.cells.begin(), extent.cells.end(), cell);
    });
    sort_unique(extent.sampled);
    return extent;
}

/// Decides in the order of the scans which of them are used, as the filter of one recording does.
class ScanGate {
public:
    ScanGate(const io::Recording& recording, PlannedDrive& drive)
        : recording_(recording), drive_(drive) {}

    void reject(std::size_t i, const std::string& why) {
        drive_.remarks.push_back(
            {RemarkKind::rejected, fmt::format("{}: {}", io::stem(recording_, i), why)});
    }

    void add(std::size_t i, const io::FullScan& full, const Extent& extent) {
        if (!fields_.empty() && full.cloud.fields != fields_) {
            reject(i, io::kOtherFields);
            return;
        }
        if (fields_.empty()) fields_ = full.cloud.fields;
        const StampedPose now{full.T_world_sensor, full.stamp};
        if (is_repeated(now)) {
            reject(i, "it has the stamp and the pose of the scan before");
            return;
        }
        if (!begin_stretch(i, now)) return;
        if (!full.truth_fault.empty()) {
            note(full.truth_fault + "; the scan is filtered, but not scored");
        }
        PlannedScan& scan = drive_.scans[i];
        scan.is_used = true;
        scan.stretch = stretch_;
        scan.position = full.T_world_sensor.translation();
        cells_.insert(cells_.end(), extent.cells.begin(), extent.cells.end());
        cells_.insert(cells_.end(), extent.around.begin(), extent.around.end());
        counts_.push_back({i, extent.cells.size(), extent.around.size()});
        drive_.most_points = std::max(drive_.most_points, full.points.size());
        before_last_ = std::exchange(last_, now);
    }

    /// Gives the scans their cells. Done after all scans are read. Otherwise small arrays would
    /// fragment the memory of the scans.
    void finish() {
        auto next = cells_.begin();
        for (const Counts& counts : counts_) {
            const auto middle = next + static_cast<std::ptrdiff_t>(counts.cells);
            const auto end = middle + static_cast<std::ptrdiff_t>(counts.around);
            drive_.scans[counts.scan].cells.assign(next, middle);
            drive_.scans[counts.scan].around.assign(middle, end);
            next = end;
        }
    }

private:
    struct Counts {
        std::size_t scan, cells, around;
    };
    [[nodiscard]] bool is_repeated(const StampedPose& now) const {
        return last_ && last_->stamp == now.stamp &&
               last_->T_world_sensor.matrix() == now.T_world_sensor.matrix();
    }
    /// False if the scan comes too late.
    bool begin_stretch(std::size_t i, const StampedPose& now) {
        const std::string name = io::stem(recording_, i);
        if (last_ && now.stamp < last_->stamp) {
            if (now.stamp >= last_->stamp - kRestart) {
                reject(i, "its stamp is before that of the scan before");
                return false;
            }
            note(name +
                 ": stamps went back by more than a second; scans are not compared with those "
                 "before");
            next_stretch();
        } else if (const auto jump = pose_jump(before_last_, last_, now)) {
            note(
                fmt::format("{}: the pose is {:.0f} m from where the previous poses lead; scans "
                            "are not compared with those before",
                            name, *jump));
            next_stretch();
        }
        return true;
    }
    void note(const std::string& text) { drive_.remarks.push_back({RemarkKind::note, text}); }
    void next_stretch() {
        ++stretch_;
        before_last_ = last_ = std::nullopt;
    }

    const io::Recording& recording_;
    PlannedDrive& drive_;
    std::vector<io::Field> fields_;
    std::optional<StampedPose> before_last_, last_;
    std::uint32_t stretch_ = 0;
    std::vector<PlaneCell> cells_;  // of all scans, one after the other
    std::vector<Counts> counts_;
};

/// The voxels that were sampled so far.
class VoxelSample {
public:
    explicit VoxelSample(const Plan& earlier)
        : seen_(earlier.sampled.begin(), earlier.sampled.end()), counts_(earlier.voxels) {}

    void add(const std::vector<PlaneCell>& cells,
             const std::vector<std::pair<PlaneCell, std::uint64_t>>& sampled) {
        for (const auto& [cell, hash] : sampled) {
            if (seen_.insert(hash).second) counts_[cell] += kSampled;
        }
        for (const PlaneCell& cell : cells) counts_.try_emplace(cell, 0);
    }
    [[nodiscard]] const std::map<PlaneCell, std::size_t>& counts() const { return counts_; }
    [[nodiscard]] std::vector<std::uint64_t> hashes() const {
        std::vector<std::uint64_t> hashes(seen_.begin(), seen_.end());
        std::sort(hashes.begin(), hashes.end());
        return hashes;
    }

private:
    tsl::robin_set<std::uint64_t> seen_;
    std::map<PlaneCell, std::size_t> counts_;
};

void scan_drive(const Drive& drive, double voxel_size, PlannedDrive& planned, VoxelSample& sample,
                Progress& progress) {
    planned.scans.resize(drive.recording.size());
    ScanGate gate(drive.recording, planned);
    std::vector<Extent> extents(drive.recording.size());
    const auto measure = [&](std::size_t i, MaybeScan& maybe) {
        extents[i] = extent_of(*maybe.scan, voxel_size);
    };
    const auto use = [&](std::size_t i, MaybeScan& maybe) {
        const Extent extent = std::exchange(extents[i], {});
        if (maybe.scan) {
            gate.add(i, *maybe.scan, extent);
            if (planned.scans[i].is_used) sample.add(extent.cells, extent.sampled);
        } else {
            gate.reject(i, maybe.error);
        }
        progress.advance();
        return !interrupted();
    };
    for_each_scan(drive.recording, all_scans(drive.recording), measure, use);
    gate.finish();
    if (used_scans(planned).empty() && !interrupted()) {
        throw no_scan_is_usable(drive.recording, planned.remarks);
    }
}

/// Looks at motion and poses, as a run of one recording does; poses are not refined.
void look_at(Drive& drive, const Config& config, const DataOptions& how, PlannedDrive& planned) {
    Config unrefined = config;
    add(planned.remarks, RemarkKind::note, drive.recording.info().notes);
    const auto chosen =
        choose_motion(drive.recording, unrefined,
                      {.refine = "off", .deskew = how.deskew, .finds_body = !how.mask});
    add(planned.remarks, RemarkKind::note, chosen.notes);
    add(planned.remarks, RemarkKind::lost, drive.recording.info().losses);
    planned.deskew = drive.recording.info().deskewed;
    planned.sweep = drive.recording.info().sweep;
    planned.own_body = drive.recording.info().own_body;
    planned.sensor_at = drive.recording.info().sensor_at.value_or(Eigen::Vector3d::Zero());
    for (const auto& found : io::check_recording(drive.recording, io::Depth::quick).findings) {
        planned.remarks.push_back({RemarkKind::warning, warning_of(found, how)});
    }
}

/// Drives that do not fit each other would see each other's walls as moving.
Remarks offsets_of(const std::vector<Drive>& drives) {
    if (drives.size() < 2) return {};
    std::vector<const io::Recording*> recordings;
    for (const Drive& drive : drives) recordings.push_back(&drive.recording);
    Remarks remarks;
    for (const io::Finding& finding : io::compare_drives(recordings)) {
        remarks.push_back(
            {RemarkKind::warning,
             fmt::format("{}; {} (`dynamicfilter check` with all drives looks closer)",
                         finding.what, finding.advice)});
    }
    return remarks;
}

bool has_points_in(const PlannedScan& scan, const Tile& tile) {
    return tile.is_whole || std::any_of(scan.cells.begin(), scan.cells.end(), [&](auto cell) {
               return tile_at(cell, tile.level) == tile;
           });
}

/// Calls use(cell) for the cells between a place and the middle of a cell, as far as `reach`.
template <class Use>
void each_on_the_way(const Eigen::Vector2d& from, const PlaneCell& to, double edge, double reach,
                     const Use& use) {
    const Eigen::Vector2d way = edge * Eigen::Vector2d(to.x + 0.5, to.y + 0.5) - from;
    const double length = std::min(way.norm(), reach);
    const Eigen::Vector2d direction = way.normalized();
    for (double at = 0.0; at < length; at += 0.25 * edge) {
        const Eigen::Vector2d place = from + at * direction;
        use(cell_at({place.x(), place.y(), 0.0}, edge));
    }
}

/// The tiles for which the scan is evidence: those in whose region it has points, and those through
/// which its beams go, as far as keyframes look.
std::vector<std::size_t> reached_by(const PlannedScan& scan, double edge, double reach,
                                    const TileLookup& tiles) {
    std::vector<PlaneCell> cells = scan.cells;
    cells.insert(cells.end(), scan.around.begin(), scan.around.end());
    for (const PlaneCell& cell : scan.cells) {
        each_on_the_way(scan.position.head<2>(), cell, edge, reach, [&](const PlaneCell& between) {
            if (cells.back() != between) cells.push_back(between);
        });
    }
    sort_unique(cells);
    std::vector<std::size_t> reached;
    for (const PlaneCell& cell : cells) {
        if (const auto tile = tiles.find(cell)) reached.push_back(*tile);
    }
    sort_unique(reached);
    return reached;
}

}  // namespace

double TileWork::cost() const {
    // [s] for a point, and for a point and a voxel: measured with 16 and 64 beams, see
    // docs/city.md.
    constexpr double kPerPoint = 2.5e-7, kPerPointAndVoxel = 4e-13;
    return static_cast<double>(points) *
           (kPerPoint + kPerPointAndVoxel * static_cast<double>(voxels));
}

std::vector<std::size_t> used_scans(const PlannedDrive& drive) {
    std::vector<std::size_t> used;
    for (std::size_t i = 0; i < drive.scans.size(); ++i) {
        if (drive.scans[i].is_used) used.push_back(i);
    }
    return used;
}

void cut_into_tiles(Plan& plan, const Config& config) {
    const std::vector<Tile> tiles = tiles_of(plan.voxels, plan.most_voxels);
    const TileLookup lookup(tiles);
    plan.tiles.clear();
    for (const Tile& tile : tiles) plan.tiles.push_back({.tile = tile, .scans = {}, .inside = {}});
    for (const auto& [cell, count] : plan.voxels) plan.tiles[*lookup.find(cell)].voxels += count;
    for (std::size_t d = 0; d < plan.drives.size(); ++d) {
        const auto& scans = plan.drives[d].scans;
        for (const std::size_t i : used_scans(plan.drives[d])) {
            const ScanOfDrive scan{static_cast<std::uint32_t>(d), static_cast<std::uint32_t>(i)};
            for (const std::size_t t :
                 reached_by(scans[i], plan.cell, config.scans.sight.farthest, lookup)) {
                TileWork& work = plan.tiles[t];
                work.scans.push_back(scan);
                work.points += plan.drives[d].most_points;
                if (has_points_in(scans[i], work.tile)) work.inside.push_back(scan);
            }
        }
    }
}

Plan make_plan(std::vector<Drive>& drives, const Config& config, const DataOptions& how,
               std::size_t most_voxels, bool quiet, const Plan& earlier) {
    Plan plan{.cell = cell_edge(config.map.voxel_size),
              .drives = earlier.drives,
              .remarks = {},
              .voxels = {},
              .sampled = {},
              .most_voxels = most_voxels,
              .tiles = {}};
    const std::size_t known = earlier.drives.size();
    plan.drives.resize(drives.size());
    std::size_t scans = 0;
    for (std::size_t d = known; d < drives.size(); ++d) scans += drives[d].recording.size();
    if (known == 0) plan.remarks = offsets_of(drives);
    VoxelSample sample(earlier);
    Progress progress("plan", scans, quiet);
    for (std::size_t d = known; d < drives.size() && !interrupted(); ++d) {
        look_at(drives[d], config, how, plan.drives[d]);
        scan_drive(drives[d], config.map.voxel_size, plan.drives[d], sample, progress);
    }
    if (known > 0) prepare(drives, plan);
    plan.voxels = sample.counts();
    plan.sampled = sample.hashes();
    cut_into_tiles(plan, config);
    return plan;
}

void prepare(std::vector<Drive>& drives, const Plan& plan) {
    for (std::size_t d = 0; d < drives.size(); ++d) {
        io::Recording& recording = drives[d].recording;
        recording = io::with_sensor_at(recording, plan.drives[d].sensor_at);
        recording = io::with_own_body(recording, plan.drives[d].own_body);
        if (!plan.drives[d].deskew || recording.info().deskewed) continue;
        recording = io::deskewed(recording, plan.drives[d].sweep);
    }
}

std::vector<std::size_t> by_cost(const std::vector<TileWork>& tiles) {
    std::vector<std::size_t> order(tiles.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return tiles[a].cost() > tiles[b].cost();
    });
    return order;
}

std::vector<std::size_t> part_of_tiles(const std::vector<TileWork>& tiles, std::size_t parts) {
    std::vector<double> load(parts);
    std::vector<std::size_t> part_of(tiles.size());
    for (const std::size_t tile : by_cost(tiles)) {
        const auto least = std::min_element(load.begin(), load.end());
        *least += tiles[tile].cost();
        part_of[tile] = static_cast<std::size_t>(least - load.begin()) + 1;
    }
    return part_of;
}

std::vector<std::size_t> tiles_of_part(const std::vector<TileWork>& tiles, std::size_t part,
                                       std::size_t parts) {
    const std::vector<std::size_t> part_of = part_of_tiles(tiles, parts);
    std::vector<std::size_t> chosen = by_cost(tiles);
    std::erase_if(chosen, [&](std::size_t tile) { return part_of[tile] != part; });
    return chosen;
}

}  // namespace dynamic_filter::app
