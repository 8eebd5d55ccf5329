// SPDX-License-Identifier: MIT
#include "run/write_tiles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>

#include "base/exit_code.hpp"
#include "base/progress.hpp"
#include "base/say.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/file.hpp"
#include "dynamic_filter/parallel.hpp"
#include "formats/voxel_map/map_index.hpp"
#include "page/map_page.hpp"
#include "page/page.hpp"
#include "recording/scans.hpp"
#include "run/keep.hpp"
#include "run/placed.hpp"
#include "run/run.hpp"
#include "run/run_state.hpp"
#include "run/tile_file.hpp"
#include "run/write_scans.hpp"
#include "score/report.hpp"
#include "settings/config_file.hpp"

namespace dynamic_filter::app {

namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

/// The tiles that are done, and which of them hold points of a scan.
struct Tiles {
    std::vector<std::unique_ptr<TileReader>> readers;             // parallel to the plan
    std::vector<std::vector<std::vector<std::uint32_t>>> inside;  // by drive and scan
    TileLookup lookup;
};

Tiles open_tiles(const Job& job, const TileFolders& folders) {
    std::vector<Tile> order;
    for (const TileWork& work : job.plan.tiles) order.push_back(work.tile);
    Tiles tiles{.readers = {}, .inside = {}, .lookup = TileLookup(order)};
    for (const Drive& drive : job.drives) tiles.inside.emplace_back(drive.recording.size());
    for (std::size_t t = 0; t < order.size(); ++t) {
        tiles.readers.push_back(
            std::make_unique<TileReader>(folders(order[t]) / tile_file(order[t]), job.mark));
        for (const ScanOfDrive& scan : job.plan.tiles[t].inside) {
            tiles.inside[scan.drive][scan.scan].push_back(static_cast<std::uint32_t>(t));
        }
    }
    return tiles;
}

/// The verdict on a scan, put together from the tiles in which it has points.
Verdict verdict_of(const Job& job, const Tiles& tiles, const ScanOfDrive& scan,
                   const io::FullScan& full) {
    struct Open {
        std::uint32_t tile;
        PointVerdicts verdicts;
        std::size_t next = 0;
    };
    std::vector<Open> open;
    for (const std::uint32_t t : tiles.inside[scan.drive][scan.scan]) {
        open.push_back({.tile = t, .verdicts = tiles.readers[t]->read(scan)});
    }
    Verdict verdict{.index = scan.scan,
                    .labels = Labels(full.points.size(), Label::unknown),
                    .probability = {}};
    if (job.config.map.time == MapTime::latest) verdict.stays.resize(full.points.size());
    std::optional<PlaneCell> last;
    Open* in = nullptr;
    each_measured(full, [&](std::size_t i, const Eigen::Vector3d& world) {
        const PlaneCell cell = cell_at(world, job.plan.cell);
        if (last != cell) {
            last = cell;
            const auto tile = tiles.lookup.find(cell);
            const auto found = std::find_if(open.begin(), open.end(),
                                            [&](const Open& o) { return tile == o.tile; });
            in = found == open.end() ? nullptr : &*found;
        }
        if (!in || in->next >= in->verdicts.size()) {
            throw InputError(job.drives[scan.drive].recording.info().scan_files[scan.scan], "",
                             "its points or its pose are others than before");
        }
        const PointVerdict& of_point = in->verdicts[in->next++];
        verdict.labels[i] = of_point.final;
        if (!verdict.stays.empty()) verdict.stays[i] = of_point.stays;
    });
    return verdict;
}

/// The counts of one drive over all tiles.
void add_scores(const Tiles& tiles, std::uint32_t drive, RunSummary& summary) {
    eval::ScoreSums final, instant;
    bool is_scored = false;
    for (const auto& reader : tiles.readers) {
        for (const DriveCounts& counts : reader->summary().drives) {
            if (counts.drive != drive) continue;
            final.add(counts.final);
            instant.add(counts.instant);
            is_scored = true;
        }
    }
    if (!is_scored) return;
    summary.scores = final.scores();
    summary.instant_scores = instant.scores();
}

RunSummary write_drive(const Job& job, const Tiles& tiles, std::uint32_t number,
                       const RunOptions& o, const fs::path& folder, Progress& progress) {
    const Drive& drive = job.drives[number];
    const PlannedDrive& planned = job.plan.drives[number];
    RunSummary summary;
    summary.remarks = planned.remarks;
    const auto decide = [&](std::size_t i, const io::FullScan& full) {
        return verdict_of(job, tiles, {number, static_cast<std::uint32_t>(i)}, full);
    };
    const auto use = [&](std::size_t, const io::FullScan& scan, const Verdict& verdict) {
        summary.count(verdict.labels, scan.truth);
        progress.advance();
    };
    const DataOptions how = options_of(job.sources, o.data)[number];
    write_placed(folder, placed_of(drive.recording, how, job.fingerprints[number]));
    const WrittenScans written =
        write_scans(drive.recording, used_scans(planned), job.config, o.maps, folder,
                    {.decide = decide, .look = {}, .use = use});
    summary.add_watch(written, drive.recording, io::PosesFrom::given, job.config.odometry);
    add_scores(tiles, number, summary);
    io::write_file(folder / "metrics.json", text_of(metrics_of(summary)));
    io::write_file(folder / "run.log", log_of(drive.recording, summary) + "scans    " +
                                           points_text(summary) + "\n" + scores_text(summary));
    return summary;
}

/// Tiles stay whole until the run is complete; those of parts stay for another merge.
void bring(const fs::path& from, const fs::path& to, bool links) {
    if (links) {
        link_or_copy(from, to);
    } else {
        fs::copy_file(from, to, fs::copy_options::overwrite_existing);
    }
}

void write_map(const Job& job, const Tiles& tiles, const TileFolders& folders, bool owns,
               const fs::path& folder) {
    fs::create_directories(folder);
    MapIndex index{.voxel_size = job.config.map.voxel_size, .drives = {}, .tiles = {}};
    for (std::size_t d = 0; d < job.drives.size(); ++d) {
        index.drives.push_back(
            {.name = job.drives[d].name, .scans = used_scans(job.plan.drives[d]).size()});
    }
    for (std::size_t t = 0; t < tiles.readers.size(); ++t) {
        const TileSummary& s = tiles.readers[t]->summary();
        const std::string file = tile_map_file(s.tile);
        bring(folders(s.tile) / file, folder / file, owns);
        index.tiles.push_back({.name = name_of(s.tile),
                               .level = s.tile.level,
                               .x = s.tile.x,
                               .y = s.tile.y,
                               .min = s.low,
                               .max = s.high,
                               .voxels = s.still,
                               .scans = job.plan.tiles[t].inside.size(),
                               .file = file,
                               .is_whole = s.tile.is_whole});
    }
    write_map_index(folder, index);
}

/// Where the drives went, for the report: a place every few metres.
std::vector<DrivePath> paths_of(const Job& job) {
    constexpr double kApart = 5.0;  // [m]
    std::vector<DrivePath> paths;
    for (std::size_t d = 0; d < job.drives.size(); ++d) {
        DrivePath path{.name = job.drives[d].name, .positions = {}};
        const PlannedDrive& planned = job.plan.drives[d];
        for (const std::size_t i : used_scans(planned)) {
            const Eigen::Vector3d& position = planned.scans[i].position;
            const bool is_near =
                !path.positions.empty() && (position - path.positions.back()).norm() < kApart;
            if (!is_near) path.positions.push_back(position);
        }
        paths.push_back(std::move(path));
    }
    return paths;
}

/// The run as a whole.
struct Totals {
    std::size_t scans = 0, voxels = 0, keyframes = 0;
    std::size_t visits = 0;  // of a tile by a scan
};

Totals totals_of(const Job& job, const Tiles& tiles, const std::vector<RunSummary>& drives) {
    Totals totals;
    for (const RunSummary& drive : drives) totals.scans += drive.scans;
    for (const auto& reader : tiles.readers) {
        totals.voxels += reader->summary().voxels;
        totals.keyframes += reader->summary().keyframes;
    }
    for (const TileWork& work : job.plan.tiles) totals.visits += work.scans.size();
    return totals;
}

std::vector<RunSummary> write_drives(const Job& job, const Tiles& tiles, const RunOptions& o,
                                     const fs::path& out) {
    std::size_t scans = 0;
    for (std::size_t d = job.first_new(); d < job.drives.size(); ++d) {
        scans += job.drives[d].recording.size();
    }
    Progress progress("write", scans, o.quiet);
    std::vector<RunSummary> summaries;
    for (std::uint32_t d = job.first_new(); d < job.drives.size(); ++d) {
        const fs::path folder = folder_of(job, d, out);
        fs::create_directories(folder);
        summaries.push_back(write_drive(job, tiles, d, o, folder, progress));
    }
    return summaries;
}

/// Metrics of the only drive, or of each of several drives.
Json metrics_of_all(const Job& job, const std::vector<RunSummary>& summaries) {
    Json drives = Json::object();
    for (std::size_t d = 0; d < summaries.size(); ++d) {
        drives[job.drives[job.first_new() + d].name] = metrics_of(summaries[d]);
    }
    if (job.drives.size() == 1) return drives.front();
    return {{"drives", drives}};
}

/// The closing table.
std::string to_text(const Job& job, const Totals& totals, const std::vector<RunSummary>& drives,
                    const Seconds& seconds) {
    std::string text;
    for (std::size_t d = 0; d < drives.size(); ++d) {
        text += fmt::format("drive    {}: {}", job.drives[job.first_new() + d].name,
                            points_text(drives[d]));
        if (drives[d].scores && drives[d].scores->voxel.at("excluded").f1) {
            text += fmt::format("; F1 {:.4f}", *drives[d].scores->voxel.at("excluded").f1);
        }
        text += '\n';
    }
    const auto scans = static_cast<double>(totals.scans);
    text += fmt::format("tiles    {}, {} voxels; a scan reaches {:.1f} of them on average\n",
                        job.plan.tiles.size(), totals.voxels,
                        static_cast<double>(totals.visits) / std::max(scans, 1.0));
    text += fmt::format("speed    {:.1f} scans/s of this process ({:.1f} s, {:.1f} s of CPU)\n",
                        scans / std::max(seconds.wall, 1e-9), seconds.wall, seconds.cpu);
    return text;
}

/// Returns the closing table.
std::string write_reports(const Job& job, const Totals& totals,
                          const std::vector<RunSummary>& drives, const RunOptions& o,
                          const fs::path& folder, StageClock& clock) {
    const bool several = job.drives.size() > 1;
    const Json metrics = metrics_of_all(job, drives);
    if (several) io::write_file(folder / "metrics.json", text_of(metrics));
    if (o.report && !viewer_page().empty()) {
        // Without the timing, so that the pages are the same however the work was shared out.
        write_map_page(folder, metrics, nullptr, paths_of(job));
        clock.finish("report");
    }
    Json timing = timing_of(totals.scans, clock, o.threads);
    timing["tiles"] = job.plan.tiles.size();
    timing["visits"] = totals.visits;
    timing["keyframes"] = totals.keyframes;
    timing["voxels"] = totals.voxels;
    io::write_file(folder / "timing.json", text_of(timing));
    const std::string text = to_text(job, totals, drives, clock.total());
    if (!several) return text;
    io::write_file(folder / "run.log", to_text(job.remarks) + to_text(job.plan.remarks) + text);
    return text;
}

}  // namespace

