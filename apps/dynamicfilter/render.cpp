// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "commands.hpp"
#include "config_file.hpp"
#include "draw/canvas.hpp"
#include "draw/cleaning.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/geometry/pose.hpp"
#include "dynamic_filter/io/cloud.hpp"
#include "frames.hpp"

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
    const Points rough = positions_from(kept, Eigen::Vector3d::Zero());
    Pose first = Pose::Identity();
    if (!rough.empty() && rough.front().allFinite()) {
        first.translation() = rough.front().cast<double>();
    }
    const Eigen::Vector3d origin = nearby_origin(first, 1.0);
    Maps maps{positions_from(kept, origin), {}};
    std::erase_if(maps.kept, [](const Point& p) { return !p.allFinite(); });
    if (is_run && !clean && fs::exists(in / "dynamic_points.pcd")) {
        maps.removed = positions_from(io::read_cloud(in / "dynamic_points.pcd"), origin);
    }
    return maps;
}

io::Image draw(const Maps& maps, const RenderOptions& o) {
    constexpr float kOutermost = 0.002F;
    constexpr double kRadian = M_PI / 180.0;
    const Eigen::AlignedBox3f box =
        box_of(maps.kept.empty() ? maps.removed : maps.kept, kOutermost);
    const float aspect = static_cast<float>(o.width) / static_cast<float>(o.height);
    const Camera camera = o.from_above
                              ? from_above(box, aspect)
                              : from_aside(box, aspect, static_cast<float>(kRadian * o.azimuth_deg),
                                           static_cast<float>(kRadian * o.elevation_deg));
    Canvas canvas(o.width, o.height, camera);
    const auto size = static_cast<float>(o.point_size);
    canvas.draw(maps.kept, size, [&](std::size_t i) {
        const float share = (maps.kept[i].z() - box.min().z()) / std::max(0.1F, box.sizes().z());
        return height_color(std::clamp(share, 0.0F, 1.0F));
    });
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
        animate_cleaning(open(o.data), load_config(o.config), o);
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
