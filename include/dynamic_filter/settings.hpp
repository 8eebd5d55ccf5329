// SPDX-License-Identifier: MIT
/// @file
/// All settings with their defaults, units and bounds: those that every method uses, those of the
/// odometry, which estimates poses for scans without poses and refines given poses, those of the
/// method "scans", and those of the paper's method ("submaps") and of Removert ("removert").
///
/// Keyframes are the scans that act as observers. Only keyframes are used to decide whether a place
/// is occupied or free; the points of all scans are judged.
///
/// The first setting of the method "scans" is a choice of the user. All others are constants of the
/// method. They were fitted together on simulated crowds and streets and on parts of KITTI
/// (docs/results.md lists the recordings). They are settings so that an ablation can change them,
/// and so that a run can record the values that it used.
///
/// - Units: the Setting that visit() passes with each field names its unit; bounds are in this
///   unit. Keyframes: [m], [s].
/// - Ownership: the texts of a Setting are string literals and stay valid for the whole program;
///   all else are values.
/// - Shapes: violations() returns one sentence per fault.
/// - Threads: plain data and pure functions; thread-safe.
/// - Errors: ConfigError from the functions that say so.
#pragma once

#include <concepts>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace dynamic_filter {

/// How moving objects are found. "scans" (the default): each keyframe is an observer. "submaps":
/// the submaps are the observers, as in the paper. "removert": Removert, with which the paper
/// compares (Table II); it has no back-end.
enum class Method { scans, submaps, removert };

/// What the static map holds. `always`: only what never moved. `latest`: what was in each place
/// when the place was last seen, so also objects that came or moved and then stayed.
enum class MapTime { always, latest };

/// A set of methods, with one bit per method.
constexpr unsigned methods_of(Method method) { return 1U << static_cast<unsigned>(method); }
/// The set of all methods.
constexpr unsigned kAllMethods = 7U;

/// The description of a setting for users. Bounds are inclusive; for all but numbers both are 0.
struct Setting {
    std::string_view key;            ///< path of the field in its struct, such as "map.voxel_size"
    std::string_view unit;           ///< "m", "deg", "1", ...
    std::string_view symbol;         ///< the symbol or the section of the paper
    std::string_view help;           ///< what the setting does
    double min = 0.0;                ///< in `unit`
    double max = 0.0;                ///< in `unit`
    unsigned methods = kAllMethods;  ///< the methods in which it has an effect
    /// The words of a choice, separated by blanks and in the order of the enumerators. Of a text:
    /// the texts that it may be; empty: any.
    std::string_view choices{};
    bool while_running = false;  ///< whether `live` accepts another value while it runs
};

/// When a scan becomes a keyframe (Sec. III-B): as soon as one of the two limits is reached.
struct KeyframeConfig {
    double interval = 0.25;  ///< [s] after the last keyframe
    double distance = 0.5;   ///< [m] from the last keyframe
};

/// Settings of the odometry. visit_odometry() explains each of them.
struct OdometryConfig {
    bool refine = false;
    double voxel = 0.5;
    double spacing = 0.6;
    int points = 3000;
    double nearest = 1.5;
    double farthest = 100.0;
    double speed = 40.0;
    double acceleration = 8.0;
    double angular_acceleration = 350.0;
    double lost_below = 0.35;
    double usual_share = 0.85;
    double return_over = 500.0;
};

/// Calls f(setting, member) for every field, in the order of the struct.
template <class C, class F>
void visit_odometry(C& o, F&& f) {
    const auto field = [&](const char* key, const char* unit, const char* help, double min,
                           double max, auto& member) {
        f(Setting{key, unit, "", help, min, max}, member);
    };
    field("odometry.refine", "",
          "whether given poses are refined: each is then the first guess for a registration of its "
          "scan to the map",
          0, 0, o.refine);
    field("odometry.voxel", "m",
          "edge length of the smallest voxels of the map to which scans are registered; the map "
          "also has voxels of 2, 4 and 8 times this size",
          0.05, 10, o.voxel);
    field("odometry.spacing", "m", "distance between the points of a scan that are registered",
          0.05, 10, o.spacing);
    field("odometry.points", "1", "largest number of points of a scan that are registered", 100,
          1e6, o.points);
    field("odometry.nearest", "m",
          "points nearer to the sensor are not used, because they may lie on its own vehicle", 0,
          50, o.nearest);
    field("odometry.farthest", "m", "points farther from the sensor are not used", 5, 1000,
          o.farthest);
    field("odometry.speed", "m/s",
          "largest speed of the sensor; used until its velocity is known, and to limit a search in "
          "a wide area",
          0.1, 300, o.speed);
    field("odometry.acceleration", "m/s^2",
          "typical change of the velocity of the sensor; it limits the motion in directions in "
          "which the scans do not show it",
          0.1, 1000, o.acceleration);
    field("odometry.angular_acceleration", "deg/s^2",
          "typical change of the angular velocity of the sensor", 1, 1e5, o.angular_acceleration);
    field("odometry.lost_below", "1",
          "a scan is lost if a smaller share of its points lies on the map", 0, 1, o.lost_below);
    field("odometry.usual_share", "1",
          "if the share of points on the map falls below this part of its value in the previous "
          "scans, the pose is searched for in a wide area",
          0, 1, o.usual_share);
    field("odometry.return_over", "m",
          "refined poses return to the given poses over this distance, because given poses are "
          "more accurate over long distances",
          1, 1e6, o.return_over);
}

