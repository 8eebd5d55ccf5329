// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <numeric>

#include "base/exit_code.hpp"
#include "base/output_folder.hpp"
#include "base/progress.hpp"
#include "check/motion.hpp"
#include "commands/all.hpp"
#include "commands/convert.hpp"
#include "commands/shared_options.hpp"
#include "dynamic_filter/bag.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/writers.hpp"
#include "export/convert_map.hpp"
#include "export/convert_options.hpp"
#include "export/georeference.hpp"
#include "export/outputs.hpp"
#include "export/part.hpp"
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

/// Refuses options that the output has no use for.
void refuse_idle_options(const ConvertOptions& o, const Output* kind, bool is_recording) {
    const bool is_cloud = kind == nullptr && io::can_write_cloud(o.output);
    const bool of_cloud = !is_recording && kind != nullptr && kind->of_cloud != nullptr;
    if (o.thin > 0.0 && !is_cloud && !of_cloud) {
        throw ConfigError("--thin is for one cloud (" + io::cloud_kinds_written() + ")");
    }
    if (o.cell > 0.0 && (kind == nullptr || !kind->from_sensor)) {
        throw ConfigError("--cell is for OctoMap and for --to nav2; --thin thins a cloud");
    }
    const ConvertOptions usual;
    const bool is_of_robot =
        o.robot_height != usual.robot_height || o.step != usual.step || o.storey != usual.storey;
    if (is_of_robot && (kind == nullptr || kind->name != "nav2")) {
        throw ConfigError("--robot-height, --step and --storey are for --to nav2");
    }
    if (!o.crs.empty() && !is_cloud) {
        throw ConfigError("--crs is for one cloud (" + io::cloud_kinds_written() +
                          "), and for --to las of the map of several drives");
    }
    const bool has_origin = kind != nullptr && kind->name == "autoware";
    if (!o.origin.empty() && o.crs.empty() && !has_origin) {
        throw ConfigError("--origin is for --crs, --to autoware and --to 3dtiles");
    }
    if (!o.only.empty() && kind != nullptr && kind->from_sensor) {
        throw ConfigError("--only: " + kind->shown() +
                          " needs what stands and what moves, because both end beams");
    }
    if (kind != nullptr && kind->of_whole_scans &&
        !(o.box.empty() && o.only.empty() && o.max_range == 0.0)) {
        throw ConfigError("--box, --max-range and --only: " + kind->shown() +
                          " has a label for each point of the recording");
    }
    if (is_recording) return;
    if (o.labels) {
        throw ConfigError(o.data.data.string() + ": --labels is for a recording; a cloud has none");
    }
    if (!o.only.empty() || o.max_range > 0.0) {
        throw ConfigError(o.data.data.string() + ": " +
                          (o.only.empty() ? "--max-range" : "--only") +
                          " is for a recording, which tells where the sensor was and, with "
                          "--labels, what moves");
    }
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

/// Refuses options that are for the map of several drives only.
void refuse_map_options(const ConvertOptions& o) {
    const Output* const kind = chosen_output(o);
    const bool is_for_maps =
        kind != nullptr && kind->of_recording == nullptr && kind->of_cloud == nullptr;
    if (!is_for_maps) return;
    throw ConfigError(fmt::format(
        "{}: --to {} is for the map of several drives, which `dynamicfilter run A B ... -o OUT` "
        "makes; give OUT as IN",
        o.data.data.string(), o.to));
}

int convert_recording(const ConvertOptions& o) {
    const Output* const kind = chosen_output(o);
    refuse_idle_options(o, kind, true);
    if (kind != nullptr && kind->of_recording == nullptr) {
        throw ConfigError(kind->shown() + " is for a map: give a cloud file as IN");
    }
    const RecordingOfResult opened =
        o.labels ? open_for_result(o.data, *o.labels) : RecordingOfResult{open(o.data)};
    io::Recording recording = opened.recording;
    say(opened.note);
    ensure_poses(recording, preset("default"), {.deskew = o.data.deskew, .quiet = o.quiet});
    ConvertOptions of_sink = o;
    // What is written is of the frame that the files have, unless the output follows the beams.
    if (kind == nullptr || !kind->from_sensor) {
        of_sink.sensor = recording.info().sensor_at.value_or(Eigen::Vector3d::Zero());
        recording = io::with_sensor_at(recording, Eigen::Vector3d::Zero());
    }
    for (const std::string& note : recording.info().notes) fmt::print(stderr, "note: {}\n", note);
    for (const std::string& line : recording.info().losses)
        fmt::print(stderr, "lost     {}\n", line);
    catch_interrupts();
    if (io::BagWriter::recognises(o.output) || !o.only.empty()) {  // only these ask for it
        of_sink.keep_unknown = settings_of(o).map.keep_unknown;
    }
    const Wanted part = wanted_of(of_sink);
    const std::unique_ptr<Sink> sink = make_sink(of_sink);
    std::size_t written = 0;
    std::vector<std::size_t> scans(recording.size());
    std::iota(scans.begin(), scans.end(), 0U);
    std::vector<std::string> rejected, notes;
    {
        Progress progress("convert", scans.size(), o.quiet);
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
            written += append_part(*sink, part, *maybe.scan,
                                   labels_of(o, recording, i, *maybe.scan), io::stem(recording, i));
            return true;
        });
    }
    for (const std::string& line : rejected) fmt::print(stderr, "rejected {}\n", line);
    for (const std::string& note : notes) say(note);
    if (interrupted()) return kInterrupted;  // nothing is put in place
    if (rejected.size() == scans.size()) throw InputError(o.data.data, "", "no scan is usable");
    if (written == 0) {
        throw ConfigError(
            "no scan has a point that --box, --max-range and --only take; nothing is written");
    }
    const std::size_t empty = scans.size() - rejected.size() - written;
    if (empty > 0) say(fmt::format("{} scans have no point there, and are left out", empty));
    say(sink->commit());
    if (!o.quiet) fmt::print("written  {} ({} scans)\n", o.output.string(), written);
    return rejected.empty() && recording.info().losses.empty() ? kDone : kRejected;
}

