// SPDX-License-Identifier: MIT
/// @file
/// All constants of the method "scans" with default, unit, bounds, meaning and reason.
///
/// The first one is a choice of the user. All others are constants of the method. They were fitted
/// together on simulated crowds and streets and on parts of KITTI (docs/results.md lists the
/// recordings). They are settings so that an ablation can change them, and so that a run can record
/// the values that it used.
///
/// - Units: visit_scans() names the unit of each field.
/// - Ownership: values.
/// - Threads: plain data.
/// - Errors: none.
#pragma once

#include "dynamic_filter/setting.hpp"

namespace dynamic_filter {

/// Settings of the method "scans". visit_scans() explains each of them.
struct ScansConfig {
    int max_keyframes = 400;

    /// Which keyframes are used for a voxel, and how far they look.
    struct Observers {
        double near_reach = 40.0;
        int least_points = 1000;
        double images_asked = 32.0;
    } observers;

    /// When a keyframe sees a place as occupied or free; see line_of_sight.hpp.
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
    } sight;

    /// How the counters of a voxel give its score; see evidence.hpp.
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

    /// Weights of neighboring voxels; see vote.hpp.
    struct Vote {
        double company = 1.25;
        double neighborhood = 1.75;
        double far = 0.5;
        double sure = 8.0;
        double alone = 0.2;
        double steepness = 3.0;
        double ask_again = 0.2;
    } vote;

    /// Clusters of a scan and their tracks over time; see clusters.hpp and instances.hpp.
    struct Instances {
        double every = 0.15;
        double reach = 60.0;
        double cell = 0.3;
        double ground_cell = 1.2;
        double ground = 0.25;
        double top = 3.0;
        double largest = 12.0;
        int fewest = 3;
        double overlap = 0.2;
        double jump = 0.8;
        double growth = 3.0;
        double lost = 1.5;
        double dynamic_share = 0.6;
        int dynamic_scans = 3;
        double gone = 0.5;
        double share = 0.7;
    } instances;

    /// Points of moving objects on a static surface, such as feet on the ground; see contact.hpp.
    struct Contact {
        int fewest = 6;
        double flat = 0.04;
        double outlier = 0.05;
        double lowest = 0.03;
        double height = 0.02;
        double roughness = 2.0;
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
          "a track moves only if it has gone at least this far; leaves stay in their place", 0, 100,
          i.gone);
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
    field("scans.contact.outlier", "m",
          "a static voxel farther than this from the surface does not belong to it", 0, 1,
          c.outlier);
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

}  // namespace dynamic_filter
