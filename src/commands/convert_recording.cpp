// SPDX-License-Identifier: MIT
#include "commands/convert_recording.hpp"

#include <fmt/format.h>

#include <numeric>

#include "base/exit_code.hpp"
#include "base/progress.hpp"
#include "base/say.hpp"
#include "check/motion.hpp"
#include "dynamic_filter/bag.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/writers.hpp"
#include "export/outputs.hpp"
#include "export/part.hpp"
#include "formats/label_files.hpp"
#include "recording/recording_parts.hpp"
#include "recording/scans.hpp"
#include "run/drives_of_result.hpp"
#include "run/open_for_result.hpp"
#include "settings/config_file.hpp"

namespace fs = std::filesystem;

namespace dynamic_filter::app {

namespace {

/// Reads the labels of a run if --labels is given, else the recording's own ground truth.
Labels labels_of(const ConvertOptions& o, const io::Recording& recording, std::size_t i,
                 const io::FullScan& scan) {
    if (!o.labels) {
        const bool has_own = !recording.info().has_truth() || !scan.truth.empty();
        return has_own ? scan.truth : Labels(scan.points.size(), Label::unknown);
    }
    return labels_of_scan(*o.labels, recording, i, scan.points.size());
}

/// The settings of the run that left the labels; the default ones for other labels.
Config settings_of(const ConvertOptions& o) {
    if (!o.labels) return {};
    const auto file = settings_file_of(io::label_folder(*o.labels) / "..");
    if (!file) return {};
    try {
        return load_config({.file = *file});
    } catch (const ConfigError& error) {  // of another version
        tell_note(fmt::format("{}; so unknown points are written as with map.keep_unknown = true",
                              error.what()));
    }
    return {};
}

/// What is wanted of a recording.
Wanted wanted_of(const ConvertOptions& o) {
    Wanted part{box_of(o.box), o.max_range, o.sensor, {}, o.keep_unknown};
    if (!o.only.empty()) part.only = o.only == "static" ? Kept::in_map : Kept::removed;
    return part;
}

/// Gives the sink what is wanted of the scan; false if that is nothing.
bool append_part(Sink& sink, const Wanted& part, const io::FullScan& scan, const Labels& labels,
                 const std::string& stem) {
    if (part.only) require_labels(labels, "--only");
    if (part.takes_all()) {
        sink.append(scan, labels, stem);
        return true;
    }
    const std::vector<std::uint32_t> wanted = wanted_points(part, scan, labels);
    if (!wanted.empty()) sink.append(part_of(scan, wanted), part_of(labels, wanted), stem);
    return !wanted.empty();
}

/// Opens the recording as it is written: in the frame that the files have, unless `from_sensor`.
/// `o.sensor` becomes the place of the sensor in that frame.
io::Recording opened(ConvertOptions& o, bool from_sensor) {
    const RecordingOfResult found =
        o.labels ? open_for_result(o.data, *o.labels) : RecordingOfResult{open(o.data)};
    io::Recording recording = found.recording;
    tell_note(found.note);
    ensure_poses(recording, preset("default"), {.deskew = o.data.deskew, .quiet = o.quiet});
    if (!from_sensor) {
        o.sensor = recording.info().sensor_at.value_or(Eigen::Vector3d::Zero());
        recording = io::with_sensor_at(recording, Eigen::Vector3d::Zero());
    }
    for (const std::string& note : recording.info().notes) tell_note(note);
    for (const std::string& line : recording.info().losses) say(stderr, "lost     {}\n", line);
    return recording;
}

/// What became of scans.
struct Tally {
    std::size_t scans = 0, written = 0;
    std::vector<std::string> rejected, notes;
    bool has_losses = false;
};

/// Gives the sink all scans; stops when the user interrupts. `left_out_is_known`: scans without
/// labels are those that the run left out.
void append_all(Sink& sink, const ConvertOptions& o, const io::Recording& recording,
                bool left_out_is_known, Tally& tally) {
    const Wanted part = wanted_of(o);
    std::vector<std::size_t> scans(recording.size());
    std::iota(scans.begin(), scans.end(), 0U);
    tally.scans += scans.size();
    tally.has_losses |= !recording.info().losses.empty();
    Progress progress("convert", scans.size(), o.quiet);
    for_each_scan(recording, scans, {}, [&](std::size_t i, MaybeScan& maybe) {
        progress.advance();
        if (interrupted()) return false;
        if (!maybe.scan) {
            tally.rejected.push_back(maybe.error);
            return true;
        }
        if (left_out_is_known && !has_labels(*o.labels, recording, i)) {
            tally.rejected.push_back(io::stem(recording, i) + ": the run left it out");
            return true;
        }
        if (!o.labels && !maybe.scan->truth_fault.empty()) {
            tally.notes.push_back(maybe.scan->truth_fault + "; its points are unknown");
        }
        tally.written +=
            append_part(sink, part, *maybe.scan, labels_of(o, recording, i, *maybe.scan),
                        io::stem(recording, i));
        return true;
    });
}

/// A folder of KITTI has the scans of one sensor.
void refuse_mixture(const ConvertOptions& o, const Output* kind, const io::Recording& recording) {
    const bool is_kitti = (kind == nullptr && o.output.extension().empty()) || o.to == "kitti";
    if (!is_kitti || recording.info().layout != "rig") return;
    throw ConfigError(
        o.output.string() +
        ": a folder of KITTI has the scans of one sensor, but a rig has several; a bag "
        "(.mcap, .bag, .db3) keeps them apart, --to benchmark has a pose in each scan");
}

/// Puts the output in place unless the user interrupted. Returns the exit code.
int commit(Sink& sink, const ConvertOptions& o, const Tally& tally) {
    for (const std::string& line : tally.rejected) say(stderr, "rejected {}\n", line);
    for (const std::string& note : tally.notes) tell_note(note);
    if (interrupted()) return kInterrupted;
    if (tally.rejected.size() == tally.scans) {
        throw InputError(o.data.data, "", "no scan is usable");
    }
    if (tally.written == 0) {
        throw ConfigError(
            "no scan has a point that --box, --max-range and --only take; nothing is written");
    }
    const std::size_t empty = tally.scans - tally.rejected.size() - tally.written;
    if (empty > 0) tell_note(fmt::format("{} scans have no point there, and are left out", empty));
    tell_note(sink.commit());
    if (!o.quiet) say("written  {} ({} scans)\n", o.output.string(), tally.written);
    return tally.rejected.empty() && !tally.has_losses ? kDone : kRejected;
}

}  // namespace

void tell_note(const std::string& note) {
    if (!note.empty()) say(stderr, "note: {}\n", note);
}

int convert_recording(const ConvertOptions& o) {
    const Output* const kind = chosen_output(o);
    if (kind != nullptr && kind->of_recording == nullptr) {
        throw ConfigError(kind->shown() + " is for a map: give a cloud file as IN");
    }
    ConvertOptions of_sink = o;
    const io::Recording recording = opened(of_sink, kind != nullptr && kind->from_sensor);
    refuse_mixture(o, kind, recording);
    for (const auto& folder : io::folders_of(recording)) refuse_same_folder(folder, o.output);
    catch_interrupts();
    if (io::BagWriter::recognises(o.output) || !o.only.empty()) {  // only these ask for it
        of_sink.keep_unknown = settings_of(o).map.keep_unknown;
    }
    const std::unique_ptr<Sink> sink = make_sink(of_sink);
    Tally tally;
    append_all(*sink, of_sink, recording, false, tally);
    return commit(*sink, o, tally);
}

bool is_of_drives(const ConvertOptions& o) {
    const Output* const kind = chosen_output(o);
    return kind != nullptr ? kind->is_of_drives : io::can_write_cloud(o.output);
}

int convert_drives(const ConvertOptions& o) {
    if (o.labels) {
        throw ConfigError("--labels is for one recording; the drives of a map have their own");
    }
    if (o.data.poses) {
        throw ConfigError("--poses is for one recording; the drives of a map have their own");
    }
    if (is_of_update(o.data.data)) {
        throw ConfigError(o.data.data.string() +
                          " is the output of an update, which labels the new drives alone; --to "
                          "las, 3dtiles and autoware write the voxels of its map, and a `run` of "
                          "all recordings labels all points");
    }
    const std::vector<DriveOfResult> drives = drives_of_result(o.data.data);
    catch_interrupts();
    const std::unique_ptr<Sink> sink = make_sink(o);
    Tally tally;
    for (const DriveOfResult& found : drives) {
        ConvertOptions drive = o;
        drive.data.data = found.recording;
        drive.labels = found.folder;
        const io::Recording recording = opened(drive, true);
        if (!o.only.empty()) drive.keep_unknown = settings_of(drive).map.keep_unknown;
        append_all(*sink, drive, recording, true, tally);
        if (interrupted()) break;
    }
    return commit(*sink, o, tally);
}

}  // namespace dynamic_filter::app
