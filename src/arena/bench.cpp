// SPDX-License-Identifier: MIT
#include "arena/bench.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "arena/arena.hpp"
#include "arena/submission.hpp"
#include "arena/table.hpp"
#include "base/exit_code.hpp"
#include "base/output_folder.hpp"
#include "base/progress.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/file.hpp"
#include "formats/label_files.hpp"
#include "recording/folders.hpp"
#include "recording/scans.hpp"
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
        fmt::print(stderr, "note: {} not there: {}. Expected is {}. Download {}\n",
                   missing.size() == 1 ? "this entry is" : "these entries are",
                   fmt::join(missing, ", "), arena.layout, arena.download);
    }
    return trials;
}

/// Throws InputError if a scan is damaged: without it, the figures would not be those of the arena.
void refuse_damaged(const io::Recording& recording) {
    for (std::size_t i = 0; i < recording.size(); ++i) recording.check(i);
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

/// Filters the recording into the folder, unless that is done. False if it was interrupted.
bool filter(const Trial& trial, const std::string& preset, const fs::path& folder,
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
    return app::run(run).exit_code != kInterrupted;
}

MeasuredFigure measure(const Arena& arena, const Trial& trial, const io::Recording& recording,
                       const std::string& method, const Estimate& estimate) {
    MeasuredFigure figure{trial.entry, method, arena.score(trial, recording, estimate),
                          trial.notes};
    fmt::print("{}", figure_text(arena, figure));
    std::fflush(stdout);
    return figure;
}

void write_tables(const Arena& arena, std::vector<MeasuredFigure> figures, const fs::path& folder) {
    add_means_of_groups(figures);
    io::write_file(folder / "table.md", arena_markdown(arena, figures));
    io::write_file(folder / "table.json", arena_json(arena, figures));
}

/// "station-sequence_1" for "station/sequence_1": a folder for each entry.
std::string folder_name(std::string entry) {
    std::replace(entry.begin(), entry.end(), '/', '-');
    return entry;
}

/// Runs and scores each preset. False if it was interrupted.
bool measure_ours(const Arena& arena, const Trial& trial, const io::Recording& recording,
                  const BenchOptions& o, std::vector<MeasuredFigure>& figures) {
    for (const std::string& preset : o.presets) {
        const fs::path folder = o.output / folder_name(trial.entry) / preset;
        if (!filter(trial, preset, folder, o)) return false;
        const Estimate estimate{.labels = folder / "labels", .map = {}};
        figures.push_back(
            measure(arena, trial, recording, "DynamicFilter, preset " + preset, estimate));
        if (!o.poses.empty()) {
            figures.back().notes.push_back(o.poses == kNoPoses ? "run with own odometry"
                                                               : "run with poses of " + o.poses);
        }
        if (!o.submission || preset != o.presets.front()) continue;
        write_submission(arena, trial, recording, *estimate.labels, o.output / "submission");
    }
    return true;
}

void measure_peers(const Arena& arena, const Trial& trial, const io::Recording& recording,
                   const std::vector<Peer>& peers, std::vector<MeasuredFigure>& figures) {
    for (const Peer& peer : peers) {
        if (const auto estimate = estimate_of(peer, trial.entry)) {
            figures.push_back(measure(arena, trial, recording, peer.name, *estimate));
            continue;
        }
        fmt::print(stderr, "note: {} has no result of {}: neither {}/ nor {}.pcd in {}\n",
                   peer.name, trial.entry, trial.entry, trial.entry, peer.folder.string());
    }
}

}  // namespace

int bench(const BenchOptions& o) {
    const Arena& arena = arena_of(o.arena);
    refuse_unknown_entries(arena, o);
    if (o.submission) refuse_without_submission(arena);
    const std::vector<Peer> peers = peers_of(o);
    const std::vector<Trial> trials = find_trials(arena, o);
    refuse_same_folder(o.data, o.output);
    fs::create_directories(o.output);
    std::vector<MeasuredFigure> figures;
    for (const Trial& trial : trials) {
        const io::Recording recording = open(trial.data);
        refuse_damaged(recording);
        if (!o.no_run && !measure_ours(arena, trial, recording, o, figures)) {
            fmt::print(stderr, "interrupted; the same command goes on\n");
            return kInterrupted;
        }
        measure_peers(arena, trial, recording, peers, figures);
        write_tables(arena, figures, o.output);
    }
    if (o.quiet) return kDone;
    fmt::print("\n{}\nwritten  {}\n", io::read_file(o.output / "table.md"),
               (o.output / "table.md").string());
    return kDone;
}

void tell_arena(const std::string& name) {
    const Arena& arena = arena_of(name);
    fmt::print(
        "{}\n\nentries   {}\nlayout    {}\ndownload  {}\nthen      dynamicfilter bench {} "
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
        arena.write_twin(o.data, entry);
        if (!o.quiet) fmt::print("written  {} ({})\n", o.data.string(), entry);
    }
}

}  // namespace dynamic_filter::app
