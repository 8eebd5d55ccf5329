// SPDX-License-Identifier: MIT
#include "paper/front_end.hpp"

#include <algorithm>
#include <numbers>

#include "geometry/pose.hpp"
#include "paper/removert.hpp"
#include "paper/reverting.hpp"
#include "paper/visibility_removal.hpp"

namespace dynamic_filter {

namespace {

RemovalMargin margin_of(const FrontEndConfig& config) {
    return {static_cast<float>(config.tau), static_cast<float>(config.tau_per_metre)};
}

Thinner thin_static(const Window& window, const std::vector<Labels>& labels, double voxel_size) {
    Thinner thinner(static_cast<float>(voxel_size));
    Points points;
    for (std::size_t s = 0; s < window.scans.size(); ++s) {
        to_map(window.scans[s], points);
        thinner.add(points, labels[s], Label::static_);
    }
    return thinner;
}

Submap assemble(const Window& window, const std::vector<Labels>& labels, double voxel_size) {
    std::vector<Pose> poses;
    for (const Scan& scan : window.scans) poses.push_back(scan.T_world_sensor);
    return {mean_pose(poses), thin_static(window, labels, voxel_size).moved_points()};
}

/// Beam pattern measured on the first scans that have measured points.
BeamPattern beams_of(const Window& window) {
    std::vector<Scan> few;
    for (const Scan& scan : window.scans) {
        const bool measured = std::any_of(scan.points.begin(), scan.points.end(), is_measured);
        if (measured && few.size() < 5) few.push_back(scan);
    }
    return estimate_beam_pattern(few);
}

}  // namespace

float pixel_step(double least_deg, double beams, float beam_spacing) {
    const auto least = static_cast<float>(least_deg * std::numbers::pi / 180.0);
    return std::max(least, static_cast<float>(beams) * beam_spacing);
}

std::vector<RangeImage> FrontEnd::images(const Window& window, float scale) const {
    const auto& c = config_.front_end;
    return keyframe_images(
        window, scale * pixel_step(c.image_step_deg, c.image_step_beams, beams_->azimuth_spacing),
        scale * pixel_step(c.image_step_deg, c.image_step_beams, beams_->elevation_spacing));
}

void FrontEnd::revert(const Window& window, std::vector<Labels>& labels) const {
    const auto& c = config_.front_end;
    if (c.reverting == Reverting::visibility) {
        const auto scale = static_cast<float>(c.revert_image_scale);
        revert_by_visibility(window, images(window, scale), margin_of(c),
                             static_cast<float>(config_.map.voxel_size), labels);
    } else if (c.reverting == Reverting::map) {
        const Points points = thin_static(window, labels, config_.map.voxel_size).moved_points();
        const NeighborGrid static_map(points, static_cast<float>(c.revert_radius));
        revert_by_map(window, static_map, c, labels);
    }
}

std::vector<Labels> FrontEnd::remove_and_revert(const Window& window) const {
    const std::vector<KeyframeImages> fine{images(window, 1.0F), images(window, 1.25F),
                                           images(window, 1.5F)};
    const auto scale = static_cast<float>(config_.front_end.revert_image_scale);
    return removert(window, fine, images(window, scale), margin_of(config_.front_end),
                    static_cast<float>(config_.map.voxel_size));
}

FrontEndResult FrontEnd::process(const Window& window, StageTimes& times) {
    // First window, or only empty windows so far.
    if (!beams_ || beams_->elevation_spacing == 0.0F) {
        beams_ = beams_of(window);
    }
    std::vector<Labels> labels;
    if (config_.method == Method::removert) {
        labels = timed(times, "removert", [&] { return remove_and_revert(window); });
    } else if (config_.front_end.enabled) {
        labels = timed(times, "visibility_removal", [&] {
            auto seen = images(window, 1.0F);
            std::transform(seen.begin(), seen.end(), seen.begin(), halve_rows);
            return remove_by_visibility(window, seen, margin_of(config_.front_end));
        });
        timed(times, "reverting", [&] { revert(window, labels); });
    } else {
        labels = label_measured(window);
    }
    Submap submap =
        timed(times, "submap", [&] { return assemble(window, labels, config_.map.voxel_size); });
    return {std::move(submap), std::move(labels)};
}

}  // namespace dynamic_filter
