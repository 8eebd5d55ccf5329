// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "commands.hpp"
#include "config_file.hpp"
#include "dynamic_filter/io/preflight.hpp"
#include "frames.hpp"
#include "progress.hpp"
#include "run_sequence.hpp"

namespace dynamic_filter::app {

int run(const RunOptions& o) {
    const Config config = load_config(o.config);
    const io::Sequence sequence = open(o.data);
    const bool named = o.output.has_value();
    if (named) {
        refuse_same_folder(o.data.data, *o.output);
        refuse_same_folder(sequence.scan_files.front().parent_path(), *o.output);
    }
    const OutputFolder output(named ? *o.output : default_output(), Contents::result, o.overwrite);
    for (const std::string& note : sequence.notes) fmt::print(stderr, "note: {}\n", note);
    for (const io::Finding& finding : io::check_recording(sequence, io::Depth::quick).findings) {
        fmt::print(stderr, "warning: {}; try {} (`dynamicfilter check` looks closer)\n",
                   finding.what, finding.advice);
    }

    catch_interrupts();
    const Pace pace{.threads = o.threads,
                    .online = o.online ? std::optional(o.speed) : std::nullopt};
    const RunSummary summary = run_sequence(sequence, config, pace, output);

    for (const std::string& line : summary.notes) fmt::print(stderr, "note: {}\n", line);
    for (const std::string& line : summary.rejected) fmt::print(stderr, "rejected {}\n", line);
    for (const std::string& line : summary.dropped) fmt::print(stderr, "dropped {}\n", line);
    fmt::print("{}written  {}\n", to_text(summary), output.path().string());
    if (!named && !link_latest(output.path())) fmt::print(stderr, "note: no link results/latest\n");
    if (2 * summary.unknown > summary.points) {
        fmt::print(stderr,
                   "note: most points are unknown; are the first poses of another place?\n");
    }
    if (summary.interrupted) return kInterrupted;
    return summary.rejected.empty() && summary.dropped.empty() ? kDone : kRejected;
}

}  // namespace dynamic_filter::app
