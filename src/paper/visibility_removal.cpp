// SPDX-License-Identifier: MIT
#include "paper/visibility_removal.hpp"

#include <limits>

#include "dynamic_filter/parallel.hpp"

namespace dynamic_filter {

namespace {

/// Marks the points through which the image sees.
void mark_seen_through(const Projection& seen, const RangeImage& image, const RemovalMargin& margin,
                       Labels& labels) {
    for (std::size_t i = 0; i < labels.size(); ++i) {
        if (seen.pixel[i] < 0 || labels[i] != Label::static_) continue;
        const float boundary = image.range[static_cast<std::size_t>(seen.pixel[i])];
        const bool returned = boundary < std::numeric_limits<float>::infinity();
        if (returned && boundary - seen.range[i] > margin.at(seen.range[i])) {
            labels[i] = Label::dynamic;
        }
    }
}

}  // namespace

std::vector<RangeImage> keyframe_images(const Window& window, float azimuth_step,
                                        float elevation_step) {
    std::vector<RangeImage> images(window.keyframes.size());
    parallel_for(images.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            const Points& points = window.scans[window.keyframes[k]].points;
            const auto [lowest, highest] = elevation_range(points);
            images[k] = nearest_range_image(
                points, make_grid(azimuth_step, elevation_step, lowest, highest));
        }
    });
    return images;
}

Labels label_measured(const Points& points) {
    Labels labels;
    labels.reserve(points.size());
    for (const Point& p : points)
        labels.push_back(is_measured(p) ? Label::static_ : Label::unknown);
    return labels;
}

std::vector<Labels> label_measured(const Window& window) {
    std::vector<Labels> labels;
    for (const Scan& scan : window.scans) labels.push_back(label_measured(scan.points));
    return labels;
}

std::vector<Labels> remove_by_visibility(const Window& window, std::span<const RangeImage> images,
                                         const RemovalMargin& margin) {
    std::vector<Labels> labels(window.scans.size());
    parallel_for(window.scans.size(), 1, [&](std::size_t begin, std::size_t end) {
        Projection seen;
        for (std::size_t s = begin; s < end; ++s) {
            const Scan& scan = window.scans[s];
            labels[s] = label_measured(scan.points);
            for (std::size_t k = 0; k < images.size(); ++k) {
                // The image of the same scan holds the point itself.
                if (window.keyframes[k] == s) continue;
                const Pose& T_map_keyframe = window.scans[window.keyframes[k]].T_world_sensor;
                const Pose T_keyframe_scan = T_map_keyframe.inverse() * scan.T_world_sensor;
                project(scan.points, T_keyframe_scan.cast<float>(), images[k].grid, seen);
                mark_seen_through(seen, images[k], margin, labels[s]);
            }
        }
    });
    return labels;
}

}  // namespace dynamic_filter
