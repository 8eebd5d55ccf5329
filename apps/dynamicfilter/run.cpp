// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "advice.hpp"
#include "commands.hpp"
#include "config_file.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/io/file.hpp"
#include "dynamic_filter/io/preflight.hpp"
#include "dynamic_filter/parallel.hpp"
#include "edits/run_edits.hpp"
#include "frames.hpp"
#include "motion.hpp"
#include "progress.hpp"
#include "run_reports.hpp"

namespace dynamic_filter::app {

namespace {

namespace fs = std::filesystem;

constexpr const char* kComplete = "complete\n";

/// What a run was begun with: whoever resumes it must come with the same.
std::string begun_with(const io::Sequence& sequence, const Config& config, const Extras& extras) {
    std::error_code ignored;
    std::uintmax_t bytes = sequence.bag && fs::is_regular_file(sequence.root, ignored)
                               ? fs::file_size(sequence.root, ignored)
                               : 0;
    for (const fs::path& file : sequence.scan_files) {
        if (fs::is_regular_file(file, ignored)) bytes += fs::file_size(file, ignored);
    }
    return fmt::format(
        "version {}\ninput {}\nscans {} from {} to {}, {} bytes\n{}{}{}", DYNAMIC_FILTER_VERSION,
        fs::absolute(sequence.root).lexically_normal().string(), sequence.size(),
        io::stem(sequence, 0), io::stem(sequence, sequence.size() - 1), bytes,
        extras.maps ? "" : "no maps\n", extras.report ? "" : "no report\n", to_toml(config));
}

/// Labels that no run left may be somebody's ground truth.
void refuse_foreign_labels(const fs::path& folder) {
    const bool of_a_run = fs::exists(folder / kRunState) || fs::exists(folder / "config.toml");
    if (of_a_run || !fs::exists(folder / "labels")) return;
    throw ConfigError(
        folder.string() +
        ": holds labels that no run left, so --overwrite is refused; choose another -o");
}

/// True if nothing is left to do. Throws ConfigError if that run was another one.
bool is_complete(const OutputFolder& output, const std::string& state) {
    if (output.is_empty()) return false;
    const fs::path file = output.path() / kRunState;
    if (!fs::exists(file)) {
        throw ConfigError(output.name().string() +
                          ": holds something that no run of this version began; use --overwrite "
                          "or another -o");
    }
    const std::string found = io::read_file(file);
    if (found == state + kComplete) return true;
    if (found == state) return false;
    throw ConfigError(
        output.name().string() +
        ": was begun with another recording, other settings, other outputs (--no-maps, "
        "--no-report) or another version; go on "
        "with those (see config.toml and run.log there), or start afresh with "
        "--overwrite");
}

void tell(const std::vector<std::string>& notes, bool quiet) {
    if (quiet) return;
    for (const std::string& note : notes) fmt::print(stderr, "note: {}\n", note);
}

}  // namespace

int run(const RunOptions& o) {
    StageClock clock;
    if (!o.after.empty()) clock.finish(o.after);
    Config config = load_config(o.config);
    io::Sequence sequence = open(o.data);
    const bool named = o.output.has_value();
    if (named) {
        refuse_same_folder(o.data.data, *o.output);
        refuse_same_folder(sequence.scan_files.front().parent_path(), *o.output);
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
    OutputFolder output(folder, Contents::result,
                        o.resume ? Existing::resume : replaced_if(o.overwrite));
    std::vector<std::string> chosen;
    with_threads(o.threads, [&] {
        chosen = choose_motion(sequence, config, {.refine = o.refine, .deskew = o.data.deskew});
    });
    sequence.notes.insert(sequence.notes.end(), chosen.begin(), chosen.end());
    const Extras extras{.maps = o.maps, .report = o.report};
    const std::string state = begun_with(sequence, config, extras);
    if (o.resume && is_complete(output, state)) {
        output.commit();
        if (!o.quiet) fmt::print("complete {}\n", output.name().string());
        return kDone;
    }
    io::write_file(output.path() / kRunState, state);
    tell(sequence.notes, o.quiet);
    for (const io::Finding& found : io::check_recording(sequence, io::Depth::quick).findings) {
        const io::Finding finding = blame_needless_fix(found, o.data);
        fmt::print(stderr, "warning: {}; {}{} (`dynamicfilter check` looks closer)\n", finding.what,
                   finding.advice.starts_with("--") ? "try " : "", finding.advice);
    }

    if (o.catches) catch_interrupts();
    clock.finish("prepare");
    const Pace pace{.threads = o.threads,
                    .online = o.online ? std::optional(o.speed) : std::nullopt};
    const RunSummary summary =
        run_sequence(sequence, config, pace, output, clock,
                     {.live = live ? &*live : nullptr, .quiet = o.quiet}, extras);

    tell(summary.notes, o.quiet);
    for (const std::string& line : sequence.losses) fmt::print(stderr, "lost     {}\n", line);
    for (const std::string& line : summary.rejected) fmt::print(stderr, "rejected {}\n", line);
    for (const std::string& line : summary.dropped) fmt::print(stderr, "dropped {}\n", line);
    if (edits && !summary.interrupted) apply_to_run(output.path(), *edits, o.quiet);
    if (!summary.interrupted) io::write_file(output.path() / kRunState, state + kComplete);
    if (summary.interrupted && output.path() != output.name()) {
        fmt::print("interrupted; the earlier result in {} stays\n", output.name().string());
        return kInterrupted;
    }
    output.commit();
    if (live) live->finish(output.name() / "report.html");
    if (!o.quiet) fmt::print("{}written  {}\n", to_text(summary), output.name().string());
    if (!named && !link_latest(output.name())) fmt::print(stderr, "note: no link results/latest\n");
    if (2 * summary.unknown > summary.points) {
        fmt::print(stderr,
                   "note: most points are unknown; are the first poses of another place?\n");
    }
    if (interrupted()) return kInterrupted;  // also while it scored and reported: all is there
    if (live) live->linger();
    const bool all = summary.rejected.empty() && summary.dropped.empty() && sequence.losses.empty();
    return all ? kDone : kRejected;
}

}  // namespace dynamic_filter::app
