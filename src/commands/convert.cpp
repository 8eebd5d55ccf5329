// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "base/exit_code.hpp"
#include "base/output_folder.hpp"
#include "base/say.hpp"
#include "commands/all.hpp"
#include "commands/convert.hpp"
#include "commands/convert_recording.hpp"
#include "commands/shared_options.hpp"
#include "dynamic_filter/bag.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/writers.hpp"
#include "export/convert_map.hpp"
#include "export/convert_options.hpp"
#include "export/georeference.hpp"
#include "export/outputs.hpp"
#include "export/part.hpp"
#include "formats/voxel_map/map_index.hpp"
#include "recording/rig_file.hpp"

namespace fs = std::filesystem;

namespace dynamic_filter::app {

namespace {

/// Refuses options that the output has no use for.
void refuse_idle_options(const ConvertOptions& o, const Output* kind, bool is_recording) {
    const bool is_cloud = kind == nullptr && io::can_write_cloud(o.output);
    const bool of_cloud = !is_recording && kind != nullptr && kind->of_cloud != nullptr;
    if (o.thin > 0.0 && !is_cloud && !of_cloud) {
        throw ConfigError("--thin is for one cloud (" + io::cloud_kinds_written() + ")");
    }
    const ConvertOptions usual;
    const bool is_of_clouds = o.normals || o.ground || o.moving_class;
    if (is_of_clouds && !(is_cloud && is_recording)) {
        throw ConfigError(
            "--normals, --ground and --moving-class are for a recording that is written as one "
            "cloud (" +
            io::cloud_kinds_written() + ")");
    }
    if (o.cell > 0.0 && (kind == nullptr || !kind->from_sensor)) {
        throw ConfigError("--cell is for OctoMap and for --to nav2; --thin thins a cloud");
    }
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
            tell_note(fmt::format("{} points that are not finite are left out", thin.left_out));
        }
        cloud = std::move(thin.cloud);
    }
    return o.crs.empty() ? cloud : Georeference(o.crs, o.origin).cloud(cloud);
}

int convert_cloud(const ConvertOptions& o) {
    const Output* const kind = chosen_output(o);
    if (kind != nullptr && kind->of_cloud != nullptr) {
        OutputFolder output(o.output, *kind->files, replaced_if(o.overwrite));
        const WrittenMap tiles = kind->of_cloud(wanted_cloud(o), o, output.path());
        output.commit();
        tell_note(tiles.note);
        if (!o.quiet) say("written  {} ({} tiles)\n", output.name().string(), tiles.files);
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
    tell_note(written.loss);
    if (!o.quiet) say("written  {} ({} points)\n", o.output.string(), written.points);
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
    const Output* const kind = chosen_output(o);
    if (o.data.format.empty() && is_tiled_map(o.data.data)) {
        if (!is_of_drives(o)) return convert_map(o);
        refuse_idle_options(o, kind, true);
        return convert_drives(o);
    }
    refuse_map_options(o);
    const bool is_recording = !o.data.format.empty() || fs::is_directory(o.data.data, ignored) ||
                              io::Bag::recognises(o.data.data) || io::is_rig_file(o.data.data);
    refuse_idle_options(o, kind, is_recording);
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
    c.flag("--normals", o->normals,
           "of a recording as a cloud: the normal of the surface at each point, on the side of the "
           "sensor, for meshing");
    c.flag("--ground", o->ground,
           "of a recording as a cloud: a field `classification`, 2 for what lies on the ground");
    c.whole("--moving-class", o->moving_class, {3, 255},
            "of a recording as a cloud: the class of what moves in the field `classification` "
            "(default: 22, of LAS)");
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
