// SPDX-License-Identifier: MIT
#include "run/run.hpp"
#include "recording/recording_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <span>

#include "base/exit_code.hpp"
#include "base/progress.hpp"
#include "base/say.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/file.hpp"
#include "dynamic_filter/parallel.hpp"
#include "run/filter_tiles.hpp"
#include "run/filter_whole.hpp"
#include "run/job.hpp"
#include "run/run_edits.hpp"
#include "run/run_state.hpp"
#include "run/update.hpp"
#include "run/workers.hpp"
#include "run/write_tiles.hpp"
#include "settings/config_file.hpp"

namespace dynamic_filter::app {

namespace {

namespace fs = std::filesystem;

/// The map to update is only read.
void refuse_within(const fs::path& map, const fs::path& output) {
    const fs::path whole = fs::weakly_canonical(map), inner = fs::weakly_canonical(output);
    const auto [in_map, in_output] =
        std::mismatch(whole.begin(), whole.end(), inner.begin(), inner.end());
    if (in_map != whole.end()) return;
    throw ConfigError(output.string() + ": is " + (in_output == inner.end() ? "" : "within ") +
                      "the map to update; choose another -o");
}

/// The folder of the result. Throws ConfigError if it holds what must stay.
fs::path choose_folder(const Job& job, const RunOptions& o) {
    if (!o.output) return default_output();
    for (const Drive& drive : job.drives) {
        for (const fs::path& folder : io::folders_of(drive.recording)) {
            refuse_same_folder(folder, *o.output);
        }
    }
    if (job.earlier) refuse_within(job.earlier->folder, *o.output);
    if (o.overwrite) refuse_foreign_labels(*o.output);
    return *o.output;
}

/// Opens the folder of the result. From here on, Ctrl-C keeps what is done.
std::unique_ptr<OutputFolder> open_folder(const RunOptions& o, const fs::path& folder) {
    if (o.catches) catch_interrupts();
    return std::make_unique<OutputFolder>(folder, result_files(),
                                          o.resume ? Existing::resume : replaced_if(o.overwrite));
}

RunResult tell_complete(const fs::path& folder, bool quiet) {
    if (!quiet) say("complete {}\n", folder.string());
    return {.exit_code = kDone, .recordings = {}};
}

void link_to_latest(const RunOptions& o, const OutputFolder& output) {
    if (o.output || link_latest(output.name())) return;
    say(stderr, "note: no link results/latest\n");
}

// One recording in memory.

/// An earlier result stays; otherwise what is there is kept.
void keep_interrupted(const RunSummary& summary, std::size_t scans, const RunOptions& o,
                      OutputFolder& output) {
    const std::string folder = output.name().string();
    if (output.path() != output.name()) {
        say("interrupted; the earlier result in {} stays\n", folder);
        return;
    }
    output.commit();
    if (!o.quiet) say("{}", to_text(summary));
    say("interrupted: {} of {} scans are written to {}; the same command with -o {} --resume goes "
        "on\n",
        summary.scans, scans, folder, folder);
    link_to_latest(o, output);
}

RunResult run_whole(Job& job, const RunOptions& o, StageClock& clock) {
    const fs::path folder = choose_folder(job, o);
    const io::Recording& recording = job.drives.front().recording;
    const std::optional<Edits> edits = edits_for(folder, o, job.config);
    std::optional<LiveView> live;
    if (o.view) {
        live.emplace(o.port, folder.filename().string(), o.data.data.string(), recording.size());
        say(stderr, "view     {}\n", live->url());
    }
    const auto output = open_folder(o, folder);
    choose_job_motion(job, o);
    const std::string mark = mark_of_output(job, o);
    if (o.resume) refuse_other_run(*output, mark);
    if (o.resume && is_complete(output->path(), mark)) {
        output->commit();
        return tell_complete(output->name(), o.quiet);
    }
    tell_remarks(job, o.quiet);
    if (interrupted()) {
        say("interrupted before the first scan was filtered; nothing was written\n");
        return {.exit_code = kInterrupted, .recordings = {}};
    }
    write_state(*output, mark);
    clock.finish("prepare");

    RunSummary summary = filter_whole(job, o, *output, clock, live ? &*live : nullptr);
    tell(std::span(summary.remarks).subspan(job.remarks.size()), "", o.quiet);
    if (summary.interrupted) {
        keep_interrupted(summary, recording.size(), o, *output);
        if (live) live->finish(output->name() / "report.html");
        return {.exit_code = kInterrupted, .recordings = {}};
    }
    if (edits) apply_to_run(output->path(), *edits, o.quiet);
    write_complete(*output, mark);
    output->commit();
    if (live) live->finish(output->name() / "report.html");
    if (!o.quiet) say("{}written  {}\n", to_text(summary), output->name().string());
    link_to_latest(o, *output);
    if (interrupted()) return {.exit_code = kInterrupted, .recordings = {}};  // all is there
    if (live) live->linger();
    return {.exit_code = are_harmless(summary.remarks) ? kDone : kRejected,
            .recordings = {std::move(summary)}};
}

// Several recordings, or one tile by tile.

void use_plan(Job& job, const fs::path& file) {
    job.plan = read_plan(file, job.mark, job.config);
    prepare(job.drives, job.plan);
}

/// Takes the plan from --plan, else from the file in the folder, else makes it. Saves it in the
/// file.
void find_plan(Job& job, const RunOptions& o, const fs::path& file) {
    if (o.plan) {
        write_plan(file, job.plan, job.mark);
        return;
    }
    if (fs::exists(file)) {
        use_plan(job, file);
        return;
    }
    with_threads(o.threads, [&] {
        job.plan =
            make_plan(job.drives, job.config, o.data, o.tile_voxels, o.quiet, earlier_plan(job));
    });
    if (!interrupted()) write_plan(file, job.plan, job.mark);
}

/// See tiles_at_a_time(). Leaves nothing behind if the memory is too small for a tile, so that the
/// corrected command can have the same folder.
std::size_t fit_into_memory(const Job& job, const std::vector<std::size_t>& tiles,
                            const Effort& effort, const OutputFolder* fresh) {
    try {
        return tiles_at_a_time(job, tiles, effort);
    } catch (const ConfigError&) {
        if (fresh) {
            fs::remove_all(fresh->path() / kTilesFolder);
            fs::remove(fresh->path() / kRunState);
        }
        throw;
    }
}

/// After all_done() was false on all processes.
RunResult stop(const OutputFolder* output) {
    if (output && !interrupted()) {
        throw Error("another process of this run failed, as it says; --resume goes on");
    }
    if (output) {
        say("interrupted; the tiles that are done stay in {}; the same command with -o {} --resume "
            "goes on\n",
            output->path().string(), output->name().string());
    }
    return {.exit_code = kInterrupted, .recordings = {}};
}

RunResult finish_part(const Job& job, const RunOptions& o, OutputFolder& output,
                      std::size_t tiles) {
    io::write_file(output.path() / "config.toml", to_toml(job.config));
    write_part(output.path(), {.number = *job.part, .sources = job.sources, .run = o});
    write_complete(output, mark_of_output(job, o));
    output.commit();
    if (!o.quiet) {
        say("written  {}: {} of {} tiles; `dynamicfilter merge` puts parts together\n",
            output.name().string(), tiles, job.plan.tiles.size());
    }
    return {.exit_code = kDone, .recordings = {}};
}

/// Only the first process holds the folder of the result; the others write tiles into it.
RunResult run_tiles(Job& job, const RunOptions& o, StageClock& clock) {
    const Effort effort{
        .threads = o.threads, .memory = memory_limit_of(o.memory), .quiet = o.quiet};
    const std::unique_ptr<Workers> workers = o.mpi ? mpi_workers() : alone();
    const fs::path folder = choose_folder(job, o);
    const bool leads = workers->rank() == 0;
    const std::string mark = mark_of_output(job, o);
    // A part is looked through again, because one of its tiles may have been damaged since.
    if (o.resume && !job.part && is_complete(folder, mark)) {
        if (!leads) return {};
        fs::remove_all(folder / kTilesFolder);  // if a process was killed before it could
        return tell_complete(folder, o.quiet);
    }
    if (o.plan) use_plan(job, *o.plan);  // before anything is left in the folder
    const auto output = leads ? open_folder(o, folder) : nullptr;
    if (!leads) catch_interrupts();
    const bool is_fresh = output && output->is_empty();
    const fs::path tiles_folder = (output ? output->path() : folder) / kTilesFolder;
    if (leads) {
        if (o.resume) refuse_other_run(*output, mark);
        write_state(*output, mark);
        fs::create_directories(tiles_folder);
        find_plan(job, o, tiles_folder / kPlanFile);
        tell_remarks(job, o.quiet);
    }
    if (!workers->all_done(!interrupted())) return stop(output.get());
    if (!leads && !o.plan) use_plan(job, tiles_folder / kPlanFile);
    clock.finish("plan");

    const std::vector<std::size_t> tiles =
        job.part ? tiles_of_part(job.plan.tiles, job.part->part, job.part->parts)
                 : by_cost(job.plan.tiles);
    const std::size_t at_a_time =
        fit_into_memory(job, tiles, effort, is_fresh ? output.get() : nullptr);
    const bool well = filter_tiles(job, tiles, at_a_time, tiles_folder, *workers, effort);
    if (!workers->all_done(well)) return stop(output.get());
    clock.finish("filter");
    if (!leads) return {};
    if (job.part) return finish_part(job, o, *output, tiles.size());
    RunResult result = finish_tiles(
        job, [&](const Tile&) { return tiles_folder; }, o, *output, clock);
    link_to_latest(o, *output);
    return result;
}

}  // namespace

RunResult run(const RunOptions& o) {
    StageClock clock;
    if (!o.after.empty()) clock.finish(o.after);
    if (o.update) {
        Update update = open_update(o);
        return run_tiles(update.job, update.options, clock);
    }
    Job job = open_job(o);
    return job.is_tiled ? run_tiles(job, o, clock) : run_whole(job, o, clock);
}

}  // namespace dynamic_filter::app