io::Cloud wanted_cloud(const ConvertOptions& o) {
    io::Cloud cloud = io::read_cloud(o.data.data);
    if (const std::optional<Box> box = box_of(o.box)) {
        cloud = part_of(cloud, wanted_points(*box, cloud));
        if (cloud.size() == 0) {
            throw ConfigError("--box " + o.box + ": no point of " + o.data.data.string() +
                              " lies there");
        }
    }
    if (o.thin > 0.0) {
        ThinnedPart thin = thinned(cloud, o.thin);
        if (thin.cloud.size() == 0) throw InputError(o.data.data, "", "no point is finite");
        if (thin.left_out > 0) {
            say(fmt::format("{} points that are not finite are left out", thin.left_out));
        }
        cloud = std::move(thin.cloud);
    }
    return o.crs.empty() ? cloud : Georeference(o.crs, o.origin).cloud(cloud);
}

int convert_cloud(const ConvertOptions& o) {
    const Output* const kind = chosen_output(o);
    refuse_idle_options(o, kind, false);
    if (kind != nullptr && kind->of_cloud != nullptr) {
        OutputFolder output(o.output, *kind->files, replaced_if(o.overwrite));
        const WrittenMap tiles = kind->of_cloud(wanted_cloud(o), o, output.path());
        output.commit();
        say(tiles.note);
        if (!o.quiet) fmt::print("written  {} ({} tiles)\n", output.name().string(), tiles.files);
        return kDone;
    }
    if (kind != nullptr) {
        throw ConfigError(
            fmt::format("{}: {} is made of a recording, because it needs to know from where "
                        "each point was seen; give the recording as IN, and --labels",
                        o.data.data.string(), kind->shown()));
    }
    check_cloud_output(o);
    const io::Written written = io::write_cloud(o.output, wanted_cloud(o));
    say(written.loss);
    if (!o.quiet) fmt::print("written  {} ({} points)\n", o.output.string(), written.points);
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
           "bag (.mcap, .bag, .db3), folder, OctoMap (.bt, .ot), or cloud file (.pcd, .ply, .las, "
           ".npy, .bin): of a recording, all its points in the world's frame")
        .required();
    c.choice(
        "--to", o->to, output_names(),
        "layout of the output folder: kitti (default), benchmark, nav2 (map in two dimensions), "
        "objects (what moves, with boxes), or autoware (map tiles); of the map of several drives: "
        "3dtiles, las or autoware");
    c.text("--origin", o->origin,
           "where the origin of the poses lies, if their x points to the east: LAT,LON[,HEIGHT]; "
           "or with --crs EAST,NORTH[,HEIGHT], which is added");
    c.text("--crs", o->crs,
           "coordinate system of a cloud to write, such as EPSG:32633; LAS names it "
           "(default: coordinates stay those of the poses)");
    c.path("--labels", o->labels,
           "output folder of a run, or its labels (default: the ground truth of the recording)");
    visit_numbers(*o, [&](const NumberOption& option, double& value) {
        c.number(as_option(option.name).c_str(), value, {option.low, option.high}, option.help);
    });
    c.whole("--storey", o->storey, {1, 100},
            "with --to nav2: which floor, where several lie one above the other; 1 is the lowest");
    c.text("--box", o->box,
           "two corners of a box in the world, X,Y,Z,X,Y,Z or X,Y,X,Y [m]: what lies outside "
           "counts as not measured");
    c.choice("--only", o->only, {"static", "dynamic"},
             "of a recording, with --labels: only what stands, or only what moves");
    add_reading_options(c, o->data);
    add_selection_options(c, o->data);
    c.flag("--overwrite", o->overwrite, "replace an existing output");
    add_quiet(c, o->quiet);
    c.action([o] { return convert(*o); });
}

}  // namespace dynamic_filter::app
