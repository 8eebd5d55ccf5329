// SPDX-License-Identifier: MIT
#include "run/filter_tile.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "base/progress.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/filter.hpp"
#include "dynamic_filter/scores.hpp"
#include "dynamic_filter/writers.hpp"
#include "geometry/pose.hpp"
#include "geometry/voxel.hpp"
#include "recording/scans.hpp"
#include "run/cut.hpp"
#include "run/label_store.hpp"
#include "run/tile_file.hpp"
#include "run/tile_map.hpp"

namespace dynamic_filter::app {

namespace {

/// Scans that are compared with each other, in order.
using ScanGroup = std::vector<ScanOfDrive>;

/// The scans of all drives. Those after a jump of the poses are a group of their own, because they
/// do not fit the others.
std::vector<ScanGroup> groups_of(const Plan& plan, const std::vector<ScanOfDrive>& scans) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, ScanGroup> groups;
    for (const ScanOfDrive& scan : scans) {
        const std::uint32_t stretch = plan.drives[scan.drive].scans[scan.scan].stretch;
        groups[stretch == 0 ? std::pair(0U, 0U) : std::pair(scan.drive, stretch)].push_back(scan);
    }
    std::vector<ScanGroup> result;
    for (auto& [key, group] : groups) result.push_back(std::move(group));
    return result;
}

/// The final verdict on the points of a scan in and around the tile.
struct Seen {
    Cut cut;
    Verdict verdict;                    // on the points of the cut
    std::vector<std::uint32_t> voxels;  // of these points; kNoVoxel outside of the tile
};

struct TileRun {
    const Job& job;
    const TileWork& work;
    const std::filesystem::path& folder;
    TileWriter verdicts{folder / tile_file(work.tile), job.mark};
    Sightings sightings{job.drives.size()};
    io::Cloud map = empty_tile_map(sightings.words());
    TileSummary summary{.tile = work.tile, .drives = {}, .map_mark = {}};
    std::optional<eval::ScanScores> scorer{};  // of the drive that is decided, if it has truth

