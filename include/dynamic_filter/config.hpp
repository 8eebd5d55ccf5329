// SPDX-License-Identifier: MIT
/// @file
/// Every setting, its default, unit and bounds: those of all methods here, those of each method
/// beside it.
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

#include "dynamic_filter/keyframe.hpp"
#include "dynamic_filter/odometry/config.hpp"
#include "dynamic_filter/scans_observe/config.hpp"
#include "dynamic_filter/setting.hpp"
#include "dynamic_filter/submaps_observe/config.hpp"

namespace dynamic_filter {

/// What comes out: voxels, and what counts as static.
struct MapConfig {
    double voxel_size = 0.2;
    double occupancy_threshold = 0.5;
    double search_radius = 20.0;
    bool keep_unknown = true;
    MapTime time = MapTime::always;  ///< of the method "scans"
};

/// All settings, with the defaults of the preset "default". What each means: visit(). A setting of
/// a method that is not `method` must keep its default.
struct Config {
    Method method = Method::scans;
    MapConfig map;
    OdometryConfig odometry;
    KeyframeConfig keyframe;
    ScansConfig scans;         ///< of the method "scans"
    SubmapConfig submap;       ///< of the method "submaps"
    FrontEndConfig front_end;  ///< of the methods "submaps" and "removert"
    BackEndConfig back_end;    ///< of the method "submaps"
};

/// Calls f(setting, member) for every field, in the order of the struct.
template <class C, class F>
void visit(C& c, F&& f) {
    f(
        Setting{
            "method", "", "Table II",
            "scans (each scan observes), submaps (the paper's) or removert (the paper's opponent)"},
        c.method);
    f(Setting{"map.voxel_size", "m", "III-C1", "edge of a voxel", 0.02, 5}, c.map.voxel_size);
    f(Setting{"map.occupancy_threshold", "1", "III-C1", "voxels at or above it are static", 0, 1},
      c.map.occupancy_threshold);
    f(Setting{"map.search_radius", "m", "r",
              "a local map is made of voxels, or of submaps, this near to its pose", 0, 1e6},
      c.map.search_radius);
    f(Setting{"map.keep_unknown", "", "", "points without a verdict go into the static map"},
      c.map.keep_unknown);
    f(
        Setting{
            "map.time", "", "",
            "the static map holds what never moved (always), or what was there when its place was "
            "last seen (latest), also if it came; labels are the same",
            0, 0, methods_of(Method::scans)},
        c.map.time);
    visit_odometry(c.odometry, f);
    f(Setting{"keyframe.interval", "s", "III-B",
              "a scan this long after the last keyframe becomes one", 0, 3600},
      c.keyframe.interval);
    f(Setting{"keyframe.distance", "m", "III-B", "... or this far from it", 0.01, 1000},
      c.keyframe.distance);
    visit_scans(c.scans, f);
    visit_submaps(c, f);
}

/// The settings of a preset: "default" or "paper". Throws ConfigError naming the choices.
Config preset(std::string_view name);

/// Sets one field from text, as `--set key=value` does. Throws ConfigError: an unknown key names
/// the nearest one, a bad value says what was expected. Bounds are checked by violations().
void set(Config& config, std::string_view key, std::string_view value);

/// The value of a field as set() reads it. Throws ConfigError as set() does: an unknown key.
std::string get(const Config& config, std::string_view key);

/// Whether the setting has an effect with the method of `config`.
bool in_force(const Config& config, const Setting& setting);

/// Throws ConfigError if the setting `key` has no effect with the method of `config`, naming the
/// method it belongs to; and as set() does: an unknown key.
void require_in_force(const Config& config, std::string_view key);

/// One sentence per setting that is out of bounds, or that was changed although it belongs to
/// another method; empty if all is well.
std::vector<std::string> violations(const Config& config);

/// Throws ConfigError listing all violations.
void validate(const Config& config);

}  // namespace dynamic_filter
