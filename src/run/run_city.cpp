// SPDX-License-Identifier: MIT
#include "run/run_city.hpp"

#include <fmt/format.h>

#include <memory>

#include "base/exit_code.hpp"
#include "base/progress.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/file.hpp"
#include "dynamic_filter/parallel.hpp"
#include "run/filter_tiles.hpp"
#include "run/part_file.hpp"
#include "run/run_state.hpp"
#include "run/workers.hpp"
#include "run/write_city.hpp"
#include "settings/config_file.hpp"

namespace dynamic_filter::app {

namespace {

namespace fs = std::filesystem;

constexpr const char* kPlan = "plan";

/// Options that name what several processes write.
void refuse_unnamed(const RunOptions& o) {
    if (!o.output && (!o.city.part.empty() || o.city.mpi)) {
        throw ConfigError("--part and --mpi need a name for the result: -o DIR");
    }
    if (o.city.mpi && (o.overwrite || !o.city.part.empty())) {
        throw ConfigError("--mpi does not go with --overwrite or --part");
    }
}

void take_plan(City& city, const fs::path& file) {
    city.plan = read_plan(file, city.run, city.config);
    prepare(city.drives, city.plan);
}

/// Takes the plan from --plan, else from the file in the folder, else makes it. Saves it in the
/// file.
void find_plan(City& city, const RunOptions& o, const fs::path& file) {
    if (o.city.plan) {
        write_plan(file, city.plan, city.run);
        return;
    }
    if (fs::exists(file)) {
        take_plan(city, file);
        return;
    }
    with_threads(o.threads, [&] {
        city.plan = make_plan(city.drives, city.config, o.data, o.city.tile_voxels, o.quiet);
    });
    if (!interrupted()) write_plan(file, city.plan, city.run);
}

/// After all_done() was false on all processes.
int stop(const std::optional<OutputFolder>& output) {
    if (output && !interrupted()) {
        throw Error("another process of this run failed, as it says; --resume goes on");
    }
    if (output) {
        fmt::print("interrupted; the tiles that are done stay in {}, and --resume goes on\n",
                   output->path().string());
    }
    return kInterrupted;
}

/// Whom the folder of the result belongs to: only the first process holds it, the others write
/// tiles into it.
struct ResultPlace {
    fs::path folder;
    std::optional<OutputFolder> output;
    [[nodiscard]] fs::path tiles() const {
        return (output ? output->path() : folder) / kTilesFolder;
    }
};

/// Opens the folder, unless the run is complete.
void open_output(ResultPlace& place, const City& city, const RunOptions& o) {
    for (const Drive& drive : city.drives) {
        refuse_same_folder(drive.sequence.info().root, place.folder);
        refuse_same_folder(drive.sequence.info().scan_files.front().parent_path(), place.folder);
    }
    if (o.overwrite) refuse_foreign_labels(place.folder);
    place.output.emplace(place.folder, Contents::result,
                         o.resume ? Existing::resume : replaced_if(o.overwrite));
    if (o.resume) refuse_other_run(*place.output, state_of_output(city, o));
    write_state(*place.output, state_of_output(city, o));
    fs::create_directories(place.tiles());
}

int conclude_part(const City& city, const std::vector<DriveSource>& sources, const PartNumber& part,
                  const RunOptions& o, OutputFolder& output, std::size_t tiles) {
    io::write_file(output.path() / "config.toml", to_toml(city.config));
    write_part(output.path(), {.number = part, .sources = sources, .run = o});
    write_complete(output, state_of_output(city, o));
    output.commit();
    if (!o.quiet) {
        fmt::print("written  {}: {} of {} tiles; `dynamicfilter merge` puts parts together\n",
                   output.name().string(), tiles, city.plan.tiles.size());
    }
    return kDone;
}

}  // namespace

bool is_city(const RunOptions& o) {
    const bool is_list =
        o.city.recordings.size() == 1 && o.city.recordings.front().extension() == ".txt";
    return o.city.recordings.size() > 1 || is_list || !o.city.part.empty() || o.city.mpi ||
           !o.city.memory.empty() || o.city.plan.has_value();
}

/// In this order: open the drives, plan the tiles, filter them, write the result.
int run_city(const RunOptions& o) {
    StageClock clock;
    refuse_unnamed(o);
    const auto part =
        o.city.part.empty() ? std::nullopt : std::optional(part_number_of(o.city.part));
    const Effort effort{
        .threads = o.threads, .memory = memory_limit_of(o.city.memory), .quiet = o.quiet};
    const std::unique_ptr<Workers> workers = o.city.mpi ? mpi_workers() : alone();
    const std::vector<DriveSource> sources = expand(o.city.recordings);
    City city = open_city(sources, o);
    ResultPlace place{.folder = o.output ? *o.output : default_output(), .output = {}};
    const bool leads = workers->rank() == 0;
    // A part is looked through again, because one of its tiles may have been damaged since.
    if (o.resume && !part && is_complete(place.folder, state_of_output(city, o))) {
        if (leads) fs::remove_all(place.tiles());  // if a process was killed before it could
        if (leads && !o.quiet) fmt::print("complete {}\n", place.folder.string());
        return kDone;
    }
    if (o.city.plan) take_plan(city, *o.city.plan);  // before anything is left in the folder
    catch_interrupts();                              // from here on there is a folder
    if (leads) {
        open_output(place, city, o);
        find_plan(city, o, place.tiles() / kPlan);
        tell_notes(city, o.quiet);
    }
    if (!workers->all_done(!interrupted())) return stop(place.output);
    if (!leads && !o.city.plan) take_plan(city, place.tiles() / kPlan);
    clock.finish("plan");

    const std::vector<std::size_t> tiles =
        part ? tiles_of_part(city.plan.tiles, part->part, part->parts) : by_cost(city.plan.tiles);
    const bool well = filter_tiles(city, tiles, place.tiles(), *workers, effort);
    if (!workers->all_done(well)) return stop(place.output);
    clock.finish("filter");
    if (!leads) return kDone;
    if (part) return conclude_part(city, sources, *part, o, *place.output, tiles.size());
    return conclude(
        city, [&](const Tile&) { return place.tiles(); }, true, o, *place.output, clock);
}

}  // namespace dynamic_filter::app
