// SPDX-License-Identifier: MIT
#include "commands/picture.hpp"

#include "commands/cleaning.hpp"
#include "commands/render.hpp"
#include "draw/canvas.hpp"
#include "dynamic_filter/cloud.hpp"
#include "dynamic_filter/error.hpp"
#include "export/part.hpp"
#include "recording/scans.hpp"

namespace dynamic_filter::app {

namespace {

namespace fs = std::filesystem;

/// Maps to draw: what stays, and what was removed.
struct Maps {
    Points kept, removed;
};

io::Cloud read_part(const fs::path& file, const std::optional<Box>& box) {
    io::Cloud cloud = io::read_cloud(file);
    return box ? part_of(cloud, wanted_points(*box, cloud)) : cloud;
}

Maps maps_of(const RenderOptions& o) {
    const fs::path& in = o.data.data;
    const bool is_run = fs::is_directory(in);
    const std::optional<Box> box = box_of(o.box);
    const io::Cloud kept = read_part(is_run ? in / "static_map.pcd" : in, box);
    const Eigen::Vector3d origin = origin_of(kept);
    Maps maps{positions_from(kept, origin), {}};
    std::erase_if(maps.kept, [](const Point& p) { return !p.allFinite(); });
    if (is_run && !o.clean && fs::exists(in / "dynamic_points.pcd")) {
        maps.removed = positions_from(read_part(in / "dynamic_points.pcd", box), origin);
    }
    if (box && maps.kept.empty() && maps.removed.empty()) {
        throw ConfigError("--box " + o.box + ": no point of " + in.string() + " lies there");
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

}  // namespace

io::Image picture_of(const RenderOptions& options) { return draw(maps_of(options), options); }

}  // namespace dynamic_filter::app
