// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/exit_code.hpp"
#include "base/say.hpp"
#include "dynamic_filter/error.hpp"
#include "run/part_file.hpp"
#include "run/run.hpp"
#include "run/run_state.hpp"
#include "run/tile_file.hpp"
#include "run/write_tiles.hpp"

namespace dynamic_filter::app {

namespace {

namespace fs = std::filesystem;

/// What the parts of one run have in common.
auto key_of(const Part& part) {
    std::vector<fs::path> recordings;
    for (const DriveSource& source : part.sources) recordings.push_back(source.recording);
    return std::tuple(part.number.parts, recordings, part.run.tile_voxels, part.run.maps,
                      part.run.report);
}

std::vector<Part> read_parts(const std::vector<fs::path>& folders) {
    std::vector<Part> parts;
    for (const fs::path& folder : folders) {
        parts.push_back(read_part(folder));
        if (key_of(parts.back()) == key_of(parts.front())) continue;
        throw ConfigError(folder.string() + " and " + folders.front().string() +
                          " are not parts of the same run: their recordings or options differ");
    }
    return parts;
}

/// The folder that holds the files of each tile: that of its part.
std::map<Tile, fs::path> find_tiles(const Job& job, const std::vector<Part>& parts,
                                    const std::vector<fs::path>& folders) {
    const std::size_t count = parts.front().number.parts;
    const std::vector<std::size_t> part_of = part_of_tiles(job.plan.tiles, count);
    std::vector<std::size_t> order = by_cost(job.plan.tiles);  // so that the first part is named
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return part_of[a] < part_of[b]; });
    std::map<Tile, fs::path> found;
    for (const std::size_t t : order) {
        const Tile& tile = job.plan.tiles[t].tile;
        for (std::size_t p = 0; p < parts.size() && !found.contains(tile); ++p) {
            const fs::path tiles = folders[p] / kTilesFolder;
            const bool holds =
                parts[p].number.part == part_of[t] && is_done(tiles / tile_file(tile), job.mark);
            if (holds) found[tile] = tiles;
        }
        if (found.contains(tile)) continue;
        throw ConfigError(fmt::format(
            "part {}/{} is missing: none of the given folders holds its tile {} undamaged; give "
            "the folder of that part, or run it again with --resume",
            part_of[t], count, name_of(tile)));
    }
    return found;
}

}  // namespace

int merge(const MergeOptions& o) {
    StageClock clock;
    const std::vector<Part> parts = read_parts(o.parts);
    RunOptions run = parts.front().run;
    run.output = o.output;
    run.threads = o.threads;
    run.quiet = o.quiet;
    Job job = open_tiled_job(run, parts.front().sources);
    job.plan = read_plan(o.parts.front() / kTilesFolder / "plan", job.mark, job.config);
    prepare(job.drives, job.plan);
    tell_remarks(job, true);
    const auto folders = find_tiles(job, parts, o.parts);
    for (const fs::path& folder : o.parts)
        refuse_same_folder(folder, o.output, "is one of the parts");
    const std::string mark = mark_of_output(job, run);
    if (!o.overwrite && is_complete(o.output, mark)) {
        if (!o.quiet) say("complete {}\n", o.output.string());
        return kDone;
    }
    // Goes on in the folder of an interrupted merge of the same parts, also without --overwrite.
    OutputFolder output(o.output, result_files(),
                        is_begun(o.output, mark) ? Existing::resume : replaced_if(o.overwrite));
    write_state(output, mark);
    clock.finish("prepare");
    const auto folder_of_tile = [&](const Tile& tile) { return folders.at(tile); };
    return finish_tiles(job, folder_of_tile, run, output, clock).exit_code;
}

}  // namespace dynamic_filter::app
