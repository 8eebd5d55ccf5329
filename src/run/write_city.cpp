// SPDX-License-Identifier: MIT
#include "run/write_city.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/exit_code.hpp"
#include "base/progress.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/file.hpp"
#include "dynamic_filter/parallel.hpp"
#include "formats/voxel_map/map_index.hpp"
#include "page/city_report.hpp"
#include "page/page.hpp"
#include "recording/frames.hpp"
#include "run/run.hpp"
#include "run/run_reports.hpp"
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

Tiles open_tiles(const City& city, const TileFolders& folders) {
    std::vector<Tile> order;
    for (const TileWork& work : city.plan.tiles) order.push_back(work.tile);
    Tiles tiles{.readers = {}, .inside = {}, .lookup = TileLookup(order)};
    for (const Drive& drive : city.drives) tiles.inside.emplace_back(drive.sequence.size());
    for (std::size_t t = 0; t < order.size(); ++t) {
        tiles.readers.push_back(
            std::make_unique<TileReader>(folders(order[t]) / tile_file(order[t]), city.run));
        for (const ScanOfDrive& scan : city.plan.tiles[t].inside) {
            tiles.inside[scan.drive][scan.scan].push_back(static_cast<std::uint32_t>(t));
        }
    }
    return tiles;
}

/// The verdict on a scan, put together from the tiles in which it has points.
Verdict verdict_of(const City& city, const Tiles& tiles, const ScanOfDrive& scan,
                   const io::FullScan& frame) {
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
                    .labels = Labels(frame.points.size(), Label::unknown),
                    .probability = {}};
    if (city.config.map.time == MapTime::latest) verdict.stays.resize(frame.points.size());
    std::optional<PlaneCell> last;
    Open* in = nullptr;
    each_measured(frame, [&](std::size_t i, const Eigen::Vector3d& world) {
        const PlaneCell cell = cell_at(world, city.plan.cell);
        if (last != cell) {
            last = cell;
            const auto tile = tiles.lookup.find(cell);
            const auto found = std::find_if(open.begin(), open.end(),
                                            [&](const Open& o) { return tile == o.tile; });
            in = found == open.end() ? nullptr : &*found;
        }
        if (!in || in->next >= in->verdicts.size()) {
            throw InputError(city.drives[scan.drive].sequence.info().scan_files[scan.scan], "",
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

std::string points_text(const RunSummary& s) {
    return fmt::format("{} scans ({} rejected); {} points: {}", s.scans, s.rejected.size(),
                       s.points, shares_of(s));
}

void write_log(const fs::path& folder, const Drive& drive, const RunSummary& s,
               const std::vector<std::string>& warnings) {
    const io::Recording& sequence = drive.sequence;
    std::string log = fmt::format("input    {} ({}, {} scans)\n",
                                  fs::absolute(sequence.info().root).lexically_normal().string(),
                                  sequence.info().layout, sequence.size());
    for (const std::string& note : s.notes) log += "note     " + note + "\n";
    for (const std::string& line : warnings) log += "warning  " + line + "\n";
    for (const std::string& line : sequence.info().losses) log += "lost     " + line + "\n";
    for (const std::string& line : s.rejected) log += "rejected " + line + "\n";
    log += "scans    " + points_text(s) + "\n";
    if (s.scores) log += "scores against the ground truth of the recording\n" + table(*s.scores);
    io::write_file(folder / "run.log", log);
}

RunSummary write_drive(const City& city, const Tiles& tiles, std::uint32_t number, bool maps,
                       const fs::path& folder, Progress& progress) {
    const Drive& drive = city.drives[number];
    const PlannedDrive& planned = city.plan.drives[number];
    RunSummary summary;
    summary.rejected = planned.rejected;
    summary.notes = planned.notes;
    const auto decide = [&](std::size_t i, const io::FullScan& frame) {
        return verdict_of(city, tiles, {number, static_cast<std::uint32_t>(i)}, frame);
    };
    const auto use = [&](std::size_t, const io::FullScan&, const Verdict& verdict) {
        ++summary.scans;
        summary.points += verdict.labels.size();
        for (const Label label : verdict.labels) {
            (label == Label::static_   ? summary.still
             : label == Label::dynamic ? summary.dynamic
                                       : summary.unknown) += 1;
        }
        progress.advance();
    };
    write_scans(drive.sequence, used_scans(planned), city.config, maps, folder,
                {.decide = decide, .use = use});
    add_scores(tiles, number, summary);
    io::write_file(folder / "metrics.json",
                   text_of(metrics_of(summary, drive.sequence.info().losses)));
    write_log(folder, drive, summary, planned.warnings);
    return summary;
}

/// Tiles stay whole until the run is complete. A link takes no space beside them.
void bring(const fs::path& from, const fs::path& to, bool links) {
    fs::remove(to);
    std::error_code cannot_link;
    if (links) fs::create_hard_link(from, to, cannot_link);
    if (!links || cannot_link) fs::copy_file(from, to);
}

void write_map(const City& city, const Tiles& tiles, const TileFolders& folders, bool owns,
               const fs::path& folder) {
    fs::create_directories(folder);
    MapIndex index{.voxel_size = city.config.map.voxel_size, .drives = {}, .tiles = {}};
    for (std::size_t d = 0; d < city.drives.size(); ++d) {
        index.drives.push_back(
            {.name = city.drives[d].name, .scans = used_scans(city.plan.drives[d]).size()});
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
                               .scans = city.plan.tiles[t].inside.size(),
                               .file = file,
                               .is_whole = s.tile.is_whole});
    }
    write_map_index(folder, index);
}

/// Where the drives went, for the report: a place every few metres.
std::vector<DriveTrack> tracks_of(const City& city) {
    constexpr double kApart = 5.0;  // [m]
    std::vector<DriveTrack> tracks;
    for (std::size_t d = 0; d < city.drives.size(); ++d) {
        DriveTrack track{.name = city.drives[d].name, .positions = {}};
        const PlannedDrive& planned = city.plan.drives[d];
        for (const std::size_t i : used_scans(planned)) {
            const Eigen::Vector3d& position = planned.scans[i].position;
            const bool is_near =
                !track.positions.empty() && (position - track.positions.back()).norm() < kApart;
            if (!is_near) track.positions.push_back(position);
        }
        tracks.push_back(std::move(track));
    }
    return tracks;
}

Json timing(const CitySummary& s, const StageClock& clock, const Pace& pace) {
    std::size_t scans = 0;
    for (const RunSummary& drive : s.drives) scans += drive.scans;
    const Seconds total = clock.total();
    return {{"scans_per_second", total.wall > 0 ? static_cast<double>(scans) / total.wall : 0.0},
            {"wall_seconds", total.wall},
            {"cpu_seconds", total.cpu},
            {"process", by_stage(clock)},
            {"tiles", s.tiles},
            {"visits", s.visits},
            {"keyframes", s.keyframes},
            {"voxels", s.voxels},
            {"peak_rss_bytes", peak_rss_bytes()},
            {"threads", pace.threads > 0 ? pace.threads : available_threads()}};
}

/// Where the files of a drive go: a single drive has the folder of the result.
fs::path folder_of(const City& city, std::size_t drive, const fs::path& out) {
    return city.drives.size() == 1 ? out : out / "drives" / city.drives[drive].name;
}

std::vector<RunSummary> write_drives(const City& city, const Tiles& tiles, bool maps,
                                     const fs::path& out, bool quiet) {
    std::size_t scans = 0;
    for (const Drive& drive : city.drives) scans += drive.sequence.size();
    Progress progress("write", scans, quiet);
    std::vector<RunSummary> summaries;
    for (std::uint32_t d = 0; d < city.drives.size(); ++d) {
        const fs::path folder = folder_of(city, d, out);
        fs::create_directories(folder);
        summaries.push_back(write_drive(city, tiles, d, maps, folder, progress));
    }
    return summaries;
}

CitySummary count(const City& city, const Tiles& tiles) {
    CitySummary summary{.drives = {}, .tiles = tiles.readers.size(), .seconds = {}};
    for (const auto& reader : tiles.readers) {
        summary.voxels += reader->summary().voxels;
        summary.keyframes += reader->summary().keyframes;
    }
    for (const TileWork& work : city.plan.tiles) summary.visits += work.scans.size();
    return summary;
}

/// Metrics of the only drive, or of each of several drives.
Json metrics_of_all(const City& city, const CitySummary& summary) {
    Json drives = Json::object();
    for (std::size_t d = 0; d < city.drives.size(); ++d) {
        drives[city.drives[d].name] =
            metrics_of(summary.drives[d], city.drives[d].sequence.info().losses);
    }
    if (city.drives.size() == 1) return drives.front();
    return {{"drives", drives}};
}

int exit_code_of(const City& city, const CitySummary& summary) {
    bool all = true;
    for (std::size_t d = 0; d < city.drives.size(); ++d) {
        for (const std::string& line : summary.drives[d].rejected) {
            fmt::print(stderr, "rejected {}: {}\n", city.drives[d].name, line);
        }
        for (const std::string& line : city.drives[d].sequence.info().losses) {
            fmt::print(stderr, "lost     {}: {}\n", city.drives[d].name, line);
        }
        all &= summary.drives[d].rejected.empty() && city.drives[d].sequence.info().losses.empty();
    }
    return all ? kDone : kRejected;
}

}  // namespace

CitySummary write_city(const City& city, const TileFolders& folders, bool owns,
                       const Extras& extras, const OutputFolder& output, StageClock& clock,
                       const Pace& pace, bool quiet) {
    const Tiles tiles = open_tiles(city, folders);
    io::write_file(output.path() / "config.toml", to_toml(city.config));
    CitySummary summary = count(city, tiles);
    with_threads(pace.threads, [&] {
        summary.drives = write_drives(city, tiles, extras.maps, output.path(), quiet);
    });
    write_map(city, tiles, folders, owns, output.path() / "map");
    clock.finish("write");
    const Json metrics = metrics_of_all(city, summary);
    if (city.drives.size() > 1) io::write_file(output.path() / "metrics.json", text_of(metrics));
    if (extras.report && !viewer_page().empty()) {
        // Without the timing, so that the pages are the same however the work was shared out.
        write_city_report(output.path(), metrics, nullptr, tracks_of(city));
        clock.finish("report");
    }
    summary.seconds = clock.total();
    io::write_file(output.path() / "timing.json", text_of(timing(summary, clock, pace)));
    if (city.drives.size() > 1) {
        std::string log;
        for (const std::string& line : city.plan.warnings) log += "warning  " + line + "\n";
        io::write_file(output.path() / "run.log", log + to_text(city, summary));
    }
    return summary;
}

std::string to_text(const City& city, const CitySummary& s) {
    std::string text;
    for (std::size_t d = 0; d < s.drives.size(); ++d) {
        const RunSummary& drive = s.drives[d];
        text += fmt::format("drive    {}: {}", city.drives[d].name, points_text(drive));
        if (drive.scores && drive.scores->voxel.at("excluded").f1) {
            text += fmt::format("; F1 {:.4f}", *drive.scores->voxel.at("excluded").f1);
        }
        text += '\n';
    }
    std::size_t scans = 0;
    for (const RunSummary& drive : s.drives) scans += drive.scans;
    text += fmt::format(
        "tiles    {}, {} voxels; a scan reaches {:.1f} of them on average\n", s.tiles, s.voxels,
        static_cast<double>(s.visits) / static_cast<double>(std::max<std::size_t>(scans, 1)));
    text += fmt::format("speed    {:.1f} scans/s of this process ({:.1f} s, {:.1f} s of CPU)\n",
                        static_cast<double>(scans) / std::max(s.seconds.wall, 1e-9), s.seconds.wall,
                        s.seconds.cpu);
    return text;
}

int conclude(const City& city, const TileFolders& folders, bool owns, const RunOptions& o,
             OutputFolder& output, StageClock& clock) {
    const CitySummary summary =
        write_city(city, folders, owns, {.maps = o.maps, .report = o.report}, output, clock,
                   {.threads = o.threads, .online = {}}, o.quiet);
    write_complete(output, state_of_output(city, o));
    if (owns) fs::remove_all(output.path() / kTilesFolder);
    output.commit();
    if (!o.quiet) fmt::print("{}written  {}\n", to_text(city, summary), output.name().string());
    if (!o.output && !link_latest(output.name())) {
        fmt::print(stderr, "note: no link results/latest\n");
    }
    return exit_code_of(city, summary);
}

}  // namespace dynamic_filter::app
