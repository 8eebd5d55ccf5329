// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "commands.hpp"
#include "config_file.hpp"
#include "draw/canvas.hpp"
#include "draw/cleaning.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/io/cloud.hpp"
#include "frames.hpp"
#include "motion.hpp"

namespace dynamic_filter::app {

namespace {

namespace fs = std::filesystem;

/// Maps to draw: what stays, and what was removed.
struct Maps {
    Points kept, removed;
};

Maps maps_of(const fs::path& in, bool clean) {
    const bool is_run = fs::is_directory(in);
    const io::Cloud kept = io::read_cloud(is_run ? in / "static_map.pcd" : in);
    const Eigen::Vector3d origin = origin_of(kept);
    Maps maps{positions_from(kept, origin), {}};
    std::erase_if(maps.kept, [](const Point& p) { return !p.allFinite(); });
    if (is_run && !clean && fs::exists(in / "dynamic_points.pcd")) {
        maps.removed = positions_from(io::read_cloud(in / "dynamic_points.pcd"), origin);
    }
    return maps;
}

io::Image draw(const Maps& maps, const RenderOptions& o) {
    constexpr float kOutermost = 0.002F;
    const Eigen::AlignedBox3f box =
        box_of(maps.kept.empty() ? maps.removed : maps.kept, kOutermost);
    Canvas canvas(o.width, o.height, camera_for(box, o.width, o.height, o));
    const auto size = static_cast<float>(o.point_size);
    canvas.draw(maps.kept, size, [&](std::size_t i) { return height_color(maps.kept[i], box); });
    canvas.draw(maps.removed, size, [](std::size_t) { return kRemovedColor; });
    return canvas.picture({250, 250, 250});
}

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
        const Config config = load_config(o.config);
        io::Sequence sequence = open(o.data);
        ensure_poses(sequence, config, o.data.deskew, false);
        animate_cleaning(sequence, config, o);
    } else if (extension == ".png") {
        const fs::path& in = o.data.data;
        if (fs::is_directory(in) && !fs::exists(in / "static_map.pcd")) {
            throw InputError(in, "",
                             "holds no static_map.pcd; expected the output folder of a run, a "
                             "cloud, or, to animate a recording, -o NAME.webp");
        }
        io::write_png(o.output, draw(maps_of(in, o.clean), o));
    } else {
        throw ConfigError(o.output.string() +
                          ": is neither .png (a picture) nor .webp (a "
                          "recording being cleaned)");
    }
    fmt::print("written {}\n", o.output.string());
    return kDone;
}

}  // namespace dynamic_filter::app
