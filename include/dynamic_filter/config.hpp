// SPDX-License-Identifier: MIT
/// @file
/// All settings with their defaults, units and bounds. This file holds the settings that every
/// method uses; the settings of one method are in the folder of that method.
///
/// - Units: the Setting that visit() passes with each field names its unit.
/// - Ownership: the texts of a Setting are string literals and stay valid for the whole program.
/// - Shapes: violations() returns one sentence per fault.
/// - Threads: plain data and pure functions; thread-safe.
/// - Errors: ConfigError from the functions that say so.
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

/// Settings of the static map: the size of its voxels, and which voxels are static.
struct MapConfig {
    double voxel_size = 0.2;
    double occupancy_threshold = 0.5;
    double search_radius = 20.0;
    bool keep_unknown = true;
    MapTime time = MapTime::always;  ///< used by the method "scans" only
};

/// All settings, with the defaults of the preset "default". visit() explains each of them. A
/// setting that belongs to another method than `method` must keep its default.
struct Config {
    Method method = Method::scans;
    MapConfig map;
    OdometryConfig odometry;
    KeyframeConfig keyframe;
    ScansConfig scans;         ///< used by the method "scans"
    SubmapConfig submap;       ///< used by the method "submaps"
    FrontEndConfig front_end;  ///< used by the methods "submaps" and "removert"
    BackEndConfig back_end;    ///< used by the method "submaps"
};

/// Calls f(setting, member) for every field, in the order of the struct.
template <class C, class F>
void visit(C& c, F&& f) {
    f(Setting{"method", "", "Table II",
              "how moving objects are found: scans (each keyframe is an observer), submaps (the "
              "paper's method) or removert (the method with which the paper compares)"},
      c.method);
    f(Setting{"map.voxel_size", "m", "III-C1", "edge length of a voxel", 0.02, 5},
      c.map.voxel_size);
    f(Setting{"map.occupancy_threshold", "1", "III-C1",
              "a voxel is static if its occupancy is at least this", 0, 1},
      c.map.occupancy_threshold);
    f(Setting{"map.search_radius", "m", "r",
              "a local map consists of the voxels, or of the submaps, within this distance of its "
              "pose",
              0, 1e6},
      c.map.search_radius);
    f(Setting{"map.keep_unknown", "", "",
              "whether points without a verdict go into the static map"},
      c.map.keep_unknown);
    f(Setting{"map.time", "", "",
              "what the static map holds: only what never moved (always), or what was in each "
              "place when the place was last seen, so also objects that came and stayed (latest); "
              "labels are the same for both",
              0, 0, methods_of(Method::scans)},
      c.map.time);
    visit_odometry(c.odometry, f);
    f(Setting{"keyframe.interval", "s", "III-B",
              "a scan becomes a keyframe if it is at least this much later than the last keyframe",
              0, 3600},
      c.keyframe.interval);
    f(Setting{"keyframe.distance", "m", "III-B",
              "a scan also becomes a keyframe if it is at least this far from the last keyframe",
              0.01, 1000},
      c.keyframe.distance);
    visit_scans(c.scans, f);
    visit_submaps(c, f);
}

/// Returns the settings of a preset: "default" or "paper". Throws ConfigError for any other name;
/// the message lists the presets.
Config preset(std::string_view name);

/// Sets one field from text, as `--set key=value` does. Throws ConfigError if the key is unknown
/// (the message names the most similar key) or if the value cannot be read (the message says what
/// was expected). This function does not check bounds; violations() does.
void set(Config& config, std::string_view key, std::string_view value);

/// Returns the value of a field as text that set() can read. Throws ConfigError if the key is
/// unknown.
std::string get(const Config& config, std::string_view key);

/// True if the setting has an effect with the method of `config`.
bool in_force(const Config& config, const Setting& setting);

/// Throws ConfigError if the setting `key` has no effect with the method of `config`; the message
/// names the method that uses the setting. Also throws ConfigError if the key is unknown.
void require_in_force(const Config& config, std::string_view key);

/// Returns one sentence for each setting that is out of bounds, or that was changed although it
/// belongs to another method. The list is empty if all settings are valid.
std::vector<std::string> violations(const Config& config);

/// Throws ConfigError that lists all violations().
void validate(const Config& config);

}  // namespace dynamic_filter