RunResult finish_tiles(const Job& job, const TileFolders& folders, const RunOptions& o,
                       OutputFolder& output, StageClock& clock) {
    const fs::path own = output.path() / kTilesFolder;
    const bool owns = folders(job.plan.tiles.front().tile) == own;
    RunResult result;
    std::string text;
    {
        const Tiles tiles = open_tiles(job, folders);
        io::write_file(output.path() / "config.toml", to_toml(job.config));
        with_threads(o.threads,
                     [&] { result.recordings = write_drives(job, tiles, o, output.path()); });
        write_map(job, tiles, folders, owns, output.path() / kMapFolder);
        if (job.keeps_evidence) keep_evidence(job, own, o, output);
        if (job.earlier) keep_history(job.earlier->folder, output);

        clock.finish("write");
        const Totals totals = totals_of(job, tiles, result.recordings);
        text = write_reports(job, totals, result.recordings, o, output.path(), clock);
    }
    write_complete(output, mark_of_output(job, o));
    if (owns) fs::remove_all(own);
    output.commit();
    if (!o.quiet) say("{}written  {}\n", text, output.name().string());
    bool is_well = are_harmless(job.plan.remarks) && are_harmless(job.remarks);
    for (std::size_t i = 0; i < result.recordings.size(); ++i) {
        const std::size_t d = job.first_new() + i;
        const Remarks& remarks = result.recordings[i].remarks;
        const std::size_t told = job.plan.drives[d].remarks.size();
        tell(std::span(remarks).subspan(told), job.drives[d].name + ": ", o.quiet);
        is_well = is_well && are_harmless(remarks);
    }
    result.exit_code = is_well ? kDone : kRejected;
    return result;
}

}  // namespace dynamic_filter::app