    [[nodiscard]] bool contains(const Eigen::Vector3d& world) const {
        return work.tile.is_whole ||
               tile_at(cell_at(world, job.plan.cell), work.tile.level) == work.tile;
    }
    [[nodiscard]] DynamicFilter new_filter() const;
    [[nodiscard]] Eigen::Vector3d scoring_origin() const;
    bool filter(DynamicFilter& filter, const ScanGroup& scans, LabelStore& instants) const;
    bool look_again(DynamicFilter& filter, const ScanGroup& scans) const;
    bool decide(const DynamicFilter& filter, const ScanGroup& scans,
                const std::vector<std::size_t>& numbers, const LabelStore& instants);
    [[nodiscard]] Seen look(const DynamicFilter& filter, const io::FullScan& scan,
                            std::size_t number) const;
    void score(const Pose& T_world_sensor, const Seen& seen, const Labels& instant);
    bool score_near(const ScanGroup& scans, const std::vector<std::size_t>& numbers,
                    const LabelStore& finals, const LabelStore& instants);
    void add_to_map(const DynamicFilter& filter);
};

/// The pose of the first scan, from which the filter's frame has its height.
Pose first_pose(const Job& job) {
    const PlannedDrive& drive = job.plan.drives.front();
    Pose pose = Pose::Identity();
    const std::vector<std::size_t> used = used_scans(drive);
    if (!used.empty()) pose.translation() = drive.scans[used.front()].position;
    return pose;
}

DynamicFilter TileRun::new_filter() const {
    if (work.tile.is_whole) return DynamicFilter(job.config);
    const double size = job.config.map.voxel_size;
    const double height = nearby_origin(first_pose(job), 4.0 * size).z();
    return {job.config, region_of(work.tile, size, height)};
}

Eigen::Vector3d TileRun::scoring_origin() const {
    if (work.tile.is_whole) return nearby_origin(first_pose(job), eval::kVoxelSize);
    Pose corner = Pose::Identity();
    corner.translation() = region_of(work.tile, job.config.map.voxel_size, 0.0).origin;
    return nearby_origin(corner, eval::kVoxelSize);
}

/// Calls use(number, scan) for the scans in order; `prepare` (number, scan) runs in
/// parallel before. False if it was interrupted.
bool each_scan(const Job& job, const ScanGroup& group, const std::vector<std::size_t>& numbers,
               const std::function<void(std::size_t, io::FullScan&)>& prepare,
               const std::function<void(std::size_t, io::FullScan&)>& use) {
    for (std::size_t begin = 0; begin < numbers.size();) {
        const std::uint32_t drive = group[numbers[begin]].drive;
        std::map<std::size_t, std::size_t> number_of;  // by index in the drive
        std::vector<std::size_t> scans;
        for (; begin < numbers.size() && group[numbers[begin]].drive == drive; ++begin) {
            scans.push_back(group[numbers[begin]].scan);
            number_of[scans.back()] = numbers[begin];
        }
        const io::Recording& recording = job.drives[drive].recording;
        for_each_scan(
            recording, scans,
            [&](std::size_t i, MaybeScan& maybe) {
                if (prepare) prepare(number_of.at(i), *maybe.scan);
            },
            [&](std::size_t i, MaybeScan& maybe) {
                if (!maybe.scan) throw changed_in_use(recording, i, maybe.error);
                use(number_of.at(i), *maybe.scan);
                return !interrupted();
            });
        if (interrupted()) return false;
    }
    return true;
}

std::vector<std::size_t> all_of(const ScanGroup& group) {
    std::vector<std::size_t> numbers(group.size());
    std::iota(numbers.begin(), numbers.end(), std::size_t{0});
    return numbers;
}

/// The scans of the group with points inside of the tile, drive by drive.
std::vector<std::vector<std::size_t>> inside_by_drive(const ScanGroup& group,
                                                      const TileWork& work) {
    std::vector<std::vector<std::size_t>> drives;
    for (std::size_t n = 0; n < group.size(); ++n) {
        if (!std::binary_search(work.inside.begin(), work.inside.end(), group[n])) continue;
        const bool begins = drives.empty() || group[drives.back().front()].drive != group[n].drive;
        if (begins) drives.emplace_back();
        drives.back().push_back(n);
    }
    return drives;
}

/// First reading: every scan goes through the filter.
bool TileRun::filter(DynamicFilter& filter, const ScanGroup& scans, LabelStore& instants) const {
    std::uint32_t drive = scans.front().drive;
    return each_scan(job, scans, all_of(scans), {}, [&](std::size_t number, io::FullScan& scan) {
        if (std::exchange(drive, scans[number].drive) != scans[number].drive) filter.begin_drive();
        instants.put(number, filter.push(moved_scan(scan, number)).labels);
    });
}

/// Between the readings: all drives but the last one observe what only later ones found.
bool TileRun::look_again(DynamicFilter& filter, const ScanGroup& scans) const {
    std::vector<std::size_t> earlier, drive_of;  // drives are counted from 0 within the group
    for (std::size_t n = 0; n < scans.size() && scans[n].drive != scans.back().drive; ++n) {
        const bool begins = n > 0 && scans[n].drive != scans[n - 1].drive;
        drive_of.push_back(n == 0 ? 0 : drive_of.back() + (begins ? 1 : 0));
        earlier.push_back(n);
    }
    return each_scan(job, scans, earlier, {}, [&](std::size_t number, io::FullScan& scan) {
        filter.look_again(drive_of[number], moved_scan(scan, number));
    });
}

Seen TileRun::look(const DynamicFilter& filter, const io::FullScan& scan,
                   std::size_t number) const {
    Seen seen{.cut = cut_of(scan, work.tile, job.plan.cell), .verdict = {}, .voxels = {}};
    seen.verdict =
        filter.verdict({seen.cut.points, scan.T_world_sensor, scan.stamp, number}, seen.voxels);
    for (std::size_t i = 0; i < seen.voxels.size(); ++i) {
        if (!seen.cut.inside[i]) seen.voxels[i] = kNoVoxel;
    }
    return seen;
}

/// Second reading, of one drive: final verdicts on the points inside.
bool TileRun::decide(const DynamicFilter& filter, const ScanGroup& scans,
                     const std::vector<std::size_t>& numbers, const LabelStore& instants) {
    std::vector<Seen> seen(scans.size());
    LabelStore finals(folder);
    const auto prepare = [&](std::size_t number, io::FullScan& scan) {
        seen[number] = look(filter, scan, number);
    };
    const auto use = [&](std::size_t number, io::FullScan& scan) {
        const Seen one = std::exchange(seen[number], {});
        const Labels instant = labels_of(one.cut, instants.get(number));
        const auto& [index, labels, probability, stays, tracked] = one.verdict;
        PointVerdicts inside;
        for (std::size_t i = 0; i < labels.size(); ++i) {
            if (!one.cut.inside[i]) continue;
            inside.push_back({labels[i], instant[i], !stays.empty() && stays[i]});
        }
        verdicts.add(scans[number], inside);
        sightings.add(scans[number], one.voxels);
        if (scan.truth.empty()) return;
        score(scan.T_world_sensor, one, instant);
        finals.put(number, labels);
    };
    if (!each_scan(job, scans, numbers, prepare, use)) return false;
    return !scorer || score_near(scans, numbers, finals, instants);
}

void TileRun::score(const Pose& T_world_sensor, const Seen& seen, const Labels& instant) {
    if (!scorer) scorer.emplace(eval::kVoxelSize, 2);
    scorer->add(labelled_inside(seen.cut, T_world_sensor, scoring_origin()),
                std::array<const Labels*, 2>{&seen.verdict.labels, &instant});
}

/// Third reading, with ground truth: which removed points lie near one that stays.
bool TileRun::score_near(const ScanGroup& scans, const std::vector<std::size_t>& numbers,
                         const LabelStore& finals, const LabelStore& instants) {
    std::vector<std::vector<Points>> near(scans.size());
    const auto prepare = [&](std::size_t number, io::FullScan& scan) {
        if (scan.truth.empty()) return;
        const Cut cut = cut_of(scan, work.tile, job.plan.cell);
        const Labels final = finals.get(number);
        const Labels instant = labels_of(cut, instants.get(number));
        near[number] =
            scorer->near_removed(labelled_inside(cut, scan.T_world_sensor, scoring_origin()),
                                 std::array<const Labels*, 2>{&final, &instant});
    };
    const auto use = [&](std::size_t number, io::FullScan&) {
        if (!near[number].empty()) scorer->add_near(std::exchange(near[number], {}));
    };
    if (!each_scan(job, scans, numbers, prepare, use)) return false;
    summary.drives.push_back({.drive = scans[numbers.front()].drive,
                              .final = scorer->sums(0),
                              .instant = scorer->sums(1)});
    scorer.reset();
    return true;
}

void TileRun::add_to_map(const DynamicFilter& filter) {
    for (const StaticVoxel& voxel : filter.static_map()) {
        if (!contains(voxel.center)) continue;
        const bool is_first = summary.still++ == 0;
        summary.low = is_first ? voxel.center : summary.low.cwiseMin(voxel.center);
        summary.high = is_first ? voxel.center : summary.high.cwiseMax(voxel.center);
        append(map, voxel, sightings);
    }
    summary.voxels += sightings.voxels();
    summary.keyframes += filter.contents().observers;
    sightings = Sightings(job.drives.size());
}

}  // namespace

bool filter_tile(const Job& job, const TileWork& work, const std::filesystem::path& folder) {
    TileRun tile{.job = job, .work = work, .folder = folder};
    for (const ScanGroup& scans : groups_of(job.plan, work.scans)) {
        DynamicFilter filter = tile.new_filter();
        LabelStore instants(folder);
        if (!tile.filter(filter, scans, instants)) return false;
        if (!tile.look_again(filter, scans)) return false;
        filter.finish();
        for (const auto& numbers : inside_by_drive(scans, work)) {
            if (!tile.decide(filter, scans, numbers, instants)) return false;
        }
        tile.add_to_map(filter);
    }
    io::write_pcd(folder / tile_map_file(work.tile), tile.map);
    tile.summary.map_mark = file_mark_of(folder / tile_map_file(work.tile));
    tile.verdicts.commit(tile.summary);
    return true;
}

}  // namespace dynamic_filter::app
