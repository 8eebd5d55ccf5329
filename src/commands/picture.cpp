// SPDX-License-Identifier: MIT
#include "commands/picture.hpp"

#include "commands/cleaning.hpp"
#include "commands/render.hpp"
#include "draw/canvas.hpp"
#include "dynamic_filter/cloud.hpp"
#include "recording/scans.hpp"

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

}  // namespace

io::Image picture_of(const RenderOptions& options) {
    return draw(maps_of(options.data.data, options.clean), options);
}

}  // namespace dynamic_filter::app
