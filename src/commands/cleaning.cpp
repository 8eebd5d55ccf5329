// SPDX-License-Identifier: MIT
#include "commands/cleaning.hpp"

#include <algorithm>
#include <numbers>
#include <numeric>

#include "base/progress.hpp"
#include "commands/render.hpp"
#include "draw/animation.hpp"
#include "draw/canvas.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/filter.hpp"
#include "geometry/pose.hpp"
#include "page/sampling.hpp"
#include "recording/scans.hpp"

namespace dynamic_filter::app {

namespace {

constexpr io::Color kPaper{250, 250, 250}, kDim{222, 226, 230}, kKeptColor{105, 115, 125};

/// A scan thinned at random, and where its points are in the picture's frame.
struct Sample {
    Scan scan;
    Points in_world;
};

Sample sample_of(const io::FullScan& scan, std::size_t index, const Eigen::Vector3d& origin,
                 double points) {
    Sample sample{{{}, scan.T_world_sensor, scan.stamp, index}, {}};
    const double share = points / static_cast<double>(scan.points.size());
    Pose T_picture_sensor = scan.T_world_sensor;
    T_picture_sensor.translation() -= origin;
    for (std::size_t i = 0; i < scan.points.size(); ++i) {
        if (!is_sampled(index, i, share) || !is_measured(scan.points[i])) continue;
        sample.scan.points.push_back(scan.points[i]);
        sample.in_world.push_back((T_picture_sensor * scan.points[i].cast<double>()).cast<float>());
    }
    return sample;
}

/// The view that both halves of the picture share.
struct Stage {
    Camera camera;
    Eigen::AlignedBox3f box;
    int width, height;
    float size;

    [[nodiscard]] Canvas canvas() const { return {width, height, camera}; }
};

Stage stage_for(const std::vector<Sample>& samples, const RenderOptions& o) {
    Points all;
    for (const Sample& s : samples) all.insert(all.end(), s.in_world.begin(), s.in_world.end());
    Stage stage{{}, box_of(all, 0.005F), o.width, o.height / 2, static_cast<float>(o.point_size)};
    stage.camera = camera_for(stage.box, stage.width, stage.height, o);
    return stage;
}

/// Returns the points of each sample that are not dynamic by the evidence so far.
std::vector<Points> kept_of(const std::vector<Sample>& samples, std::size_t count,
                            const DynamicFilter& filter) {
    std::vector<Points> kept(count);
    for (std::size_t s = 0; s < count; ++s) {
        const Labels labels = filter.settled(samples[s].scan).labels;
        for (std::size_t i = 0; i < labels.size(); ++i) {
            if (labels[i] != Label::dynamic) kept[s].push_back(samples[s].in_world[i]);
        }
    }
    return kept;
}

io::Image draw_map(const Stage& stage, const std::vector<Points>& kept) {
    Canvas canvas = stage.canvas();
    for (const Points& points : kept) {
        canvas.draw(points, stage.size,
                    [&](std::size_t i) { return height_color(points[i], stage.box); });
    }
    return canvas.picture(kPaper);
}

/// A scan with its verdict, over the dimmed map.
io::Image draw_scan(const Stage& stage, const Sample& sample, const Labels& labels,
                    const std::vector<Points>& kept) {
    Canvas canvas = stage.canvas();
    const auto draw = [&](Label label, float size, const io::Color& color) {
        Points points;
        for (std::size_t i = 0; i < labels.size(); ++i) {
            if (labels[i] == label) points.push_back(sample.in_world[i]);
        }
        canvas.draw(points, size, [&](std::size_t) { return color; });
    };
    draw(Label::dynamic, 2.0F * stage.size, kRemovedColor);
    draw(Label::unknown, stage.size, kUnknownColor);
    draw(Label::static_, stage.size, kKeptColor);
    for (const Points& points : kept) {
        canvas.draw(points, stage.size, [&](std::size_t) { return kDim; });
    }
    return canvas.picture(kPaper);
}

io::Image stacked(io::Image above, const io::Image& below) {
    above.height += below.height;
    above.pixels.insert(above.pixels.end(), below.pixels.begin(), below.pixels.end());
    return above;
}

}  // namespace

Camera camera_for(const Eigen::AlignedBox3f& box, int width, int height, const RenderOptions& o) {
    constexpr double kRadian = std::numbers::pi / 180.0;
    const float aspect = static_cast<float>(width) / static_cast<float>(height);
    return o.from_above ? from_above(box, aspect)
                        : from_aside(box, aspect, static_cast<float>(kRadian * o.azimuth_deg),
                                     static_cast<float>(kRadian * o.elevation_deg));
}

void animate_cleaning(const io::Recording& recording, const Config& config,
                      const RenderOptions& o) {
    if (config.method != Method::scans) {
        throw ConfigError(
            "render: only where scans observe (--preset default) is there a map to "
            "show after every scan");
    }
    DynamicFilter filter(config);
    constexpr double kPoints = 600'000.0, kMostOfScan = 6000.0;  // of all samples
    const double points = std::min(
        kMostOfScan, kPoints / static_cast<double>(std::max<std::size_t>(1, recording.size())));
    std::vector<std::size_t> scans(recording.size());
    std::iota(scans.begin(), scans.end(), std::size_t{0});

    std::vector<Sample> samples;
    std::optional<Eigen::Vector3d> origin;
    for_each_scan(recording, scans, {}, [&](std::size_t i, MaybeScan& maybe) {
        if (!maybe.scan) return true;
        if (!origin) origin = nearby_origin(maybe.scan->T_world_sensor, 1.0);
        samples.push_back(sample_of(*maybe.scan, i, *origin, points));
        return true;
    });
    if (samples.empty()) throw InputError(recording.info().root, "", "no scan is usable");
    const Stage stage = stage_for(samples, o);

    constexpr int kMilliseconds = 100;
    Animation animation(kMilliseconds);
    const std::size_t stride = (samples.size() + static_cast<std::size_t>(o.pictures) - 1) /
                               static_cast<std::size_t>(o.pictures);
    Progress progress("draw", samples.size());
    std::size_t done = 0;
    for_each_scan(recording, scans, {}, [&](std::size_t i, MaybeScan& maybe) {
        if (!maybe.scan) return true;
        const bool drawn = ++done % stride == 0 || done == samples.size();
        constexpr double kOfNewest = 20'000.0;
        const Sample newest = sample_of(*maybe.scan, i, *origin, drawn ? kOfNewest : 0.0);
        filter.push(moved_scan(*maybe.scan, i));
        if (drawn) {
            const auto kept = kept_of(samples, done, filter);
            const Labels labels = filter.settled(newest.scan).labels;
            animation.add(stacked(draw_scan(stage, newest, labels, kept), draw_map(stage, kept)));
        }
        progress.advance();
        return true;
    });
    animation.write(o.output);
}

}  // namespace dynamic_filter::app
