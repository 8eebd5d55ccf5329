// SPDX-License-Identifier: MIT
/// @file
/// Every setting, its default, unit and bounds: written once, here.
///
/// - Units: what visit() says of each field.
/// - Ownership: texts of a Setting live for ever.
/// - Shapes: a sentence per fault.
/// - Threads: plain data and pure functions; thread-safe.
/// - Errors: ConfigError, where a function says.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace dynamic_filter {

/// The paper's, or its baseline (Table II).
enum class Method { dynamic_filter, removert };
/// What takes points back (Sec. III-B2).
enum class Reverting { map, visibility, none };
/// Who looks at a voxel (Sec. III-C2).
enum class Observers { scans, submaps };

/// All settings, with the defaults of the preset "default". What each means: visit().
struct Config {
    Method method = Method::dynamic_filter;

    /// Which scans are keyframes, and how many make a submap (Sec. III-B).
    struct Submap {
        int keyframes = 20;
        double keyframe_interval = 0.25;
        double keyframe_distance = 0.5;
    } submap;

    /// Scan to map (Sec. III-B).
    struct FrontEnd {
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
    } front_end;

    /// Map to map (Sec. III-C).
    struct BackEnd {
        bool enabled = true;
        Observers observers = Observers::scans;
        int max_scans = 400;
        double search_radius = 20.0;
        int max_submaps = 20;
        double voxel_size = 0.2;
        bool visibility_check = true;
        bool incident_correction = true;
        double incident_threshold_deg = 60.0;
        double image_step_deg = 1.0;
        double image_step_beams = 0.75;
        double depth_channel = 0.2;
        double occupancy_threshold = 0.5;
    } back_end;

    /// What goes into the map.
    struct Output {
        bool keep_unknown = true;
    } output;
};

/// What a user is told about a setting. Bounds are inclusive; for switches and choices they are 0.
struct Setting {
    std::string_view key;     ///< "back_end.voxel_size"
    std::string_view unit;    ///< "m", "deg", "1", ...
    std::string_view symbol;  ///< the paper's symbol or section
    std::string_view help;    ///< what it does
    double min = 0.0;         ///< in `unit`
    double max = 0.0;         ///< in `unit`
};

/// Calls f(setting, member) for every field, in the order of the struct.
template <class C, class F>
void visit(C& c, F&& f) {
    f(Setting{"method", "", "Table II", "dynamic_filter, or the removert baseline"}, c.method);
    f(Setting{"submap.keyframes", "1", "n", "keyframes per submap", 1, 100000}, c.submap.keyframes);
    f(Setting{"submap.keyframe_interval", "s", "III-B",
              "a scan this long after the last keyframe becomes one", 0, 3600},
      c.submap.keyframe_interval);
    f(Setting{"submap.keyframe_distance", "m", "III-B", "... or this far from it", 0.01, 1000},
      c.submap.keyframe_distance);
    auto& front = c.front_end;
    f(Setting{"front_end.enabled", "", "Table III", "off: back-end only"}, front.enabled);
    f(Setting{"front_end.image_step_deg", "deg", "res", "least pixel of the scans' range images",
              0.05, 30},
      front.image_step_deg);
    f(Setting{"front_end.image_step_beams", "1", "res", "... and in spacings of the sensor's beams",
              0, 20},
      front.image_step_beams);
    f(Setting{"front_end.tau", "m", "III-B1",
              "a point this much nearer than the scan's range is dynamic", 0, 10},
      front.tau);
    f(Setting{"front_end.tau_per_metre", "1", "III-B1", "... plus this share of its range", 0, 1},
      front.tau_per_metre);
    f(Setting{"front_end.reverting", "", "III-B2", "map, visibility (Removert's) or none"},
      front.reverting);
    f(Setting{"front_end.revert_radius", "m", "r", "reverting looks for static neighbours within",
              0.05, 10},
      front.revert_radius);
    f(Setting{"front_end.revert_neighbors", "1", "k", "... and takes the nearest of them", 3, 100},
      front.revert_neighbors);
    f(Setting{"front_end.revert_dist_max", "1", "dist_max",
              "largest change of the normal that reverts", 0, 2},
      front.revert_dist_max);
    f(Setting{"front_end.revert_image_scale", "1", "III-B2", "pixel growth of visibility reverting",
              1, 20},
      front.revert_image_scale);
    auto& back = c.back_end;
    f(Setting{"back_end.enabled", "", "Table III", "off: front-end only"}, back.enabled);
    f(Setting{"back_end.observers", "", "III-C2",
              "scans or submaps; with scans, only voxel_size, max_scans, occupancy_threshold and "
              "submap.keyframe_* decide"},
      back.observers);
    f(Setting{"back_end.max_scans", "1", "", "keyframes that a new voxel can ask, if scans observe",
              1, 100000},
      back.max_scans);
    f(Setting{"back_end.search_radius", "m", "r",
              "submaps, or voxels of a local map, this near are consulted", 0, 1e6},
      back.search_radius);
    f(Setting{"back_end.max_submaps", "1", "B", "... at most so many, the nearest", 1, 64},
      back.max_submaps);
    f(Setting{"back_end.voxel_size", "m", "III-C1", "edge of a voxel", 0.02, 5}, back.voxel_size);
    f(Setting{"back_end.visibility_check", "", "Table III",
              "off: every nearby submap counts as having looked"},
      back.visibility_check);
    f(Setting{"back_end.incident_correction", "", "Table III", "off: no pseudo-occupied points"},
      back.incident_correction);
    f(Setting{"back_end.incident_threshold_deg", "deg", "lambda_thres",
              "beams more slanted than this are pseudo-occupied", 0, 90},
      back.incident_threshold_deg);
    f(Setting{"back_end.image_step_deg", "deg", "res", "least pixel of the submaps' images", 0.05,
              30},
      back.image_step_deg);
    f(Setting{"back_end.image_step_beams", "1", "res", "... and in spacings of the sensor's beams",
              0, 20},
      back.image_step_beams);
    f(Setting{"back_end.depth_channel", "m", "depth",
              "length of a depth channel; 0 compares ranges", 0, 10},
      back.depth_channel);
    f(Setting{"back_end.occupancy_threshold", "1", "III-C1", "voxels at or above it are static", 0,
              1},
      back.occupancy_threshold);
    f(Setting{"output.keep_unknown", "", "", "points without a verdict go into the static map"},
      c.output.keep_unknown);
}

/// The settings of a preset: "default" or "paper". Throws ConfigError naming the choices.
Config preset(std::string_view name);

/// Sets one field from text, as `--set key=value` does. Throws ConfigError: an unknown key names
/// the nearest one, a bad value says what was expected. Bounds are checked by violations().
void set(Config& config, std::string_view key, std::string_view value);

/// The value of a field as set() reads it. Throws ConfigError as set() does: an unknown key.
std::string get(const Config& config, std::string_view key);

/// One sentence per setting that is out of bounds; empty if all is well.
std::vector<std::string> violations(const Config& config);

/// Whether scans look at voxels (the default); otherwise submaps do, or nobody (no back-end).
bool scans_observe(const Config& config);

/// Throws ConfigError listing all violations.
void validate(const Config& config);

}  // namespace dynamic_filter
