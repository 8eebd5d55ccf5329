// SPDX-License-Identifier: MIT
#include "run/filter_tile.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "base/output_folder.hpp"
#include "base/progress.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/filter.hpp"
#include "dynamic_filter/scores.hpp"
#include "dynamic_filter/writers.hpp"
#include "geometry/pose.hpp"
#include "geometry/voxel.hpp"
#include "recording/recording_parts.hpp"
#include "recording/scans.hpp"
#include "run/cut.hpp"
#include "run/evidence_file.hpp"
#include "run/label_store.hpp"
#include "run/tile_file.hpp"
#include "run/tile_map.hpp"

namespace dynamic_filter::app {

namespace fs = std::filesystem;

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

bool is_after_jump(const Plan& plan, const ScanGroup& group) {
    return plan.drives[group.front().drive].scans[group.front().scan].stretch > 0;
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
    const fs::path& folder;
    TileWriter verdicts{folder / tile_file(work.tile), job.mark};
    Sightings sightings{job.drives.size()};
    io::Cloud map = empty_tile_map(sightings.words());
    TileSummary summary{.tile = work.tile, .drives = {}, .map_mark = {}};
    std::optional<eval::ScanScores> scorer{};  // of the drive that is decided, if it has truth
    std::optional<TileEvidence> earlier{};     // of the drives of the run that is updated
    TileEvidence kept{};                       // for the next update

    [[nodiscard]] bool contains(const Eigen::Vector3d& world) const {
        return work.tile.is_whole ||
               tile_at(cell_at(world, job.plan.cell), work.tile.level) == work.tile;
    }
    [[nodiscard]] DynamicFilter new_filter() const;
    [[nodiscard]] Eigen::Vector3d scoring_origin() const;
    [[nodiscard]] bool is_known(const ScanOfDrive& scan) const {
        return earlier && scan.drive < job.first_new();
    }
    [[nodiscard]] bool is_known(const std::vector<ScanOfDrive>& scans) const {
        return std::all_of(scans.begin(), scans.end(),
                           [&](const ScanOfDrive& scan) { return is_known(scan); });
    }
    [[nodiscard]] std::size_t count_known(const ScanGroup& scans) const;
    bool run_all();
    bool run(const ScanGroup& scans);
    void take_before_jumps();
    void take_after_jumps();
    void take_from_map(std::size_t first, std::size_t last);
    void add_still(const Eigen::Vector3d& center);
    bool filter(DynamicFilter& filter, const ScanGroup& scans, LabelStore& instants) const;
    bool look_again(DynamicFilter& filter, const ScanGroup& scans) const;
    bool decide(const DynamicFilter& filter, const ScanGroup& scans,
                const std::vector<std::size_t>& numbers, const LabelStore& instants);
    [[nodiscard]] Seen look(const DynamicFilter& filter, const io::FullScan& scan,
                            std::size_t number) const;
    [[nodiscard]] Scan unread_scan(const ScanOfDrive& of) const;
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

/// Of an update: the first scans of the group are those of the earlier run.
std::size_t TileRun::count_known(const ScanGroup& scans) const {
    const auto first = std::find_if(scans.begin(), scans.end(),
                                    [&](const ScanOfDrive& scan) { return !is_known(scan); });
    return static_cast<std::size_t>(first - scans.begin());
}

/// The scans of the group, from number `first` on, with points inside of the tile, drive by drive.
std::vector<std::vector<std::size_t>> inside_by_drive(const ScanGroup& group, std::size_t first,
                                                      const TileWork& work) {
    std::vector<std::vector<std::size_t>> drives;
    for (std::size_t n = first; n < group.size(); ++n) {
        if (!std::binary_search(work.inside.begin(), work.inside.end(), group[n])) continue;
        const bool begins = drives.empty() || group[drives.back().front()].drive != group[n].drive;
        if (begins) drives.emplace_back();
        drives.back().push_back(n);
    }
    return drives;
}

/// First reading: every scan goes through the filter that it does not know.
bool TileRun::filter(DynamicFilter& filter, const ScanGroup& scans, LabelStore& instants) const {
    const std::size_t known = count_known(scans);
    std::vector<std::size_t> numbers(scans.size() - known);
    std::iota(numbers.begin(), numbers.end(), known);
    std::uint32_t drive = scans[known > 0 ? known - 1 : 0].drive;
    return each_scan(job, scans, numbers, {}, [&](std::size_t number, io::FullScan& scan) {
        if (std::exchange(drive, scans[number].drive) != scans[number].drive) filter.begin_drive();
        instants.put(number, filter.push(moved_scan(scan, number)).labels);
    });
}

/// A scan without its points.
Scan TileRun::unread_scan(const ScanOfDrive& of) const {
    const io::Info& info = job.drives[of.drive].recording.info();
    Scan scan;
    scan.T_world_sensor = info.T_world_sensor[of.scan];
    scan.stamp = info.stamps[of.scan];
    scan.sensor = io::sensor_of(job.drives[of.drive].recording, of.scan);
    return scan;
}

/// Between the readings: all drives but the last one observe what only later ones found.
bool TileRun::look_again(DynamicFilter& filter, const ScanGroup& scans) const {
    std::size_t of_drive = 0;  // drives are counted from 0 within the group
    for (std::size_t begin = 0, end = 0; scans[begin].drive != scans.back().drive; begin = end) {
        std::vector<Scan> unread;
        for (; scans[end].drive == scans[begin].drive; ++end)
            unread.push_back(unread_scan(scans[end]));
        const std::vector<bool> looks = filter.are_to_look_again(unread);
        std::vector<std::size_t> numbers;
        for (std::size_t n = begin; n < end; ++n) {
            if (looks[n - begin]) numbers.push_back(n);
        }
        const auto use = [&](std::size_t number, io::FullScan& scan) {
            filter.look_again(of_drive, moved_scan(scan, number));
        };
        if (!each_scan(job, scans, numbers, {}, use)) return false;
        ++of_drive;
    }
    return true;
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
        sightings.add(scans[number], one.voxels);
        if (scans[number].drive < job.first_new()) return;
        PointVerdicts inside;
        for (std::size_t i = 0; i < labels.size(); ++i) {
            if (!one.cut.inside[i]) continue;
            inside.push_back({labels[i], instant[i], !stays.empty() && stays[i]});
        }
        verdicts.add(scans[number], inside);
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

void TileRun::add_still(const Eigen::Vector3d& center) {
    const bool is_first = summary.still++ == 0;
    summary.low = is_first ? center : summary.low.cwiseMin(center);
    summary.high = is_first ? center : summary.high.cwiseMax(center);
}

void TileRun::add_to_map(const DynamicFilter& filter) {
    for (const StaticVoxel& voxel : filter.static_map()) {
        if (!contains(voxel.center)) continue;
        add_still(voxel.center);
        append(map, voxel, sightings);
    }
    summary.voxels += sightings.voxels();
    summary.keyframes += filter.contents().observers;
    sightings = Sightings(job.drives.size());
}

/// Voxels of the map of the earlier run.
void TileRun::take_from_map(std::size_t first, std::size_t last) {
    if (first == last) return;
    const fs::path file = job.earlier->folder / kMapFolder / tile_map_file(work.tile);
    const io::Cloud before = io::read_cloud(file);
    const std::size_t begin = map.size();
    append(map, before, first, last);
    const std::array xyz{io::values(map, *map.find("x")), io::values(map, *map.find("y")),
                         io::values(map, *map.find("z"))};
    for (std::size_t i = begin; i < map.size(); ++i) {
        add_still({xyz[0][i], xyz[1][i], xyz[2][i]});
    }
}

bool TileRun::run(const ScanGroup& scans) {
    const bool keeps = job.keeps_evidence && !is_after_jump(job.plan, scans);
    const std::size_t known = count_known(scans);
    DynamicFilter filter = new_filter();
    if (known > 0) {
        filter.go_on_from(earlier->filter);
        sightings = std::move(*earlier->seen);
        earlier->filter = {};  // large
    }
    LabelStore instants(folder);
    if (!this->filter(filter, scans, instants)) return false;
    if (keeps) kept.filter = filter.evidence();
    if (!look_again(filter, scans)) return false;
    filter.finish();
    for (const auto& numbers : inside_by_drive(scans, known, work)) {
        if (!decide(filter, scans, numbers, instants)) return false;
    }
    if (keeps) kept.seen = sightings;
    add_to_map(filter);
    return true;
}

/// Of scans after a jump of the poses, nothing goes on: those of the earlier run stay as they are,
/// and so do those before, if no scan is added to them.
bool TileRun::run_all() {
    std::vector<ScanGroup> groups = groups_of(job.plan, work.scans);
    const bool has_first = !groups.empty() && !is_after_jump(job.plan, groups.front());
    if (has_first && is_known(groups.front())) {
        take_before_jumps();
    } else if (has_first && !run(groups.front())) {
        return false;
    }
    if (has_first) groups.erase(groups.begin());
    kept.of_filter = summary;
    if (earlier) take_after_jumps();
    for (const ScanGroup& scans : groups) {
        if (!is_known(scans) && !run(scans)) return false;
    }
    return true;
}

void TileRun::take_before_jumps() {
    take_from_map(0, earlier->of_filter.still);
    summary.voxels = earlier->of_filter.voxels;
    summary.keyframes = earlier->of_filter.keyframes;
    kept.filter = std::move(earlier->filter);
    kept.seen = std::move(earlier->seen);
}

void TileRun::take_after_jumps() {
    take_from_map(earlier->of_filter.still, earlier->of_all.still);
    summary.voxels += earlier->of_all.voxels - earlier->of_filter.voxels;
    summary.keyframes += earlier->of_all.keyframes - earlier->of_filter.keyframes;
}

/// What the earlier run left of the tile. Throws InputError if its map is not as it was.
std::optional<TileEvidence> earlier_evidence(const Job& job, const TileWork& work) {
    if (!job.earlier) return std::nullopt;
    const fs::path& folder = job.earlier->folder;
    auto evidence = read_evidence(folder / kEvidenceFolder / evidence_file(work.tile),
                                  evidence_mark(job, work, job.first_new()));
    if (!evidence) return std::nullopt;
    const fs::path map = folder / kMapFolder / tile_map_file(work.tile);
    if (!fs::exists(map) || file_mark_of(map) != evidence->of_all.map_mark) {
        throw InputError(map, "",
                         "is not the file that its run wrote; put that back, or make the map "
                         "again by a run of all its recordings");
    }

    if (evidence->seen) evidence->seen->widen(job.drives.size());
    return evidence;
}

/// Whether the files of the earlier run can stay as they are: no new drive reaches the tile.
bool stays(const Job& job, const TileWork& work) {
    return drive_words(job.first_new()) == drive_words(job.drives.size()) &&
           std::all_of(work.scans.begin(), work.scans.end(),
                       [&](const ScanOfDrive& scan) { return scan.drive < job.first_new(); });
}

}  // namespace

bool filter_tile(const Job& job, const TileWork& work, const fs::path& folder) {
    TileRun tile{.job = job, .work = work, .folder = folder};
    tile.earlier = earlier_evidence(job, work);
    const fs::path map = folder / tile_map_file(work.tile);
    const fs::path evidence = folder / evidence_file(work.tile);
    if (tile.earlier && stays(job, work)) {
        const fs::path& from = job.earlier->folder;
        link_or_copy(from / kMapFolder / map.filename(), map);
        link_or_copy(from / kEvidenceFolder / evidence.filename(), evidence);
        tile.summary = tile.earlier->of_all;
        tile.summary.tile = work.tile;
        tile.verdicts.commit(tile.summary);
        return true;
    }
    if (!tile.run_all()) return false;
    io::write_pcd(map, tile.map);
    tile.summary.map_mark = file_mark_of(map);
    if (job.keeps_evidence) {
        tile.kept.of_all = tile.summary;
        write_evidence(evidence, std::move(tile.kept), evidence_mark(job, work, job.drives.size()));
    }
    tile.verdicts.commit(tile.summary);
    return true;
}

}  // namespace dynamic_filter::app
