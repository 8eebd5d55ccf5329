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
    field(kPaper, "submap.keyframes", "1", "n", "keyframes per submap", 1, 100000,
          config.submap.keyframes);
    auto& front = config.front_end;
    field(kPaper, "front_end.enabled", "", "Table III", "off: back-end only", 0, 0, front.enabled);
    field(kBoth, "front_end.image_step_deg", "deg", "res", "least pixel of the scans' range images",
          0.05, 30, front.image_step_deg);
    field(kBoth, "front_end.image_step_beams", "1", "res",
          "... and in spacings of the sensor's beams", 0, 20, front.image_step_beams);
    field(kBoth, "front_end.tau", "m", "III-B1",
          "a point this much nearer than the scan's range is dynamic", 0, 10, front.tau);
    field(kBoth, "front_end.tau_per_metre", "1", "III-B1", "... plus this share of its range", 0, 1,
          front.tau_per_metre);
    field(kPaper, "front_end.reverting", "", "III-B2", "map, visibility (Removert's) or none", 0, 0,
          front.reverting);
    field(kPaper, "front_end.revert_radius", "m", "r",
          "reverting looks for static neighbours within", 0.05, 10, front.revert_radius);
    field(kPaper, "front_end.revert_neighbors", "1", "k", "... and takes the nearest of them", 3,
          100, front.revert_neighbors);
    field(kPaper, "front_end.revert_dist_max", "1", "dist_max",
          "largest change of the normal that reverts", 0, 2, front.revert_dist_max);
    field(kBoth, "front_end.revert_image_scale", "1", "III-B2",
          "pixel growth of visibility reverting", 1, 20, front.revert_image_scale);
    auto& back = config.back_end;
    field(kPaper, "back_end.enabled", "", "Table III", "off: front-end only", 0, 0, back.enabled);
    field(kPaper, "back_end.max_submaps", "1", "B",
          "submaps consulted at a pose, at most: the nearest", 1, 64, back.max_submaps);
    field(kPaper, "back_end.visibility_check", "", "Table III",
          "off: every nearby submap counts as having looked", 0, 0, back.visibility_check);
    field(kPaper, "back_end.incident_correction", "", "Table III", "off: no pseudo-occupied points",
          0, 0, back.incident_correction);
    field(kPaper, "back_end.incident_threshold_deg", "deg", "lambda_thres",
          "beams more slanted than this are pseudo-occupied", 0, 90, back.incident_threshold_deg);
    field(kPaper, "back_end.image_step_deg", "deg", "res", "least pixel of the submaps' images",
          0.05, 30, back.image_step_deg);
    field(kPaper, "back_end.image_step_beams", "1", "res",
          "... and in spacings of the sensor's beams", 0, 20, back.image_step_beams);
    field(kPaper, "back_end.depth_channel", "m", "depth",
          "length of a depth channel; 0 compares ranges", 0, 10, back.depth_channel);
}

}  // namespace dynamic_filter
