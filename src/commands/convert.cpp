// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <numeric>

#include "base/exit_code.hpp"
#include "base/output_folder.hpp"
#include "base/progress.hpp"
#include "check/motion.hpp"
#include "commands/all.hpp"
#include "commands/shared_options.hpp"
#include "dynamic_filter/bag.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/writers.hpp"
#include "export/convert_map.hpp"
#include "export/convert_options.hpp"
#include "export/outputs.hpp"
#include "formats/label_files.hpp"
#include "formats/voxel_map/map_index.hpp"
#include "recording/scans.hpp"
#include "run/open_for_result.hpp"
#include "settings/config_file.hpp"

namespace fs = std::filesystem;

namespace dynamic_filter::app {

namespace {

/// Prints what a format could not hold, or what was wrong with its source.
void say(const std::string& note) {
    if (!note.empty()) fmt::print(stderr, "note: {}\n", note);
}

/// Reads the labels of a run if --labels is given, else the recording's own ground truth.
Labels labels_of(const ConvertOptions& o, const io::Recording& recording, std::size_t i,
                 const io::FullScan& scan) {
    if (!o.labels) {
        const bool has_own = !recording.info().has_truth() || !scan.truth.empty();
        return has_own ? scan.truth : Labels(scan.points.size(), Label::unknown);
    }
    const fs::path folder = io::label_folder(*o.labels);
    Labels labels = io::read_labels(io::label_file(folder, io::stem(recording, i)));
    if (labels.size() == scan.points.size()) return labels;
    throw ConfigError(
        fmt::format("{}: {} labels for the {} points of scan {}; are they of another "
                    "recording?",
                    folder.string(), labels.size(), scan.points.size(), io::stem(recording, i)));
}

/// The settings of the run that left the labels; the default ones for other labels.
Config settings_of(const ConvertOptions& o) {
    if (!o.labels) return {};
    const fs::path result = io::label_folder(*o.labels) / "..";
    for (const fs::path& folder : {result, result / ".."}) {  // of one drive, or of several
        const fs::path file = (folder / "config.toml").lexically_normal();
        if (!fs::exists(folder / kRunState) || !fs::exists(file)) continue;
        try {
            return load_config({.file = file});
        } catch (const ConfigError& error) {  // of another version
            say(fmt::format("{}; so unknown points are written as with map.keep_unknown = true",
                            error.what()));
        }
    }
    return {};
}

/// Refuses options that are for the map of several drives only.
void refuse_map_options(const ConvertOptions& o) {
    const Output* const kind = chosen_output(o);
    const bool is_for_maps =
        kind != nullptr && kind->of_recording == nullptr && kind->of_cloud == nullptr;
    if (!is_for_maps && o.origin.empty()) return;
    throw ConfigError(fmt::format(
        "{}: {} is for the map of several drives, which `dynamicfilter run A B ... -o OUT` makes; "
        "give OUT as IN",
        o.data.data.string(), o.origin.empty() ? "--to " + o.to : "--origin"));
}

int convert_recording(const ConvertOptions& o) {
    const Output* const kind = chosen_output(o);
    if (kind != nullptr && kind->of_recording == nullptr) {
        throw ConfigError("--to " + o.to + " is for a map: give a cloud file as IN");
    }
    const RecordingOfResult opened =
        o.labels ? open_for_result(o.data, *o.labels) : RecordingOfResult{open(o.data)};
    io::Recording recording = opened.recording;
    say(opened.note);
    ensure_poses(recording, preset("default"), {.deskew = o.data.deskew, .quiet = false});
    // What is written is of the frame that the files have, unless the output follows the beams.
    if (kind == nullptr || !kind->from_sensor) {
        recording = io::with_sensor_at(recording, Eigen::Vector3d::Zero());
    }
    for (const std::string& note : recording.info().notes) fmt::print(stderr, "note: {}\n", note);
    for (const std::string& line : recording.info().losses)
        fmt::print(stderr, "lost     {}\n", line);
    catch_interrupts();
    ConvertOptions of_sink = o;
    // Only bags ask for it.
    if (io::BagWriter::recognises(o.output)) {
        of_sink.keep_unknown = settings_of(o).map.keep_unknown;
    }
    const std::unique_ptr<Sink> sink = make_sink(of_sink);
    std::vector<std::size_t> scans(recording.size());
    std::iota(scans.begin(), scans.end(), 0U);
    std::vector<std::string> rejected, notes;
    {
        Progress progress("convert", scans.size());
        for_each_scan(recording, scans, {}, [&](std::size_t i, MaybeScan& maybe) {
            progress.advance();
            if (interrupted()) return false;
            if (!maybe.scan) {
                rejected.push_back(maybe.error);
                return true;
            }
            if (!o.labels && !maybe.scan->truth_fault.empty()) {
                notes.push_back(maybe.scan->truth_fault + "; its points are unknown");
            }
            sink->append(*maybe.scan, labels_of(o, recording, i, *maybe.scan));
            return true;
        });
    }
    for (const std::string& line : rejected) fmt::print(stderr, "rejected {}\n", line);
    for (const std::string& note : notes) say(note);
    if (interrupted()) return kInterrupted;  // nothing is put in place
    if (rejected.size() == scans.size()) throw InputError(o.data.data, "", "no scan is usable");
    say(sink->commit());
    fmt::print("written  {} ({} scans)\n", o.output.string(), scans.size() - rejected.size());
    return rejected.empty() && recording.info().losses.empty() ? kDone : kRejected;
}

int convert_cloud(const ConvertOptions& o) {
    const Output* const kind = chosen_output(o);
    if (kind != nullptr && kind->of_cloud != nullptr) {
        OutputFolder output(o.output, kind->files, replaced_if(o.overwrite));
        const WrittenMap tiles = kind->of_cloud(io::read_cloud(o.data.data), output.path());
        output.commit();
        say(tiles.note);
        fmt::print("written  {} ({} tiles)\n", output.name().string(), tiles.files);
        return kDone;
    }
    if (kind != nullptr) {
        throw ConfigError(
            fmt::format("{}: --to {} is made of a recording, because it needs to know from where "
                        "each point was seen; give the recording as IN, and --labels",
                        o.data.data.string(), kind->name));
    }
    check_cloud_output(o);
    const io::Cloud cloud = io::read_cloud(o.data.data);
    const io::Written written = io::write_cloud(o.output, cloud);
    say(written.loss);
    fmt::print("written  {} ({} points)\n", o.output.string(), written.points);
    return kDone;
}

}  // namespace

int convert(const ConvertOptions& o) {
    std::error_code ignored;
    if (fs::equivalent(o.data.data, o.output, ignored)) {
        throw ConfigError(o.output.string() + ": is the input itself; choose another output");
    }
    const fs::path folder = fs::weakly_canonical(fs::absolute(o.output)).parent_path();
    for (fs::path above = folder; above.has_relative_path(); above = above.parent_path()) {
        if (fs::is_directory(o.data.data, ignored) && fs::equivalent(above, o.data.data, ignored)) {
            throw ConfigError(o.output.string() + ": lies within the recording; choose another");
        }
    }
    if (o.data.format.empty() && is_tiled_map(o.data.data)) return convert_map(o);
    refuse_map_options(o);
    const bool is_recording = !o.data.format.empty() || fs::is_directory(o.data.data, ignored) ||
                              io::Bag::recognises(o.data.data);
    return is_recording ? convert_recording(o) : convert_cloud(o);
}

void add_convert(Program& program) {
    Command c = program.command("convert", "Write a recording or a cloud in another format");
    const auto o = std::make_shared<ConvertOptions>();
    c.path("IN", o->data.data, "recording or cloud file").required();
    c.path("OUT,-o,--output", o->output,
           "bag (.mcap, .bag, .db3), folder, or cloud file (.pcd, .ply, .las, .npy, .bin): of a "
           "recording, all its points "
           "in the world's frame")
        .required();
    c.choice(
        "--to", o->to, output_names(),
        "layout of the output folder: kitti (default), benchmark, nav2 (map in two dimensions), "
        "or autoware (map tiles); of the map of several drives: 3dtiles, las or autoware");
    c.text("--origin", o->origin,
           "with --to 3dtiles: LAT,LON[,HEIGHT] of the world's origin, whose x points to the east "
           "(default: the tiles stay "
           "in the world frame)");
    c.path("--labels", o->labels,
           "output folder of a run, or its labels (default: the ground truth of the recording)");
    c.number("--cell", o->cell, {0.02, 0.25}, "with --to nav2: width of a cell [m]");
    c.number("--robot-height", o->robot_height, {0.05, 10.0},
             "with --to nav2: what hangs higher above the floor is no obstacle [m]");
    c.number("--step", o->step, {0.01, 0.5}, "with --to nav2: what the robot may climb [m]");
    c.whole("--storey", o->storey, {1, 100},
            "with --to nav2: which floor, where several lie one above the other; 1 is the lowest");
    add_reading_options(c, o->data);
    add_selection_options(c, o->data);
    c.flag("--overwrite", o->overwrite, "replace an existing output");
    c.action([o] { return convert(*o); });
}

}  // namespace dynamic_filter::app
