// SPDX-License-Identifier: MIT
#include "arena/bench.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "arena/arena.hpp"
#include "arena/score_trial.hpp"
#include "arena/submission.hpp"
#include "arena/table.hpp"
#include "base/exit_code.hpp"
#include "base/output_folder.hpp"
#include "base/progress.hpp"
#include "base/say.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/file.hpp"
#include "dynamic_filter/parallel.hpp"
#include "formats/label_files.hpp"
#include "recording/folders.hpp"
#include "recording/scans.hpp"
#include "run/placed.hpp"
#include "run/run.hpp"

namespace dynamic_filter::app {

namespace {

namespace fs = std::filesystem;

/// A result of another program.
struct Peer {
    std::string name;
    fs::path folder;
};

std::vector<Peer> peers_of(const BenchOptions& o) {
    std::vector<Peer> peers;
    for (const std::string& text : o.peers) {
        const std::size_t at = text.find('=');
        if (at == 0 || at == std::string::npos || at + 1 == text.size()) {
            throw ConfigError(fmt::format("--peer {}: expected NAME=FOLDER", text));
        }
        peers.push_back({text.substr(0, at), text.substr(at + 1)});
        if (io::present(peers.back().folder)) continue;
        throw InputError(peers.back().folder, "", "does not exist");
    }
    return peers;
}

/// The peer's result of an entry; nothing if it has none.
std::optional<Estimate> estimate_of(const Peer& peer, const std::string& entry) {
    const fs::path folder = peer.folder / entry;
    if (io::is_folder(folder)) return Estimate{.labels = io::label_folder(folder), .map = {}};
    for (const char* extension : {".pcd", ".ply"}) {
        const fs::path map = fs::path(folder) += extension;
        if (io::present(map)) return Estimate{.labels = {}, .map = map};
    }
    return {};
}

std::vector<std::string> wanted_entries(const Arena& arena, const BenchOptions& o) {
    if (!o.only.empty()) return o.only;
    return arena.entries_in ? arena.entries_in(o.data) : arena.entries;
}

InputError nothing_found(const Arena& arena, const BenchOptions& o, const std::string& what) {
    return InputError(o.data, "",
                      fmt::format("has no {} of {}. Expected is {}. Download {}", what, arena.title,
                                  arena.layout, arena.download));
}

/// Throws ConfigError if an entry was asked for that the arena has not got.
void refuse_unknown_entries(const Arena& arena, const BenchOptions& o) {
    if (arena.entries_in) return;  // whatever is there
    for (const std::string& entry : o.only) {
        if (std::find(arena.entries.begin(), arena.entries.end(), entry) != arena.entries.end()) {
            continue;
        }
        throw ConfigError(fmt::format("{} has no entry '{}'; choose from {}", arena.name, entry,
                                      fmt::join(arena.entries, ", ")));
    }
}

/// The entries that are there. Throws InputError if none is, or one that was asked for is not.
std::vector<Trial> find_trials(const Arena& arena, const BenchOptions& o) {
    if (!io::is_folder(o.data)) throw InputError(o.data, "", "is not a folder");
    std::vector<Trial> trials;
    std::vector<std::string> missing;
    for (const std::string& entry : wanted_entries(arena, o)) {
        if (auto trial = arena.find(o.data, entry)) {
            trials.push_back(std::move(*trial));
        } else if (!o.only.empty()) {
            throw nothing_found(arena, o, entry);
        } else {
            missing.push_back(entry);
        }
    }
    if (trials.empty()) throw nothing_found(arena, o, "recording");
    if (!missing.empty()) {
        say(stderr, "note: {} not there: {}. Expected is {}. Download {}\n",
            missing.size() == 1 ? "this entry is" : "these entries are", fmt::join(missing, ", "),
            arena.layout, arena.download);
    }
    return trials;
}

/// Throws InputError if a scan that is scored is damaged, or has not one label for each point:
/// without it, the figures would not be those of the arena. Others are left out by the run.
void refuse_damaged(const Trial& trial, const io::Recording& recording) {
    const io::Info& info = recording.info();
    for (const std::size_t i : scored_scans(trial, recording)) {
        recording.check(i);
        const bool tells_points = !info.label_files.empty() && !info.label_files[i].empty() &&
                                  info.label_files[i].extension() == ".label" &&
                                  info.scan_files[i].extension() == ".bin";
        if (!tells_points) continue;
        const auto labels = fs::file_size(info.label_files[i]) / 4;
        const auto points = fs::file_size(info.scan_files[i]) / 16;
        if (labels == points) continue;
        throw InputError(info.label_files[i], "",
                         fmt::format("has {} labels, but its scan has {} points", labels, points));
    }
}

/// What the reader assumed, for whoever looks at the table.
void tell_notes(const io::Recording& recording) {
    for (const std::string& note : recording.info().notes) say(stderr, "note: {}\n", note);
    for (const std::string& loss : recording.info().losses) say(stderr, "lost     {}\n", loss);
}

/// How the run reads the recording.
DataOptions run_data(const Trial& trial, const BenchOptions& o) {
    DataOptions data = trial.data;
    if (o.poses.empty()) return data;
    const fs::path& at = trial.data.data;  // a folder, or a bag in it
    data.poses = o.poses == kNoPoses ? fs::path(kNoPoses)
                                     : (io::is_folder(at) ? at : at.parent_path()) / o.poses;
    return data;
}

/// Filters the recording into the folder, unless that is done. Returns the exit code.
int filter(const Trial& trial, const std::string& preset, const fs::path& folder,
           const BenchOptions& o) {
    RunOptions run;
    run.recordings = {trial.data.data};
    run.data = run_data(trial, o);
    run.output = folder;
    run.config.preset = preset;
    run.threads = o.threads;
    run.resume = io::present(folder);
    run.maps = run.report = false;
    run.quiet = true;
    run.catches = false;
    try {
        return app::run(run).exit_code;
    } catch (const ConfigError& error) {
        if (!run.resume) throw;
        throw ConfigError(
            fmt::format("{} (`bench` begins afresh once that folder is removed, or "
                        "with another -o)",
                        error.what()));
    }
}

MeasuredFigure measure(const Arena& arena, const Trial& trial, const io::Recording& recording,
                       const std::string& method, const Estimate& estimate, const BenchOptions& o) {
    MeasuredFigure figure{trial.entry, method, {}, trial.notes};
    with_threads(o.threads, [&] { figure.scores = arena.score(trial, recording, estimate); });
    if (o.quiet) return figure;
    say("{}", figure_text(arena, figure));
    std::fflush(stdout);
    return figure;
}

/// Writes the tables. What an earlier call measured of other entries, or of other methods, stays.
void write_tables(const Arena& arena, std::vector<MeasuredFigure> figures,
                  const std::vector<MeasuredFigure>& earlier, const fs::path& folder) {
    for (const MeasuredFigure& one : earlier) {
        const bool is_new = std::none_of(figures.begin(), figures.end(), [&](const auto& figure) {
            return figure.entry == one.entry && figure.method == one.method;
        });
        if (is_new) figures.push_back(one);
    }
    const auto place = [&](const MeasuredFigure& figure) {
        return std::find(arena.entries.begin(), arena.entries.end(), figure.entry);
    };
    std::stable_sort(figures.begin(), figures.end(),
                     [&](const auto& a, const auto& b) { return place(a) < place(b); });
    add_means_of_groups(arena, figures);
    io::write_file(folder / "table.md", arena_markdown(arena, figures));
    io::write_file(folder / "table.json", arena_json(arena, figures));
}

/// "station-sequence_1" for "station/sequence_1": a folder for each entry.
std::string folder_name(std::string entry) {
    std::replace(entry.begin(), entry.end(), '/', '-');
    return entry;
}

/// Whether the run took other poses than those of the trial.
bool has_other_poses(const fs::path& run) {
    const auto placed = read_placed(run);
    return placed && !placed->tracked.empty();
}

/// Runs and scores each preset. Returns the worst exit code of the runs.
int measure_ours(const Arena& arena, const Trial& trial, const io::Recording& recording,
                 const BenchOptions& o, std::vector<MeasuredFigure>& figures) {
    int worst = kDone;
    for (const std::string& preset : o.presets) {
        const fs::path folder = o.output / folder_name(trial.entry) / preset;
        worst = std::max(worst, filter(trial, preset, folder, o));
        if (interrupted()) return kInterrupted;
        const Estimate estimate{.labels = folder / "labels", .map = {}};
        figures.push_back(
            measure(arena, trial, recording, "DynamicFilter, preset " + preset, estimate, o));
        if (has_other_poses(folder)) {
            figures.back().notes.emplace_back(o.poses == kNoPoses || !recording.info().has_poses
                                                  ? "run with own odometry"
                                                  : "run with refined poses");
        } else if (!o.poses.empty()) {
            figures.back().notes.push_back("run with poses of " + o.poses);
        }
        if (!o.submission || preset != o.presets.front()) continue;
        write_submission(arena, trial, recording, *estimate.labels, o.output / "submission");
    }
    return worst;
}

void measure_peers(const Arena& arena, const Trial& trial, const io::Recording& recording,
                   const std::vector<Peer>& peers, const BenchOptions& o,
                   std::vector<MeasuredFigure>& figures) {
    for (const Peer& peer : peers) {
        if (interrupted()) return;
        if (const auto estimate = estimate_of(peer, trial.entry)) {
            figures.push_back(measure(arena, trial, recording, peer.name, *estimate, o));
            continue;
        }
        say(stderr, "note: {} has no result of {}: neither {}/ nor {}.pcd in {}\n", peer.name,
            trial.entry, trial.entry, trial.entry, peer.folder.string());
    }
}

/// Throws OutputError if there can be no such folder.
void make_folder(const fs::path& folder) {
    std::error_code failure;
    fs::create_directories(folder, failure);
    if (failure) throw OutputError(folder, failure.message());
}

}  // namespace

int bench(const BenchOptions& o) {
    const Arena& arena = arena_of(o.arena);
    refuse_unknown_entries(arena, o);
    if (o.submission) refuse_without_submission(arena);
    const std::vector<Peer> peers = peers_of(o);
    const std::vector<Trial> trials = find_trials(arena, o);
    refuse_same_folder(o.data, o.output);
    make_folder(o.output);
    const fs::path table = o.output / "table.json";
    const auto earlier = io::present(table) ? measured_in(arena, io::read_file(table))
                                            : std::vector<MeasuredFigure>{};
    std::vector<io::Recording> recordings;
    for (const Trial& trial : trials) {
        recordings.push_back(open(trial.data));
        refuse_damaged(trial, recordings.back());
        if (!o.quiet) tell_notes(recordings.back());
    }
    int worst = kDone;
    std::vector<MeasuredFigure> figures;
    for (std::size_t t = 0; t < trials.size() && worst != kInterrupted; ++t) {
        if (!o.no_run) {
            worst = std::max(worst, measure_ours(arena, trials[t], recordings[t], o, figures));
        }
        measure_peers(arena, trials[t], recordings[t], peers, o, figures);
        if (interrupted()) worst = kInterrupted;
        write_tables(arena, figures, earlier, o.output);
    }
    if (worst == kInterrupted) say(stderr, "interrupted; the same command goes on\n");
    if (worst == kRejected) {
        say(stderr, "note: a run left out scans or gave warnings; they are in its run.log\n");
    }
    if (o.quiet || worst == kInterrupted) return worst;
    say("\n{}\nwritten  {}\n", io::read_file(o.output / "table.md"),
        (o.output / "table.md").string());
    return worst;
}

void tell_arena(const std::string& name) {
    const Arena& arena = arena_of(name);
    say("{}\n\nentries   {}\nlayout    {}\ndownload  {}\nthen      dynamicfilter bench {} "
        "FOLDER\n{}",
        arena.title, fmt::join(arena.entries, ", "), arena.layout, arena.download, arena.name,
        published_markdown(arena));
}

void write_twins(const BenchOptions& o) {
    const Arena& arena = arena_of(o.arena);
    if (io::present(o.data) && !fs::is_empty(o.data)) {
        throw ConfigError(o.data.string() +
                          " is not empty; give a new folder for the simulated data");
    }
    refuse_unknown_entries(arena, o);
    for (const std::string& entry : o.only.empty() ? arena.entries : o.only) {
        if (interrupted()) return;
        arena.write_twin(o.data, entry);
        if (!o.quiet) say("written  {} ({})\n", o.data.string(), entry);
    }
}

}  // namespace dynamic_filter::app
