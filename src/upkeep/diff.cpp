// SPDX-License-Identifier: MIT
#include "upkeep/diff.hpp"

#include <fmt/format.h>

#include <numeric>

#include "base/exit_code.hpp"
#include "base/output_folder.hpp"
#include "base/progress.hpp"
#include "base/say.hpp"
#include "draw/canvas.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/file.hpp"
#include "dynamic_filter/parallel.hpp"
#include "dynamic_filter/writers.hpp"
#include "geometry/pose.hpp"
#include "page/sampling.hpp"
#include "recording/folders.hpp"
#include "recording/scans.hpp"
#include "recording/world_records.hpp"
#include "run/data_json.hpp"
#include "run/drives_of_result.hpp"
#include "run/open_for_result.hpp"
#include "run/placed.hpp"
#include "run/sources_of_result.hpp"
#include "upkeep/changes_page.hpp"

namespace fs = std::filesystem;

namespace dynamic_filter::app {

namespace {

const FolderFiles& diff_files() {
    static const FolderFiles files{.files = {"came.pcd", "went.pcd", "unseen.pcd", "changes.csv",
                                             "changes.json", "index.html", "old.png", "new.png"}};
    return files;
}

/// The drives of one date.
struct Date {
    fs::path run;
    std::vector<DriveOfResult> drives;
    std::vector<Placed> placed;  ///< parallel
};

Date date_of(const fs::path& run) {
    Date date{run, drives_of_result(run), {}};
    std::optional<io::Cloud> layout;  // of the clouds of changes
    for (const DriveOfResult& drive : date.drives) {
        const Placed placed = placed_of_drive(drive);
        DataOptions how = placed.how;
        how.data = drive.recording;
        const io::Recording recording = open(how);
        refuse_own_world(drive, placed, recording);
        for_each_scan(recording, {0}, {}, [&](std::size_t, MaybeScan& maybe) {
            if (!maybe.scan) return true;
            if (!layout) layout = layout_of(*maybe.scan, false);
            refuse_other_fields(*maybe.scan, *layout);
            return true;
        });
        date.placed.push_back(placed);
    }
    return date;
}

/// How all drives are to be read. Throws ConfigError if their runs read them in different ways.
DataOptions reading_of(const std::vector<const Date*>& dates) {
    const auto text_of_reading = [](DataOptions how) {
        how.poses.reset();  // each drive has its own
        return json_of(how).dump();
    };
    const DataOptions how = dates.front()->placed.front().how;
    for (const Date* date : dates) {
        for (std::size_t i = 0; i < date->drives.size(); ++i) {
            if (text_of_reading(date->placed[i].how) == text_of_reading(how)) continue;
            throw ConfigError(fmt::format(
                "{} was read with other options than {}, so the two cannot be read together; run "
                "both with the same ones",
                date->drives[i].folder.string(), dates.front()->drives.front().folder.string()));
        }
    }
    DataOptions common = how;
    common.poses.reset();
    return common;
}

/// The settings of all runs. Throws ConfigError if they differ, because labels would, too.
std::optional<fs::path> settings_of(const std::vector<const Date*>& dates) {
    const auto first = settings_file_of(dates.front()->drives.front().folder);
    for (const Date* date : dates) {
        const auto file = settings_file_of(date->drives.front().folder);
        if (first && file && io::read_file(*first) == io::read_file(*file)) continue;
        throw ConfigError(dates.front()->run.string() + " and " + date->run.string() +
                          " were made with other settings, which tell of changes that are none; "
                          "`run` both with the same config.toml");
    }
    return first;
}

/// A list for `run`: a recording a line, with its pose file where it has one.
std::string list_of(const std::vector<const Date*>& dates) {
    std::string text;
    for (const Date* date : dates) {
        for (std::size_t i = 0; i < date->drives.size(); ++i) {
            const DriveSource source = source_of(date->drives[i], date->placed[i]);
            text += source.recording.string();
            if (source.poses) text += "\t" + source.poses->string();
            text += "\n";
        }
    }
    return text;
}

void refuse_same_drive(const Date& one, const Date& other) {
    for (const DriveOfResult& a : one.drives) {
        for (const DriveOfResult& b : other.drives) {
            if (fs::weakly_canonical(a.recording) != fs::weakly_canonical(b.recording)) continue;
            throw ConfigError(a.recording.string() +
                              " is a drive of both runs; a date cannot be compared with itself");
        }
    }
}

constexpr double kDrawn = 1.5e6;  // points of a picture

/// What rests at a date, and what of it is away at the other.
struct DatePoints {
    ChangedPoints changed;
    Points drawn;  ///< a sample of what rests at both, from the common origin
};

/// Adds a share of the points that rest at both dates, from the common origin.
void add_sample(const io::FullScan& scan, std::size_t index, const Labels& together, double share,
                const Eigen::Vector3d& origin, Points& drawn) {
    Pose T_picture_sensor = scan.T_world_sensor;
    T_picture_sensor.pretranslate(-origin);
    for (std::size_t p = 0; p < scan.points.size(); ++p) {
        if (together[p] != Label::static_ || !is_sampled(index, p, share)) continue;
        if (!is_measured(scan.points[p])) continue;
        drawn.push_back((T_picture_sensor * scan.points[p].cast<double>()).cast<float>());
    }
}

/// False if the user interrupted.
bool collect(const Date& date, const std::vector<DriveOfResult>& together,
             std::optional<Eigen::Vector3d>& origin, bool quiet, DatePoints& points) {
    for (std::size_t d = 0; d < date.drives.size(); ++d) {
        const fs::path &of_date = date.drives[d].folder, &of_both = together[d].folder;
        DataOptions how = date.placed[d].how;
        how.data = date.drives[d].recording;
        const io::Recording recording = open_for_result(how, of_both).recording;
        std::vector<std::size_t> scans(recording.size());
        std::iota(scans.begin(), scans.end(), std::size_t{0});
        const double drawn_of_scan =
            kDrawn / static_cast<double>(scans.size() * date.drives.size());
        Progress progress("compare", scans.size(), quiet);
        for_each_scan(recording, scans, {}, [&](std::size_t i, MaybeScan& maybe) {
            progress.advance();
            if (interrupted()) return false;
            // What a run leaves out it has named.
            if (!maybe.scan || !has_labels(of_both, recording, i) ||
                !has_labels(of_date, recording, i)) {
                return true;
            }
            const io::FullScan& scan = *maybe.scan;
            const std::size_t size = scan.points.size();
            const Labels both = labels_of_scan(of_both, recording, i, size);
            points.changed.add(scan, labels_of_scan(of_date, recording, i, size), both);
            if (!origin) origin = nearby_origin(scan.T_world_sensor, 1.0);
            add_sample(scan, i, both, drawn_of_scan / static_cast<double>(size), *origin,
                       points.drawn);
            return true;
        });
        if (interrupted()) return false;
    }
    return true;
}

void write_pictures(const fs::path& folder, const DatePoints& of_old, const DatePoints& of_new,
                    const io::Cloud& went, const io::Cloud& came, const Eigen::Vector3d& origin) {
    Points all = of_old.drawn;
    all.insert(all.end(), of_new.drawn.begin(), of_new.drawn.end());
    constexpr float kOutermost = 0.005F;
    const Eigen::AlignedBox3f box = box_of(all, kOutermost);
    io::write_png(folder / "old.png",
                  date_from_above(of_old.drawn, positions_from(went, origin), box, kRemovedColor));
    io::write_png(folder / "new.png",
                  date_from_above(of_new.drawn, positions_from(came, origin), box, kCameColor));
}

/// Where the result of both dates together is: beside the output, so that a killed comparison can
/// go on.
fs::path folder_of_both(const fs::path& output) { return io::whole_path(output) += ".together"; }

RunResult filter_together(const std::vector<const Date*>& dates, const DiffOptions& o,
                          const fs::path& together, const fs::path& list) {
    RunOptions options;
    options.recordings = {list};
    options.data = reading_of(dates);
    options.output = together;
    options.config.file = settings_of(dates);
    options.threads = o.threads;
    options.memory = o.memory;
    options.resume = fs::exists(together);
    options.maps = options.report = false;
    options.quiet = true;
    options.catches = false;
    io::write_file(list, list_of(dates));
    if (!o.quiet) say(stderr, "filter   both dates together\n");
    RunResult result = run(options);
    fs::remove(list);
    return result;
}

/// Empty if the user interrupted.
std::optional<ChangesOfMap> write_changes(const Date& old_date, const Date& new_date,
                                          const fs::path& together, bool quiet,
                                          const fs::path& output) {
    const std::vector<DriveOfResult> drives = drives_of_result(together);
    const auto first_new = drives.begin() + static_cast<std::ptrdiff_t>(old_date.drives.size());
    DatePoints of_old, of_new;
    std::optional<Eigen::Vector3d> origin;
    if (!collect(old_date, {drives.begin(), first_new}, origin, quiet, of_old) ||
        !collect(new_date, {first_new, drives.end()}, origin, quiet, of_new)) {
        return std::nullopt;
    }
    ChangesOfMap changes{of_old.changed.changes(of_new.changed),
                         of_new.changed.changes(of_old.changed),
                         seen_voxels(together / kMapFolder, old_date.drives.size())};
    if (changes.voxels.at_both == 0) {
        throw ConfigError(old_date.run.string() + " and " + new_date.run.string() +
                          " have no place in common; are their poses of the same world?");
    }
    const io::Cloud went = of_old.changed.cloud(changes.went);
    const io::Cloud came = of_new.changed.cloud(changes.came);
    io::write_cloud(output / "went.pcd", went);
    io::write_cloud(output / "came.pcd", came);
    io::write_cloud(output / "unseen.pcd", changes.voxels.unseen);
    io::write_file(output / "changes.csv", changes_csv(changes));
    io::write_file(output / "changes.json", changes_json(changes));
    io::write_file(output / "index.html", changes_page(changes));
    write_pictures(output, of_old, of_new, went, came, *origin);
    return changes;
}

}  // namespace

int diff(const DiffOptions& o) {
    const Date old_date = date_of(o.old_run), new_date = date_of(o.new_run);
    refuse_same_drive(old_date, new_date);
    OutputFolder output(o.output, diff_files(), replaced_if(o.overwrite));
    const fs::path together = folder_of_both(o.output);
    // An earlier one of ours is begun anew.
    if (o.overwrite && fs::exists(together / kRunState)) fs::remove_all(together);
    const bool was_there = fs::exists(together);
    const auto stop = [] {
        say(stderr, "interrupted; the same command goes on with the comparison\n");
        return static_cast<int>(kInterrupted);
    };
    try {
        const RunResult result =
            filter_together({&old_date, &new_date}, o, together, output.path() / "drives.txt");
        if (result.exit_code == kInterrupted) return stop();
        std::optional<ChangesOfMap> changes;
        with_threads(o.threads, [&] {
            changes = write_changes(old_date, new_date, together, o.quiet, output.path());
        });
        if (!changes) return stop();
        output.commit();
        fs::remove_all(together);
        if (!o.quiet) {
            say("{} went, {} came; seen at both dates: {} voxels, at the old one only: {}, at the "
                "new one only: {}\nwritten  {}\n",
                changes->went.size(), changes->came.size(), changes->voxels.at_both,
                changes->voxels.old_only, changes->voxels.new_only, output.name().string());
        }
        return result.exit_code;
    } catch (const OutputError&) {  // a full disk: the same call goes on
        throw;
    } catch (const Error&) {  // it would end so again
        if (!was_there) fs::remove_all(together);
        throw;
    }
}

}  // namespace dynamic_filter::app
