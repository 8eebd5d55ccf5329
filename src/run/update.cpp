// SPDX-License-Identifier: MIT
#include "run/update.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "base/say.hpp"
#include "check/motion.hpp"
#include "dynamic_filter/check.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/file.hpp"
#include "dynamic_filter/parallel.hpp"
#include "recording/folders.hpp"
#include "run/data_json.hpp"
#include "run/evidence_file.hpp"
#include "run/part_file.hpp"
#include "run/run_state.hpp"
#include "run/sources_of_result.hpp"

namespace fs = std::filesystem;

namespace dynamic_filter::app {

namespace {

/// How the earlier run read its recordings.
struct Earlier {
    fs::path folder;
    std::vector<DriveSource> sources;
    DataOptions how;
    std::optional<std::size_t> tile_voxels;  ///< empty: there were no tiles
};

void refuse_unfit(const RunOptions& o) {
    if (o.part.empty() && !o.mpi && !o.plan) return;
    throw ConfigError("--update does not go with --part, --plan or --mpi");
}

/// Without what differs from drive to drive.
std::string reading_text_of(DataOptions how) {
    how.data.clear();
    how.poses.reset();
    return json_of(how).dump();
}

[[noreturn]] void refuse_changed(const fs::path& folder) {
    throw ConfigError("the recordings of the map in " + folder.string() +
                      ", their poses, its settings or the way to read them are not those of its "
                      "run any more; make the map again by a run of all recordings");
}

/// Throws InputError if a file of a map of tiles is not there.
void refuse_incomplete_map(const fs::path& folder) {
    if (!is_tiled_map(folder)) {
        const bool had_tiles = fs::exists(folder / kRunState) && tile_voxels_of_run(folder);
        if (had_tiles) read_map_index(folder / kMapFolder);  // throws
        return;
    }
    const fs::path map = map_folder_of(folder);
    for (const MapTile& tile : read_map_index(map).tiles) {
        if (!fs::exists(map / tile.file)) throw InputError(map / tile.file, "", "is missing");
    }
}

/// The mark of a run of the same version says what it was begun with; that of another version is
/// written in another way.
void refuse_changed(const Job& job, const fs::path& folder) {
    if (!tile_voxels_of_run(folder)) return;  // a run in memory has recording.json
    const std::string was = io::read_file(folder / kRunState);
    const std::string is = job.begun.mark(job.first_new());
    const auto version = [](const std::string& mark) { return mark.substr(0, mark.find('\n')); };
    if (version(was) == version(is) && !was.starts_with(is)) refuse_changed(folder);
}

Earlier read_earlier(const fs::path& given) {
    if (!fs::exists(given)) throw InputError(given, "", "does not exist");
    Earlier earlier{.folder = output_of(given), .sources = {}, .how = {}, .tile_voxels = {}};
    refuse_incomplete_map(earlier.folder);
    const std::vector<DriveOfResult> drives = drives_of_result(earlier.folder);
    earlier.tile_voxels = tile_voxels_of_run(earlier.folder);
    if (const fs::path kept = earlier.folder / kEvidenceFolder; fs::exists(kept / kPartFile)) {
        const Part part = read_part(kept);
        earlier.sources = part.sources;
        for (std::size_t d = 0; d < earlier.sources.size(); ++d) {
            auto& poses = earlier.sources[d].poses;
            if (poses) poses = kept / evidence_poses_file(d);
        }
        earlier.how = part.run.data;
        return earlier;
    }
    if (updated_drives(earlier.folder) > 0) {
        throw InputError(earlier.folder / kEvidenceFolder, "",
                         "is not there, and without it nothing tells how the drives of the map "
                         "were read; update a map that has it");
    }
    for (const DriveOfResult& drive : drives) {
        const Placed placed = placed_of_drive(drive);
        DataOptions how = placed.how;
        how.data = drive.recording;
        const io::Recording recording = open(how);
        refuse_own_world(drive, placed, recording);
        if (fingerprint_of(recording) != placed.fingerprint) refuse_changed(earlier.folder);
        earlier.sources.push_back(source_of(drive, placed));
        earlier.how = placed.how;
    }
    return earlier;
}

/// All recordings are read in one way.
void refuse_other_reading(const DataOptions& asked, const Earlier& earlier) {
    const std::string text = reading_text_of(asked);
    if (text == reading_text_of({}) || text == reading_text_of(earlier.how)) return;
    throw ConfigError("the recordings are read as those of " + earlier.folder.string() +
                      " were, whose options are others than these; leave the options out, or "
                      "convert the new recording first");
}

void refuse_other_settings(const ConfigOptions& asked, const Earlier& earlier,
                           const fs::path& own) {
    const bool asks = asked.file || !asked.assignments.empty() || asked.preset != "default";
    if (!asks || to_toml(load_config(asked)) == io::read_file(own)) return;
    throw ConfigError("the settings of an update are those of " + earlier.folder.string() +
                      " (config.toml there), and these are others; leave them out");
}

void refuse_other_tiles(std::size_t asked, const Earlier& earlier) {
    const std::size_t own = earlier.tile_voxels.value_or(asked);
    if (asked == own || asked == RunOptions{}.tile_voxels) return;
    throw ConfigError(
        fmt::format("the tiles of an update are those of {}, of {} voxels; leave "
                    "--tile-voxels out",
                    earlier.folder.string(), own));
}

void refuse_known(const std::vector<DriveSource>& added, const Earlier& earlier) {
    for (const DriveSource& source : added) {
        for (const DriveSource& known : earlier.sources) {
            if (fs::weakly_canonical(source.recording) != fs::weakly_canonical(known.recording)) {
                continue;
            }
            throw ConfigError(source.recording.string() + " is a drive of the map in " +
                              earlier.folder.string() + " already");
        }
    }
}

/// Why new drives do not fit to those of the map, a sentence each.
std::vector<std::string> misfits_of(const std::vector<Drive>& drives, std::size_t known) {
    std::vector<const io::Recording*> recordings;
    for (const Drive& drive : drives) recordings.push_back(&drive.recording);
    const auto offsets = io::measure_drive_offsets(recordings, known);
    std::vector<std::string> misfits;
    for (const io::Finding& finding : io::findings_of(recordings, offsets)) {
        misfits.push_back(finding.what + "; " + finding.advice);
    }
    for (std::size_t d = known; d < drives.size() && misfits.empty(); ++d) {
        const auto meets = [&](const io::DriveOffset& offset) {
            return offset.b == d && offset.match != io::FrameMatch::apart;
        };
        if (std::any_of(offsets.begin(), offsets.end(), meets)) continue;
        misfits.push_back(drives[d].name + " passes no place of the map");
    }
    return misfits;
}

/// A drive in another world would remove what stands in this one. Motion during the scans, which
/// the plan will undo, may hide that drives fit.
void look_at_fit(Update& update, const fs::path& map) {
    const std::size_t known = update.job.first_new();
    std::vector<std::string> misfits = misfits_of(update.job.drives, known);
    if (misfits.empty()) return;
    std::vector<Drive> undone = update.job.drives;
    for (Drive& drive : undone) {
        Config config = update.job.config;
        choose_motion(drive.recording, config,
                      {.refine = "off", .deskew = update.options.data.deskew, .finds_body = false});
    }
    misfits = misfits_of(undone, known);
    for (const std::string& misfit : misfits) {
        update.job.remarks.push_back({RemarkKind::warning, misfit});
    }
    if (misfits.empty() || update.options.trusts_poses) return;
    throw ConfigError(fmt::format(
        "the new recording does not fit to the map in {}, which stays as it is (`dynamicfilter "
        "odometry --onto {}` finds poses that do, and --trust-poses goes on all the same):\n  {}",
        map.string(), map.string(), fmt::join(misfits, "\n  ")));
}

}  // namespace

Update open_update(const RunOptions& asked) {
    refuse_unfit(asked);
    const Earlier earlier = read_earlier(*asked.update);
    const fs::path settings = earlier.folder / "config.toml";
    refuse_other_settings(asked.config, earlier, settings);
    refuse_other_reading(asked.data, earlier);
    refuse_other_tiles(asked.tile_voxels, earlier);
    std::vector<DriveSource> sources = earlier.sources,
                             added = with_pose_files(expand(asked.recordings), asked.data);
    refuse_known(added, earlier);
    sources.insert(sources.end(), added.begin(), added.end());
    RunOptions options = asked;
    options.config = {.preset = "default", .file = settings};
    options.data = earlier.how;
    options.data.poses.reset();
    options.tile_voxels = earlier.tile_voxels.value_or(asked.tile_voxels);
    options.keeps_evidence = true;
    Update update{.job = open_tiled_job(options, sources), .options = options};
    update.job.earlier = EarlierRun{.folder = earlier.folder, .drives = earlier.sources.size()};
    refuse_changed(update.job, earlier.folder);
    with_threads(asked.threads, [&] { look_at_fit(update, earlier.folder); });
    return update;
}

std::vector<Drive> drives_of_map(const fs::path& result) {
    const Earlier earlier = read_earlier(result);
    return open_drives(earlier.sources, earlier.how);
}

Plan earlier_plan(const Job& job) {
    if (!job.earlier) return {};
    const fs::path file = job.earlier->folder / kEvidenceFolder / kPlanFile;
    try {
        if (fs::exists(file)) {
            return read_plan(file, job.begun.mark(job.first_new()), job.config);
        }
    } catch (const Error&) {  // other recordings, or damaged
    }
    say(stderr,
        "note: {} has no evidence of its drives as they are now (see run --keep-evidence); "
        "they are filtered once more\n",
        job.earlier->folder.string());
    return {};
}

}  // namespace dynamic_filter::app
