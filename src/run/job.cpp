// SPDX-License-Identifier: MIT
#include "run/job.hpp"

#include <fmt/format.h>

#include <cmath>
#include <span>
#include <utility>

#include "base/crc.hpp"
#include "base/input.hpp"
#include "check/advice.hpp"
#include "check/motion.hpp"
#include "check/replaced_poses.hpp"
#include "dynamic_filter/check.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/parallel.hpp"
#include "recording/scans.hpp"
#include "run/data_json.hpp"
#include "run/placed.hpp"
#include "run/run_state.hpp"
#include "settings/config_file.hpp"

namespace dynamic_filter::app {

namespace {

void refuse_what_tiles_cannot(const RunOptions& o, const Config& config) {
    const auto refuse = [](const std::string& what, const std::string& instead) {
        throw ConfigError(what +
                          " does not go with several recordings, --part, --memory, --mpi, "
                          "--keep-evidence or --update" +
                          instead);
    };
    if (o.online) refuse("--online", "");
    if (o.view) refuse("--view", "");
    if (o.edits) refuse("--edits", "");
    if (o.refine == "on" || config.odometry.refine) {
        refuse("refining poses", "; refine those of each drive first, in a run of its own");
    }
    if (config.method != Method::scans) refuse("--preset paper", "; use the default preset");
}

void refuse_unnamed(const RunOptions& o) {
    if (o.output) return;
    if (!o.part.empty() || o.mpi) {
        throw ConfigError("--part and --mpi need a name for the result: -o DIR");
    }
    if (o.resume) {
        throw ConfigError("--resume needs the folder to go on with: -o DIR");
    }
}

/// The beginning of every mark.
std::string version_text() { return fmt::format("version {}\n", DYNAMIC_FILTER_VERSION); }

/// The poses to a micrometre, because their last bits depend on the machine.
std::uint32_t crc_of_poses(const io::Recording& recording) {
    std::vector<std::int64_t> numbers;
    for (const Pose& pose : recording.info().T_world_sensor) {
        for (const double value : pose.matrix().reshaped()) {
            numbers.push_back(std::isfinite(value) ? std::llround(value * 1e6) : INT64_MAX);
        }
    }
    return crc_of(std::as_bytes(std::span(numbers)));
}

std::string poses_text(const io::Recording& recording) {
    return fmt::format("poses {:08x}\n", crc_of_poses(recording));
}

/// How the recordings are read, for the mark: with other poses, or in other units, it is another
/// run. How the layout is called, and where poses and mask lie, does not matter.
std::string reading_text(const DataOptions& how) {
    std::string text;
    DataOptions options = how;
    options.poses.reset();
    if (options.mask && *options.mask != kNoMask) {
        text += fmt::format("mask {:08x}\n", crc_of(io::read_bytes(*options.mask)));
        options.mask.reset();
    }
    options.format.clear();
    options.topic.clear();
    options.pose_topic.clear();
    return text + "reading " + json_of(options).dump() + "\n";
}

}  // namespace

std::string Begun::mark(std::size_t drives) const {
    std::string mark = tiles;
    for (std::size_t d = 0; d < drives; ++d) mark += states[d];
    for (std::size_t d = 0; d < drives; ++d) mark += poses[d];
    return mark + reading;
}

bool is_tiled(const RunOptions& o) {
    const bool is_list = o.recordings.size() == 1 && o.recordings.front().extension() == ".txt";
    return o.recordings.size() > 1 || is_list || !o.part.empty() || o.mpi || !o.memory.empty() ||
           o.plan.has_value() || o.keeps_evidence || o.update;
}

Job open_tiled_job(const RunOptions& o, std::vector<DriveSource> sources) {
    Job job{.config = load_config(o.config),
            .sources = std::move(sources),
            .drives = {},
            .fingerprints = {},
            .tracked = {},
            .has_given_poses = false,
            .remarks = {},
            .is_tiled = true,
            .part = {},
            .plan = {},
            .mark = {}};
    if (!o.part.empty()) job.part = part_number_of(o.part);
    refuse_what_tiles_cannot(o, job.config);
    job.drives = open_drives(job.sources, o.data);
    job.keeps_evidence = o.keeps_evidence;
    job.begun = {.tiles = version_text() + fmt::format("{}{} voxels\n", kTilesLine, o.tile_voxels),
                 .states = {},
                 .poses = {},
                 .reading = reading_text(o.data) + to_toml(job.config)};
    for (const Drive& drive : job.drives) {
        job.begun.states.push_back(state_of(drive.recording));
        job.begun.poses.push_back(poses_text(drive.recording));
        job.fingerprints.push_back(fingerprint_of(drive.recording));
    }
    job.mark = job.begun.mark(job.drives.size());
    return job;
}

Job open_job(const RunOptions& o) {
    if (o.mpi && (o.overwrite || !o.part.empty())) {
        throw ConfigError("--mpi does not go with --overwrite or --part");
    }
    if (!o.part.empty() && o.keeps_evidence) {
        throw ConfigError("--keep-evidence does not go with --part");
    }
    refuse_unnamed(o);
    if (is_tiled(o)) return open_tiled_job(o, expand(o.recordings));
    Job job{.config = load_config(o.config),
            .sources = {{.recording = o.data.data}},
            .drives = {},
            .fingerprints = {},
            .tracked = {},
            .has_given_poses = false,
            .remarks = {},
            .is_tiled = false,
            .part = {},
            .plan = {},
            .mark = {}};
    job.drives.push_back({.name = o.data.data.filename().string(), .recording = open(o.data)});
    job.fingerprints.push_back(fingerprint_of(job.drives.front().recording));
    return job;
}

void choose_job_motion(Job& job, const RunOptions& o) {
    io::Recording& recording = job.drives.front().recording;
    with_threads(o.threads, [&] {
        const io::Recording opened = recording;
        ChosenMotion chosen = choose_motion(recording, job.config,
                                            {.refine = o.refine,
                                             .deskew = o.data.deskew,
                                             .online = o.online,
                                             .quiet = o.quiet,
                                             .finds_body = !o.data.mask});
        recording = io::with_notes(recording, chosen.notes);
        job.tracked = std::move(chosen.tracked);
        job.has_given_poses = opened.info().has_poses;
        job.remarks = remarks_on(recording);
        for (const auto& found : io::check_recording(recording, io::Depth::quick).findings) {
            job.remarks.push_back({RemarkKind::warning, warning_of(found, o.data)});
        }
        if (job.tracked.empty() || !job.has_given_poses) return;
        for (const io::Finding& found : io::mistakes_in_replaced(opened, recording)) {
            const auto kind = io::is_of_points(found) ? RemarkKind::warning : RemarkKind::mended;
            job.remarks.push_back({kind, warning_of(found, o.data)});
        }
    });
    job.mark = version_text() + state_of(recording) + poses_text(recording) + reading_text(o.data) +
               to_toml(job.config);
}

std::string mark_of_output(const Job& job, const RunOptions& o) {
    return job.mark + (o.refine == "auto" ? "" : "refine " + o.refine + "\n") +
           (o.maps ? "" : "no maps\n") + (o.report ? "" : "no report\n") +
           (o.keeps_evidence ? "evidence\n" : "") +
           (job.earlier ? fmt::format("{}{}\n", kUpdateLine, job.earlier->drives) : "") +
           (o.part.empty() ? "" : "part " + o.part + "\n");
}

std::filesystem::path folder_of(const Job& job, std::size_t drive,
                                const std::filesystem::path& output) {
    return job.drives.size() == 1 ? output : output / "drives" / job.drives[drive].name;
}

void tell_remarks(const Job& job, bool quiet) {
    tell(job.remarks, "", quiet);
    tell(job.plan.remarks, "", quiet);
    for (std::size_t d = job.first_new(); d < job.plan.drives.size(); ++d) {
        tell(job.plan.drives[d].remarks, job.drives[d].name + ": ", quiet);
    }
}

}  // namespace dynamic_filter::app
