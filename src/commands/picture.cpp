// SPDX-License-Identifier: MIT
#include "commands/picture.hpp"

#include <cmath>
#include <optional>

#include "commands/cleaning.hpp"
#include "commands/render.hpp"
#include "draw/canvas.hpp"
#include "dynamic_filter/cloud.hpp"
#include "dynamic_filter/error.hpp"
#include "export/part.hpp"
#include "formats/voxel_map/map_index.hpp"
#include "formats/voxel_map/tile_points.hpp"
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

/// The voxels of a map of several drives, thinned if they are more than a picture can show.
Maps voxels_of(const fs::path& folder, const std::optional<Box>& box) {
    constexpr double kMost = 2e7;  // voxels
    const MapIndex index = read_map_index(map_folder_of(folder));
    double voxels = 0.0;
    for (const MapTile& tile : index.tiles) voxels += static_cast<double>(tile.voxels);
    // Surfaces thin out by the square of the spacing.
    const double spacing = index.voxel_size * std::sqrt(std::max(1.0, voxels / kMost));
    Maps maps;
    std::optional<Eigen::Vector3d> origin;
    for (const MapTile& tile : index.tiles) {
        TilePoints points = read_tile(map_folder_of(folder), index, tile);
        if (voxels > kMost) points = thinned(points, spacing);
        for (const Eigen::Vector3d& p : points.positions) {
            if (box && !box->contains(p)) continue;
            if (!origin) origin = p;
            maps.kept.push_back((p - *origin).cast<float>());
        }
    }
    return maps;
}

/// The maps of a run, or a cloud.
Maps points_of(const RenderOptions& o, const std::optional<Box>& box) {
    const fs::path& in = o.data.data;
    const bool is_run = fs::is_directory(in);
    const io::Cloud kept = read_part(is_run ? in / "static_map.pcd" : in, box);
    const Eigen::Vector3d origin = origin_of(kept);
    Maps maps{positions_from(kept, origin), {}};
    std::erase_if(maps.kept, [](const Point& p) { return !p.allFinite(); });
    if (is_run && !o.clean && fs::exists(in / "dynamic_points.pcd")) {
        maps.removed = positions_from(read_part(in / "dynamic_points.pcd", box), origin);
    }
    return maps;
}

Maps maps_of(const RenderOptions& o) {
    const fs::path& in = o.data.data;
    const std::optional<Box> box = box_of(o.box);
    const Maps maps = is_tiled_map(in) ? voxels_of(in, box) : points_of(o, box);
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
