// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/exit_code.hpp"
#include "base/output_folder.hpp"
#include "base/progress.hpp"
#include "base/say.hpp"
#include "commands/all.hpp"
#include "commands/shared_options.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/parallel.hpp"
#include "run/filter_tiles.hpp"
#include "run/job.hpp"
#include "run/run.hpp"
#include "score/report.hpp"

namespace dynamic_filter::app {

namespace {

struct PlanOptions {
    RunOptions run;         ///< of the run that is planned
    std::size_t parts = 1;  ///< into which the tiles are divided
    bool json = false;
};

namespace fs = std::filesystem;

struct Totals {
    std::size_t scans = 0, visits = 0, voxels = 0, memory = 0;  // memory: of the largest tile
    double cost = 0.0;                                          // [s]
    std::vector<double> by_part;
};

Totals totals_of(const Job& job, const std::vector<std::size_t>& part_of, std::size_t parts) {
    Totals totals{.by_part = std::vector<double>(parts)};
    for (const PlannedDrive& drive : job.plan.drives) totals.scans += used_scans(drive).size();
    for (std::size_t t = 0; t < job.plan.tiles.size(); ++t) {
        const TileWork& work = job.plan.tiles[t];
        totals.visits += work.scans.size();
        totals.voxels += work.voxels;
        totals.memory = std::max(totals.memory, memory_of(work, job.plan, job.config));
        totals.cost += work.cost();
        totals.by_part[part_of[t] - 1] += work.cost();
    }
    return totals;
}

std::string plan_text(const Job& job, std::size_t parts) {
    const Totals t = totals_of(job, part_of_tiles(job.plan.tiles, parts), parts);
    std::string text = fmt::format(
        "drives   {}, {} scans\n"
        "tiles    {}, about {:.1f} million voxels; a scan reaches {:.1f} of them on average\n"
        "memory   about {:.2f} GB for a process with the largest tile\n"
        "time     about {:.2f} hours of one core\n",
        job.drives.size(), t.scans, job.plan.tiles.size(), 1e-6 * static_cast<double>(t.voxels),
        static_cast<double>(t.visits) / static_cast<double>(std::max<std::size_t>(t.scans, 1)),
        1e-9 * static_cast<double>(process_memory(t.memory)), t.cost / 3600.0);
    if (parts > 1) {
        const auto [least, most] = std::minmax_element(t.by_part.begin(), t.by_part.end());
        text += fmt::format("parts    {}, of {:.2f} to {:.2f} hours\n", parts, *least / 3600.0,
                            *most / 3600.0);
    }
    return text;
}

std::string plan_json(const Job& job, std::size_t parts) {
    const std::vector<std::size_t> part_of = part_of_tiles(job.plan.tiles, parts);
    const Totals totals = totals_of(job, part_of, parts);
    nlohmann::ordered_json json{{"scans", totals.scans},
                                {"visits", totals.visits},
                                {"cost_seconds", totals.cost},
                                {"memory_bytes", process_memory(totals.memory)},
                                {"tiles", nlohmann::ordered_json::array()}};
    for (std::size_t t = 0; t < job.plan.tiles.size(); ++t) {
        const TileWork& work = job.plan.tiles[t];
        json["tiles"].push_back({{"name", name_of(work.tile)},
                                 {"part", part_of[t]},
                                 {"voxels", work.voxels},
                                 {"scans", work.scans.size()},
                                 {"cost_seconds", work.cost()},
                                 {"memory_bytes", memory_of(work, job.plan, job.config)}});
    }
    return text_of(json);
}

}  // namespace

int plan(const PlanOptions& options) {
    const RunOptions& o = options.run;
    Job job = open_tiled_job(o, expand(o.recordings));
    catch_interrupts();
    with_threads(o.threads, [&] {
        job.plan = make_plan(job.drives, job.config, o.data, o.tile_voxels, o.quiet);
    });
    if (interrupted()) return kInterrupted;
    tell_remarks(job, o.quiet);
    if (o.output) {
        refuse_existing(*o.output, o.overwrite);
        write_plan(*o.output, job.plan, job.mark);
    }
    say("{}", options.json ? plan_json(job, options.parts) : plan_text(job, options.parts));
    return kDone;
}

void add_plan(Program& program) {
    Command c = program.command(
        "plan", "Show the tiles, the time and the memory that a run over large recordings takes");
    const auto o = std::make_shared<PlanOptions>();
    add_recordings(c, o->run);
    c.path("-o,--output", o->run.output, "also write the plan to this file, for run --plan");
    add_reading_options(c, o->run.data);
    add_config_options(c, o->run.config);
    add_selection_options(c, o->run.data);
    add_tile_voxels(c, o->run);
    c.whole("--parts", o->parts, {.low = 1, .high = 100000},
            "number of parts into which the tiles are divided");
    c.flag("--json", o->json, "print every tile, as JSON");
    add_threads(c, o->run.threads);
    c.flag("--overwrite", o->run.overwrite, "replace the file of -o");
    c.flag("-q,--quiet", o->run.quiet, "print only the plan, warnings and errors");
    c.action([o] { return plan(*o); });
}

}  // namespace dynamic_filter::app
