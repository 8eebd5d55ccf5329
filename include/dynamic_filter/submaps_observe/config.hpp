// SPDX-License-Identifier: MIT
/// @file
/// All settings of the paper's method ("submaps") and of Removert ("removert").
///
/// - Units: visit_submaps() names the unit of each field.
/// - Ownership: values.
/// - Threads: plain data.
/// - Errors: none.
#pragma once

#include "dynamic_filter/setting.hpp"

namespace dynamic_filter {

/// How points that were wrongly removed are reverted (Sec. III-B2).
enum class Reverting { map, visibility, none };

/// How many keyframes make a submap (Sec. III-B).
struct SubmapConfig {
    int keyframes = 20;
};

/// Scan-to-map front-end (Sec. III-B).
struct FrontEndConfig {
    bool enabled = true;
    double image_step_deg = 0.5;
    double image_step_beams = 1.0;
    double tau = 0.2;
    double tau_per_metre = 0.05;
    Reverting reverting = Reverting::map;
    double revert_radius = 0.5;
    int revert_neighbors = 5;
    double revert_dist_max = 0.05;
    double revert_image_scale = 2.0;
};

/// Map-to-map back-end (Sec. III-C).
struct BackEndConfig {
    bool enabled = true;
    int max_submaps = 20;
    bool visibility_check = true;
    bool incident_correction = true;
    double incident_threshold_deg = 60.0;
    double image_step_deg = 1.0;
    double image_step_beams = 0.75;
    double depth_channel = 0.2;
};

/// Calls f(setting, member) for every field, in the order of the structs.
template <class C, class F>
void visit_submaps(C& config, F&& f) {
    constexpr unsigned kPaper = methods_of(Method::submaps);
    constexpr unsigned kBoth = kPaper | methods_of(Method::removert);
    const auto field = [&](unsigned methods, const char* key, const char* unit, const char* symbol,
                           const char* help, double min, double max, auto& member) {
        f(Setting{key, unit, symbol, help, min, max, methods}, member);
    };
    field(kPaper, "submap.keyframes", "1", "n", "number of keyframes per submap", 1, 100000,
          config.submap.keyframes);
    auto& front = config.front_end;
    field(kPaper, "front_end.enabled", "", "Table III", "false: only the back-end runs", 0, 0,
          front.enabled);
    field(kBoth, "front_end.image_step_deg", "deg", "res",
          "smallest size of a pixel of the range images of scans", 0.05, 30, front.image_step_deg);
    field(kBoth, "front_end.image_step_beams", "1", "res",
          "smallest pixel of these images as a multiple of the angle between beams", 0, 20,
          front.image_step_beams);
    field(kBoth, "front_end.tau", "m", "III-B1",
          "a point is dynamic if it is this much nearer than the range in the image of a keyframe",
          0, 10, front.tau);
    field(kBoth, "front_end.tau_per_metre", "1", "III-B1",
          "share of the range of the point that is added to front_end.tau", 0, 1,
          front.tau_per_metre);
    field(kPaper, "front_end.reverting", "", "III-B2",
          "how removed points are reverted to static: map, visibility (as Removert does) or none",
          0, 0, front.reverting);
    field(kPaper, "front_end.revert_radius", "m", "r",
          "reverting uses static neighbors within this distance", 0.05, 10, front.revert_radius);
    field(kPaper, "front_end.revert_neighbors", "1", "k",
          "reverting uses at most this number of nearest static neighbors", 3, 100,
          front.revert_neighbors);
    field(kPaper, "front_end.revert_dist_max", "1", "dist_max",
          "a point is reverted if it changes the normal of its neighbors by less than this", 0, 2,
          front.revert_dist_max);
    field(kBoth, "front_end.revert_image_scale", "1", "III-B2",
          "factor by which pixels are enlarged for visibility-based reverting", 1, 20,
          front.revert_image_scale);
    auto& back = config.back_end;
    field(kPaper, "back_end.enabled", "", "Table III", "false: only the front-end runs", 0, 0,
          back.enabled);
    field(kPaper, "back_end.max_submaps", "1", "B",
          "largest number of submaps that are used at a pose; the nearest ones are used", 1, 64,
          back.max_submaps);
    field(kPaper, "back_end.visibility_check", "", "Table III",
          "false: every nearby submap counts as an observer of every voxel", 0, 0,
          back.visibility_check);
    field(kPaper, "back_end.incident_correction", "", "Table III",
          "false: no point is pseudo-occupied", 0, 0, back.incident_correction);
    field(kPaper, "back_end.incident_threshold_deg", "deg", "lambda_thres",
          "a point is pseudo-occupied if the incidence angle of its beam is larger than this", 0,
          90, back.incident_threshold_deg);
    field(kPaper, "back_end.image_step_deg", "deg", "res",
          "smallest size of a pixel of the images of submaps", 0.05, 30, back.image_step_deg);
    field(kPaper, "back_end.image_step_beams", "1", "res",
          "smallest pixel of these images as a multiple of the angle between beams", 0, 20,
          back.image_step_beams);
    field(kPaper, "back_end.depth_channel", "m", "depth",
          "length of a depth channel; 0: ranges are compared without channels", 0, 10,
          back.depth_channel);
}

}  // namespace dynamic_filter
