// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "base/exit_code.hpp"
#include "base/progress.hpp"
#include "check/advice.hpp"
#include "check/motion.hpp"
#include "dynamic_filter/check.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/parallel.hpp"
#include "recording/frames.hpp"
#include "run/run.hpp"
#include "run/run_city.hpp"
#include "run/run_edits.hpp"
#include "run/run_reports.hpp"
#include "run/run_state.hpp"
#include "settings/config_file.hpp"

namespace dynamic_filter::app {

namespace {

namespace fs = std::filesystem;

/// What a run was begun with: whoever resumes it must come with the same.
std::string begun_with(const io::Recording& sequence, const Config& config, const Extras& extras) {
    return fmt::format("version {}\n{}{}{}{}", DYNAMIC_FILTER_VERSION, state_of(sequence),
                       extras.maps ? "" : "no maps\n", extras.report ? "" : "no report\n",
                       to_toml(config));
}

void tell(const std::vector<std::string>& notes, bool quiet) {
    if (quiet) return;
    for (const std::string& note : notes) fmt::print(stderr, "note: {}\n", note);
}

void tell_written(const RunSummary& summary, std::size_t scans, const fs::path& folder,
                  bool quiet) {
    if (summary.interrupted) {
        fmt::print(
            "interrupted: {} of {} scans are written to {}; the same command with -o {} --resume "
            "goes on\n",
            summary.scans, scans, folder.string(), folder.string());
    } else if (!quiet) {
        fmt::print("written  {}\n", folder.string());
    }
}

}  // namespace

int run(const RunOptions& o) {
    if (is_city(o)) return run_city(o);
    StageClock clock;
    if (!o.after.empty()) clock.finish(o.after);
    Config config = load_config(o.config);
    io::Recording sequence = open(o.data);
    const bool named = o.output.has_value();
    if (named) {
        refuse_same_folder(o.data.data, *o.output);
        refuse_same_folder(sequence.info().scan_files.front().parent_path(), *o.output);
    }
    if (o.resume && !named) throw ConfigError("--resume needs the folder to go on with: -o DIR");
    if (o.overwrite && named) refuse_foreign_labels(*o.output);
    const fs::path folder = named ? *o.output : default_output();
    const std::optional<Edits> edits = edits_for(folder, o, config);
    std::optional<LiveView> live;
    if (o.view) {
        live.emplace(o.port, folder.filename().string(), o.data.data.string(), sequence.size());
        fmt::print(stderr, "view     {}\n", live->url());
    }
    if (o.catches) catch_interrupts();  // from here on there is a folder
    OutputFolder output(folder, Contents::result,
                        o.resume ? Existing::resume : replaced_if(o.overwrite));
    std::vector<std::string> chosen;
    with_threads(o.threads, [&] {
        chosen = choose_motion(sequence, config, {.refine = o.refine, .deskew = o.data.deskew});
    });
    sequence = io::with_notes(sequence, chosen);
    const Extras extras{.maps = o.maps, .report = o.report};
    const std::string state = begun_with(sequence, config, extras);
    if (o.resume) refuse_other_run(output, state);
    if (o.resume && is_complete(output.path(), state)) {
        output.commit();
        if (!o.quiet) fmt::print("complete {}\n", output.name().string());
        return kDone;
    }
    tell(sequence.info().notes, o.quiet);
    for (const io::Finding& found : io::check_recording(sequence, io::Depth::quick).findings) {
        fmt::print(stderr, "warning: {}\n", warning_of(found, o.data));
    }
    if (interrupted()) {
        fmt::print("interrupted before the first scan was filtered; nothing was written\n");
        return kInterrupted;
    }
    write_state(output, state);
    clock.finish("prepare");
    const Pace pace{.threads = o.threads,
                    .online = o.online ? std::optional(o.speed) : std::nullopt};
    const RunSummary summary =
        run_sequence(sequence, config, pace, output, clock,
                     {.live = live ? &*live : nullptr, .quiet = o.quiet}, extras);

    tell(summary.notes, o.quiet);
    for (const std::string& line : sequence.info().losses)
        fmt::print(stderr, "lost     {}\n", line);
    for (const std::string& line : summary.rejected) fmt::print(stderr, "rejected {}\n", line);
    for (const std::string& line : summary.dropped) fmt::print(stderr, "dropped {}\n", line);
    if (edits && !summary.interrupted) apply_to_run(output.path(), *edits, o.quiet);
    if (!summary.interrupted) write_complete(output, state);
    if (summary.interrupted && output.path() != output.name()) {
        fmt::print("interrupted; the earlier result in {} stays\n", output.name().string());
        return kInterrupted;
    }
    output.commit();
    if (live) live->finish(output.name() / "report.html");
    if (!o.quiet) fmt::print("{}", to_text(summary));
    tell_written(summary, sequence.size(), output.name(), o.quiet);
    if (!named && !link_latest(output.name())) fmt::print(stderr, "note: no link results/latest\n");
    if (2 * summary.unknown > summary.points) {
        fmt::print(stderr,
                   "note: most points are unknown; are the first poses of another place?\n");
    }
    if (interrupted()) return kInterrupted;  // also while it scored and reported: all is there
    if (live) live->linger();
    const bool all =
        summary.rejected.empty() && summary.dropped.empty() && sequence.info().losses.empty();
    return all ? kDone : kRejected;
}

}  // namespace dynamic_filter::app
