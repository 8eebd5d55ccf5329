// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "base/exit_code.hpp"
#include "base/say.hpp"
#include "check/motion.hpp"
#include "commands/all.hpp"
#include "commands/cleaning.hpp"
#include "commands/picture.hpp"
#include "commands/render.hpp"
#include "commands/shared_options.hpp"
#include "dynamic_filter/error.hpp"
#include "formats/voxel_map/map_index.hpp"
#include "recording/scans.hpp"
#include "settings/config_file.hpp"

namespace dynamic_filter::app {

namespace {

namespace fs = std::filesystem;

std::string extension_of(const fs::path& file) {
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

}  // namespace

int render(const RenderOptions& o) {
    const std::string extension = extension_of(o.output);
    if (extension == ".webp") {
        if (!o.box.empty()) throw ConfigError("--box is for a picture, -o NAME.png");
        const Config config = load_config(o.config);
        io::Recording recording = open(o.data);
        ensure_poses(recording, config,
                     {.deskew = o.data.deskew, .quiet = false, .finds_body = !o.data.mask});
        animate_cleaning(recording, config, o);
    } else if (extension == ".png") {
        const fs::path& in = o.data.data;
        if (fs::is_directory(in) && !fs::exists(in / "static_map.pcd") && !is_tiled_map(in)) {
            throw InputError(
                in, "",
                "holds no static_map.pcd; expected the output folder of a run, a map "
                "of several drives, a cloud, or, to animate a recording, -o NAME.webp");
        }
        io::write_png(o.output, picture_of(o));
    } else {
        throw ConfigError(o.output.string() +
                          ": is neither .png (a picture) nor .webp (a "
                          "recording being cleaned)");
    }
    say("written {}\n", o.output.string());
    return kDone;
}

void add_render(Program& program) {
    Command c = program.command("render", "Draw a map, or animate how a recording is cleaned");
    const auto o = std::make_shared<RenderOptions>();
    c.path("IN", o->data.data, "output folder of a run, cloud file, or a recording to animate")
        .required();
    c.path("-o,--output", o->output,
           "picture to write: .png of a run or cloud, .webp of a recording")
        .required();
    const Option above = c.flag("--top", o->from_above, "look straight down");
    c.flag("--clean", o->clean, "leave out the removed points");
    c.whole("--width", o->width, {16, 16384}, "[pixels]");
    c.whole("--height", o->height, {16, 16384}, "[pixels]");
    c.number("--azimuth", o->azimuth_deg, {-1e6, 1e6},
             "where the camera stands, as an angle from the x axis [deg]")
        .excludes(above);
    c.number("--elevation", o->elevation_deg, {1.0, 89.0},
             "how far the camera looks down from the horizon [deg]")
        .excludes(above);
    c.number("--point-size", o->point_size, {0.5, 50.0}, "size of a point [pixels]");
    c.text(
        "--box", o->box,
        "of a run or cloud: draw only what lies between two corners in the world, X,Y,Z,X,Y,Z or "
        "X,Y,X,Y [m]");
    c.whole("--pictures", o->pictures, {2, 1000}, "number of pictures of an animation");
    add_reading_options(c, o->data);
    add_selection_options(c, o->data);
    add_config_options(c, o->config);
    c.action([o] { return render(*o); });
}

}  // namespace dynamic_filter::app