/// Settings of the method "scans". visit_scans() explains each of them.
struct ScansConfig {
    int max_keyframes = 400;

    /// Which keyframes are used for a voxel, and how far they look.
    struct Observers {
        double near_reach = 40.0;
        int least_points = 1000;
        double images_asked = 32.0;
    } observers;

    /// When a keyframe sees a place as occupied or free; see filter/line_of_sight.hpp.
    struct Sight {
        double nearest = 0.3;
        double farthest = 80.0;
        double beside = 0.1;
        double beyond = 0.2;
        double beyond_voxels = 1.0;
        double touch = 0.15;
        double touch_voxels = 0.75;
        double surface = 0.1;
        double surface_voxels = 0.5;
        double per_metre = 0.007;
        double own_pixels = 0.55;
        double close_pixels = 0.3;
        double close_beside = 0.5;
        double same_spot = 0.02;
        double clear = 0.3;
        double clear_voxels = 1.5;
        double clear_unseen = 2.0;
        double alignment_gain = 0.15;
    } sight;

    /// Where a pane or a mirror reflects beams; see filter/mirrors.hpp.
    struct Mirrors {
        double matched = 0.8;
    } mirrors;

    /// How the counters of a voxel give its score; see filter/evidence.hpp.
    struct Evidence {
        double flicker = 0.3;
        double switch_power = 0.95;
        double occupied_power = 0.37;
        double hit_power = 0.33;
        double offset = 1.0;
        double thin_flicker = 0.6;
        double thin_offset = 2.0;
        double thin_benefit = 0.3;
        double gain = 2.8;
        double enough = 40.0;
        int longest_run = 16;
        double static_limit = 1.8;
    } evidence;

    /// Weights of neighboring voxels; see filter/vote.hpp.
    struct Vote {
        double company = 1.25;
        double neighborhood = 1.75;
        double far = 0.5;
        double sure = 8.0;
        double alone = 0.2;
        double steepness = 3.0;
        double ask_again = 0.2;
    } vote;

    /// Clusters of a scan and their tracks over time; see filter/clusters.hpp and
    /// filter/objects.hpp.
    struct Instances {
        double every = 0.04;
        double reach = 60.0;
        double cell = 0.3;
        double ground_cell = 1.2;
        double ground = 0.25;
        double top = 3.0;
        double largest = 20.0;
        int fewest = 3;
        double overlap = 0.2;
        double jump = 0.8;
        double jump_share = 0.25;
        double growth = 3.0;
        double lost = 1.5;
        double dynamic_share = 0.6;
        int dynamic_scans = 3;
        double gone = 0.5;
        double displaced = 0.3;
        double arrived_share = 0.45;
        int arrived_scans = 6;
        double share = 0.7;
    } instances;

    /// Points of moving objects on a static surface, such as feet on the ground; see
    /// filter/contact.hpp.
    struct Contact {
        int fewest = 6;
        double flat = 0.04;
        double above = 0.03;
        double outlier = 0.05;
        double lowest = 0.03;
        double height = 0.02;
        double roughness = 3.0;
    } contact;
};

