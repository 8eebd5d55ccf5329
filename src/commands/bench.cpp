// SPDX-License-Identifier: MIT
#include "arena/bench.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "arena/arena.hpp"
#include "base/exit_code.hpp"
#include "base/progress.hpp"
#include "commands/all.hpp"
#include "commands/shared_options.hpp"
#include "dynamic_filter/error.hpp"

namespace dynamic_filter::app {

void add_bench(Program& program) {
    Command c = program.command("bench", "Score this program, and others, on a public benchmark");
    const auto o = std::make_shared<BenchOptions>();
    const auto preset = std::make_shared<std::string>("both");
    const auto twin = std::make_shared<bool>(false);
    c.choice("ARENA", o->arena, arena_names(), "the benchmark; docs/arenas.md has their rules")
        .required();
    c.path("DATA", o->data,
           "folder of the data set, as its authors unpack it (none: say what to download, and what "
           "others published)");
    c.path("-o,--output", o->output,
           "output folder, for the runs and the tables (default: bench-ARENA)");
    c.words("--only", o->only, "an entry of the benchmark, such as 00; may be given several times");
    c.choice("--preset", *preset, {"both", "default", "paper"}, "which settings to run with");
    c.words("--peer", o->peers,
            "NAME=FOLDER: also score the results of another program, FOLDER/ENTRY/*.label or "
            "FOLDER/ENTRY.pcd; may be given several times");
    c.flag("--no-run", o->no_run, "score only what --peer names");
    c.text(
        "--poses", o->poses,
        "name of the pose file in the folder of each entry, or `none` for own odometry (default: "
        "those of the benchmark)");
    c.flag("--submission", o->submission,
           "also write the files by which the benchmark lists a program, in OUTPUT/submission");
    c.flag("--twin", *twin,
           "write a small simulated recording of each entry into DATA, in the layout of the data "
           "set, and do nothing else");
    add_threads(c, o->threads);
    add_quiet(c, o->quiet);
    c.action([o, preset, twin] {
        if (*twin && o->data.empty())
            throw ConfigError("--twin needs DATA, the folder to write to");
        if (o->no_run && o->submission) {
            throw ConfigError("--submission is of this program, which --no-run leaves out");
        }
        if (o->data.empty()) {
            tell_arena(o->arena);
            return static_cast<int>(kDone);
        }
        if (o->output.empty()) o->output = "bench-" + o->arena;
        if (*preset != "both") o->presets = {*preset};
        if (o->no_run && o->peers.empty()) throw ConfigError("--no-run needs a --peer to score");
        catch_interrupts();
        if (!*twin) return bench(*o);
        write_twins(*o);
        return static_cast<int>(kDone);
    });
}

}  // namespace dynamic_filter::app
