// SPDX-License-Identifier: MIT
#include "upkeep/diff.hpp"

#include "base/progress.hpp"
#include "commands/all.hpp"
#include "commands/shared_options.hpp"

namespace dynamic_filter::app {

void add_diff(Program& program) {
    Command c = program.command("diff", "Say what changed between two runs of one place");
    const auto o = std::make_shared<DiffOptions>();
    c.path("OLD", o->old_run, "output folder of a run over one recording or several").required();
    c.path("NEW", o->new_run, "output folder of a later run, in the same world").required();
    c.path("-o,--output", o->output, "output folder").required();
    c.text("--memory", o->memory,
           "most memory for the filter, for instance 1.5G; the voxels and changes of both dates "
           "come on top");
    add_threads(c, o->threads);
    c.flag("--overwrite", o->overwrite, "replace an earlier comparison in the output folder");
    add_quiet(c, o->quiet);
    c.action([o] {
        catch_interrupts();
        return diff(*o);
    });
}

}  // namespace dynamic_filter::app