/// Calls f(setting, member) for every field, in the order of the struct.
template <class C, class F>
void visit_scans(C& scans, F&& f) {
    const auto field = [&](const char* key, const char* unit, const char* help, double min,
                           double max, auto& member) {
        f(Setting{key, unit, "", help, min, max, methods_of(Method::scans)}, member);
    };
    field("scans.max_keyframes", "1",
          "number of newest keyframes that are kept to observe new voxels; determines the memory",
          1, 100000, scans.max_keyframes);

    auto& o = scans.observers;
    field("scans.observers.near_reach", "m",
          "largest range of a keyframe that follows the previous one only because the sensor "
          "moved: distant places look the same from both",
          1, 1000, o.near_reach);
    field("scans.observers.least_points", "1",
          "the angle between beams is measured only on scans with at least this number of points",
          1, 1e6, o.least_points);
    field("scans.observers.images_asked", "1",
          "number of newest full images that all observe a new voxel; of older images only every "
          "second, every fourth and so on is used, because neighbors in time see the same",
          1, 1e6, o.images_asked);

    auto& s = scans.sight;
    field("scans.sight.nearest", "m",
          "places nearer to the sensor are not judged, because they may lie in its own vehicle", 0,
          100, s.nearest);
    field(
        "scans.sight.farthest", "m",
        "places farther from the sensor are not judged, because the beams are too far apart there",
        1, 1000, s.farthest);
    field("scans.sight.beside", "m",
          "all beams within this distance of a place must go on behind it before it counts as "
          "free, because poses are not exact",
          0, 10, s.beside);
    field("scans.sight.beyond", "m",
          "one beam must go on by at least this much behind a place before it counts as free", 0,
          10, s.beyond);
    field("scans.sight.beyond_voxels", "1",
          "lower limit of scans.sight.beyond as a multiple of the voxel size, because a point may "
          "lie anywhere in its voxel",
          0, 10, s.beyond_voxels);
    field("scans.sight.touch", "m",
          "a place is occupied if a return lies within this distance of it, which allows for range "
          "noise and pose errors",
          0, 10, s.touch);
    field("scans.sight.touch_voxels", "1",
          "lower limit of scans.sight.touch as a multiple of the voxel size", 0, 10,
          s.touch_voxels);
    field("scans.sight.surface", "m",
          "a place is also occupied if a surface between neighboring returns lies within this "
          "distance of it",
          0, 10, s.surface);
    field("scans.sight.surface_voxels", "1",
          "lower limit of scans.sight.surface as a multiple of the voxel size", 0, 10,
          s.surface_voxels);
    field("scans.sight.per_metre", "1",
          "increase of touch and surface per metre of range; allows for 0.4 deg of error in the "
          "rotation of the pose",
          0, 1, s.per_metre);
    field("scans.sight.own_pixels", "1",
          "a return within this many pixels of a place belongs to the place: half a pixel, plus a "
          "little for rounding",
          0.5, 1, s.own_pixels);
    field("scans.sight.close_pixels", "1",
          "where beams exist only above or only below a place, one of them must pass within this "
          "many pixels of it",
          0, 1, s.close_pixels);
    field("scans.sight.close_beside", "1",
          "lower limit of this distance as a share of scans.sight.beside", 0, 1, s.close_beside);
    field("scans.sight.same_spot", "m",
          "two returns nearer to each other than this do not define a line", 0, 1, s.same_spot);
    field("scans.sight.clear", "m",
          "a place is surely free if beams on all four sides of it go on by this much, otherwise "
          "weakly: just in front of a surface, noise and pose errors decide",
          0, 10, s.clear);
    field("scans.sight.clear_voxels", "1",
          "lower limit of scans.sight.clear as a multiple of the voxel size", 0, 10,
          s.clear_voxels);
    field("scans.sight.clear_unseen", "m",
          "where a side of the place has no beam, the existing beams must go on by this much for a "
          "sure observation: at the upper border of the image, a ceiling looks free from far away",
          0, 100, s.clear_unseen);
    field("scans.sight.alignment_gain", "1",
          "a scan is moved onto the surfaces of an earlier keyframe before places are compared, if "
          "that lowers their misfit by at least this share: poses of GPS drift by decimeters; 1 "
          "turns this off",
          0, 1, s.alignment_gain);

    field("scans.mirrors.matched", "1",
          "a pane reflects where at least this share of what is seen behind it has its like in "
          "front of it, as far behind as before; 1 turns this off",
          0, 1, scans.mirrors.matched);

    auto& e = scans.evidence;
    field("scans.evidence.flicker", "1",
          "factor of the expected number of free observations of a static voxel, which is seen "
          "through between the returns of an edge or a leaf; see evidence.hpp",
          0, 10, e.flicker);
    field("scans.evidence.switch_power", "1",
          "exponent of the number of changes between occupied and free in this expectation; edges "
          "and leaves change often, places that are crossed change rarely",
          0, 2, e.switch_power);
    field("scans.evidence.occupied_power", "1",
          "exponent of the number of occupied observations in this expectation; static voxels have "
          "many",
          0, 2, e.occupied_power);
    field("scans.evidence.hit_power", "1",
          "exponent of the number of keyframes with a point in the voxel itself, and not only near "
          "it, in this expectation",
          0, 2, e.hit_power);
    field("scans.evidence.offset", "1",
          "number of observations added to the observed and to the expected number, so that a "
          "single observation does not decide",
          0.01, 100, e.offset);
    field("scans.evidence.thin_flicker", "1",
          "the same as flicker for keyframes with a beam through the voxel itself: thin objects "
          "lie between the beams of all other keyframes and look free to them",
          0, 10, e.thin_flicker);
    field("scans.evidence.thin_offset", "1",
          "the same as offset for keyframes with a beam through the voxel itself", 0.01, 100,
          e.thin_offset);
    field("scans.evidence.thin_benefit", "1",
          "added to the natural logarithm of their ratio, in favor of dynamic, because most "
          "objects are not thin",
          0, 10, e.thin_benefit);
    field("scans.evidence.gain", "1",
          "score per natural logarithm of the ratio between observed and expected number", 0.01,
          100, e.gain);
    field("scans.evidence.enough", "1",
          "if there are more observations, all counters are scaled down to this number, so that a "
          "place does not become static only because the recording is long",
          8, 1e9, e.enough);
    field("scans.evidence.longest_run", "1",
          "number of keyframes of an occupied run that count, because a longer rest does not show "
          "that an object is static",
          1, 255, e.longest_run);
    field("scans.evidence.static_limit", "1",
          "lowest score of a static voxel is minus this (the highest score of any voxel is 1), so "
          "that neighbors cannot outvote a voxel that is surely static",
          1, 10, e.static_limit);

    auto& v = scans.vote;
    field("scans.vote.company", "1",
          "weight of the neighbors that had points at the same time, because the parts of an "
          "object appear and disappear together",
          0, 10, v.company);
    field("scans.vote.neighborhood", "1",
          "weight of all neighbors, because surfaces continue and people walk where others walked",
          0, 10, v.neighborhood);
    field("scans.vote.far", "1", "weight of a neighbor that does not touch the voxel", 0, 1, v.far);
    field("scans.vote.sure", "1",
          "number of scans with a point in a voxel, or of keyframes that saw through it, at which "
          "the voxel has half of its full weight as a neighbor",
          0, 1000, v.sure);
    field("scans.vote.alone", "1",
          "weight of having no neighbor, so that few neighbors do not outvote a voxel", 0.01, 10,
          v.alone);
    field("scans.vote.steepness", "1", "log-odds of being dynamic per unit of the sum of scores",
          0.1, 100, v.steepness);
    field("scans.vote.ask_again", "1",
          "an instant verdict is computed again when the score of the voxel has changed by more "
          "than this, a tenth of the range of scores",
          0, 2, v.ask_again);

    auto& i = scans.instances;
    field("scans.instances.every", "s",
          "smallest time between scans in which clusters are searched for", 0.01, 10, i.every);
    field("scans.instances.reach", "m",
          "clusters are searched for within this distance of the sensor; farther points are too "
          "far apart",
          1, 150, i.reach);
    field("scans.instances.cell", "m",
          "points in cells of this size that touch each other, seen from above, belong to one "
          "cluster",
          0.1, 5, i.cell);
    field("scans.instances.ground_cell", "m",
          "the height of the ground in a cell of this size is that of the lowest point in the cell "
          "or in its neighbors",
          0.1, 20, i.ground_cell);
    field("scans.instances.ground", "m",
          "points less than this above the ground are left out, because the ground would connect "
          "all clusters",
          0, 10, i.ground);
    field("scans.instances.top", "m",
          "points more than this above the ground are left out, such as canopies and ceilings", 0.1,
          100, i.top);
    field("scans.instances.largest", "m",
          "a longer group of points is no cluster, such as walls and hedges", 0.5, 1000, i.largest);
    field("scans.instances.fewest", "1", "smallest number of voxels of a cluster that is tracked",
          1, 1000, i.fewest);
    field("scans.instances.overlap", "1",
          "a cluster continues a track only if at least this share of its voxels lies in blocks of "
          "voxels where the track was",
          0.01, 1, i.overlap);
    field("scans.instances.jump", "m",
          "a cluster continues a track only if its center lies within this distance of the last or "
          "the predicted center of the track, because two objects that touch form one cluster for "
          "a while",
          0.05, 100, i.jump);
    field("scans.instances.jump_share", "1",
          "or within this share of the length of the shorter of both, because the center of a long "
          "object moves when more of it comes into view",
          0, 1, i.jump_share);
    field("scans.instances.growth", "1",
          "a cluster continues a track only if it is less than this many times larger or smaller",
          1, 100, i.growth);
    field("scans.instances.lost", "s", "a track ends if it was not seen for this time", 0.1, 100,
          i.lost);
    field("scans.instances.dynamic_share", "1",
          "a cluster is dynamic if this share of its voxels is dynamic in instant verdicts", 0.01,
          1, i.dynamic_share);
    field("scans.instances.dynamic_scans", "1",
          "a track moves if its clusters were dynamic in at least this number of scans, because "
          "one scan is little evidence",
          1, 1000, i.dynamic_scans);
    field("scans.instances.gone", "m",
          "a track moves only if it has gone at least this far; leaves stay in their place", 0,
          1000, i.gone);
    field("scans.instances.displaced", "m",
          "a track also moves once its surface has moved at least this far by a steady motion, "
          "however slow; several times what the poses and the scatter of its points explain",
          0.02, 1000, i.displaced);
    field("scans.instances.arrived_share", "1",
          "a scan shows that an object came to where it is if at least this share of the voxels of "
          "its cluster, and the square root of their number more, is dynamic, or was seen free "
          "first and occupied since; from half of this share on, the scan counts in part",
          0.01, 1, i.arrived_share);
    field(
        "scans.instances.arrived_scans", "1",
        "a track is that of an object that came if it shows this in at least this number of scans",
        1, 1000, i.arrived_scans);
    field("scans.instances.share", "1",
          "a voxel is dynamic if its points belonged to moving tracks in at least this share of "
          "the scans with points in it",
          0.5, 1, i.share);

    auto& c = scans.contact;
    field("scans.contact.fewest", "1", "smallest number of static voxels that define a surface", 3,
          100, c.fewest);
    field("scans.contact.flat", "m",
          "largest root mean square distance of these voxels from the surface, which allows for "
          "range noise",
          0, 1, c.flat);
    field(
        "scans.contact.above", "m",
        "a static voxel more than this above the surface does not belong to it: it may hold a foot "
        "that was not found",
        0, 1, c.above);
    field("scans.contact.outlier", "m",
          "a static voxel more than this below the surface does not belong to it", 0, 1, c.outlier);
    field("scans.contact.lowest", "m",
          "dynamic voxels must rise above the surface by at least this; otherwise they are the "
          "surface itself",
          0, 1, c.lowest);
    field("scans.contact.height", "m",
          "a point more than this above the surface belongs to a moving object; on the ground, "
          "range noise shifts a point much more along the surface than across it",
          0, 1, c.height);
    field("scans.contact.roughness", "1",
          "a point must also be this many times higher than the root mean square distance of the "
          "voxels from the surface, because poses are not exact",
          0, 100, c.roughness);
}

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
    f(Setting{"front_end.reverting", "", "III-B2",
              "how removed points are reverted to static: map, visibility (as Removert does) or "
              "none",
              0, 0, kPaper, "map visibility none"},
      front.reverting);
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

/// Settings of the static map: the size of its voxels, and which voxels are static.
struct MapConfig {
    double voxel_size = 0.2;
    double occupancy_threshold = 0.5;
    double search_radius = 20.0;
    bool keep_unknown = true;
    bool probability = false;
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
requires std::same_as<std::remove_const_t<C>, Config>
void visit(C& c, F&& f) {
    f(Setting{"method", "", "Table II",
              "how moving objects are found: scans (each keyframe is an observer), submaps (the "
              "paper's method) or removert (the method with which the paper compares)",
              0, 0, kAllMethods, "scans submaps removert"},
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
    f(
        Setting{
            "map.probability", "", "",
            "whether the points of static_map.pcd and dynamic_points.pcd get a field probability: "
            "that their voxel is occupied, 0..1; the voxels of a map of several drives always "
            "have it"},
        c.map.probability);
    f(Setting{"map.time", "", "",
              "what the static map holds: only what never moved (always), or what was in each "
              "place when the place was last seen, so also objects that came and stayed (latest); "
              "labels are the same for both",
              0, 0, methods_of(Method::scans), "always latest"},
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
/// (the message names the most similar key), or if the value cannot be read or is out of bounds
/// (the message says what was expected).
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
