// SPDX-License-Identifier: MIT
#include "commands/all.hpp"
#include "commands/shared_options.hpp"
#include "run/run.hpp"

namespace dynamic_filter::app {

void add_merge(Program& program) {
    Command c = program.command("merge", "Put the parts of a run together (see run --part)");
    const auto o = std::make_shared<MergeOptions>();
    c.paths("PART", o->parts, "output folders of all parts").required();
    c.path("-o,--output", o->output, "output folder").required();
    add_threads(c, o->threads);
    c.flag("--overwrite", o->overwrite, "replace an earlier result in the output folder");
    add_quiet(c, o->quiet);
    c.action([o] { return merge(*o); });
}

}  // namespace dynamic_filter::app
