// SPDX-License-Identifier: MIT
#include "run/run.hpp"

#include "commands/all.hpp"
#include "commands/shared_options.hpp"

namespace dynamic_filter::app {

void add_run(Program& program) {
    Command c = program.command("run", "Remove moving objects from a recording");
    const auto o = std::make_shared<RunOptions>();
    add_recordings(c, *o);
    c.path("-o,--output", o->output, "output folder (default: results/<UTC stamp>)");
    add_reading_options(c, o->data);
    add_config_options(c, o->config);
    add_selection_options(c, o->data);
    const Option part = c.text(
        "--part", o->part,
        "I/N: filter only the tiles of part I of N; `dynamicfilter merge` puts the parts together");
    c.flag("--mpi", o->mpi, "share the tiles out among the processes that mpirun started")
        .excludes(part);
    c.text("--memory", o->memory, "most memory to use, for instance 1.5G: filter tile by tile");
    c.path("--plan", o->plan,
           "file that `dynamicfilter plan -o` wrote, so that the scans need not be read to plan "
           "the tiles");
    add_tile_voxels(c, *o);
    const Option update = c.path(
        "--update", o->update,
        "output folder of an earlier run of the same place: the result is the map of its drives "
        "and of these recordings");
    c.flag("--trust-poses", o->trusts_poses,
           "with --update: go on with a warning if the recordings seem not to fit to the map")
        .needs(update);
    c.flag("--keep-evidence", o->keeps_evidence,
           "keep in the output folder what --update needs to go on without filtering these "
           "recordings again");

    c.choice("--refine", o->refine, {"auto", "on", "off"},
             "refine the given poses by registering the scans; auto does so if the scans overlay "
             "better then");
    add_threads(c, o->threads);
    const Option online = c.flag(
        "--online", o->online,
        "replay the recording as a sensor would send it; scans are dropped if the filter is too "
        "slow for them");
    c.number("--speed", o->speed, {.high = 1e6},
             "with --online: how many times as fast as the sensor; 0 is as fast as possible, and "
             "drops nothing")
        .needs(online);
    const Option overwrite = c.flag(
        "--overwrite", o->overwrite,
        "replace the result of an earlier run in the output folder, once this run is complete");
    c.flag("--resume", o->resume,
           "continue a run that was interrupted or killed; the result is that of an uninterrupted "
           "run")
        .excludes(overwrite);
    const Option view =
        c.flag("--view", o->view, "show the run live in a browser, at the address that it prints");
    c.whole("--port", o->port, {.high = 65535}, "port of the view (default: any free one)")
        .needs(view);
    c.path("--edits", o->edits,
           "edits.json of another run, which is applied to labels and maps (default: that of the "
           "output folder)");
    c.flag("!--no-maps", o->maps, "do not write static_map.pcd and dynamic_points.pcd");
    c.flag("!--no-report", o->report, "do not write report.html").excludes(view);
    add_quiet(c, o->quiet);
    c.action([o] {
        o->data.data = o->recordings.front();
        return run(*o).exit_code;
    });
}

}  // namespace dynamic_filter::app
