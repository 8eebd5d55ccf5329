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
    field("scans.max_keyframes", "1", "keyframes that a new voxel can ask: memory", 1, 100000,
          scans.max_keyframes);

    auto& o = scans.observers;
    field(
        "scans.observers.near_reach", "m",
        "a keyframe that is one because the sensor moved sees what is far as the last one did, so "
        "it looks no farther than this",
        1, 1000, o.near_reach);
    field("scans.observers.least_points", "1",
          "a scan of fewer points does not tell how densely the sensor looks", 1, 1e6,
          o.least_points);
    field("scans.observers.images_asked", "1",
          "full images that a new voxel asks one by one; of older ones it asks every second, every "
          "fourth ..., as neighbours in time see the same",
          1, 1e6, o.images_asked);

    auto& s = scans.sight;
    field("scans.sight.nearest", "m",
          "no judgement on places nearer to the sensor: its own vehicle", 0, 100, s.nearest);
    field("scans.sight.farthest", "m", "... or farther from it: beams lie too far apart", 1, 1000,
          s.farthest);
    field("scans.sight.beside", "m",
          "beams this near the place must all go on before it counts as free: poses are not exact",
          0, 10, s.beside);
    field("scans.sight.beyond", "m", "... and one of them this much farther than the place", 0, 10,
          s.beyond);
    field("scans.sight.beyond_voxels", "1",
          "... or this many voxels, if that is more: a point may lie anywhere in its voxel", 0, 10,
          s.beyond_voxels);
    field("scans.sight.touch", "m",
          "a return this near the place occupies it: range noise and poses", 0, 10, s.touch);
    field("scans.sight.touch_voxels", "1", "... or this many voxels, if that is more", 0, 10,
          s.touch_voxels);
    field("scans.sight.surface", "m",
          "and so does a surface between neighbouring returns that runs this near", 0, 10,
          s.surface);
    field("scans.sight.surface_voxels", "1", "... or this many voxels, if that is more", 0, 10,
          s.surface_voxels);
    field("scans.sight.per_metre", "1",
          "growth of touch and surface with range: 0.4 deg of error in the pose's rotation", 0, 1,
          s.per_metre);
    field("scans.sight.own_pixels", "1",
          "a return within this many pixels of the place is the place's own: half a pixel, and a "
          "little for rounding",
          0.5, 1, s.own_pixels);
    field("scans.sight.close_pixels", "1",
          "where beams exist only above or only below the place, one must pass within this many "
          "pixels of it",
          0, 1, s.close_pixels);
    field("scans.sight.close_beside", "1", "... or this share of `beside`, if that is more", 0, 1,
          s.close_beside);
    field("scans.sight.same_spot", "m", "two returns nearer than this to each other make no line",
          0, 1, s.same_spot);
    field("scans.sight.clear", "m",
          "a place is surely free if beams on all four sides of it go on by this much, and else "
          "weakly: just in front of a surface, noise and poses decide",
          0, 10, s.clear);
    field("scans.sight.clear_voxels", "1", "... or this many voxels, if that is more", 0, 10,
          s.clear_voxels);
    field("scans.sight.clear_unseen", "m",
          "where there is no beam on some side, those that there are must go on by this much: at "
          "the upper border of the image, a ceiling looks free from far away",
          0, 100, s.clear_unseen);

    auto& e = scans.evidence;
    field("scans.evidence.flicker", "1",
          "how often a static voxel is seen through, between the returns of an edge or a leaf: see "
          "evidence.hpp",
          0, 10, e.flicker);
    field("scans.evidence.switch_power", "1",
          "... by changes between occupied and free, which flicker makes and crossings do not", 0,
          2, e.switch_power);
    field("scans.evidence.occupied_power", "1",
          "... by how often it was seen occupied, as static voxels are", 0, 2, e.occupied_power);
    field("scans.evidence.hit_power", "1",
          "... by how often a point lay in it then, and not only near it", 0, 2, e.hit_power);
    field("scans.evidence.offset", "1",
          "observations added to both sides, so that one more or less is not everything", 0.01, 100,
          e.offset);
    field("scans.evidence.thin_flicker", "1",
          "as flicker, of the keyframes with a beam through the voxel itself: what is thin lies "
          "between the beams of all others, and looks free to them",
          0, 10, e.thin_flicker);
    field("scans.evidence.thin_offset", "1", "as offset, of those keyframes", 0.01, 100,
          e.thin_offset);
    field("scans.evidence.thin_benefit", "1",
          "natural logarithm in favour of what moves, of those keyframes: most things are not thin",
          0, 10, e.thin_benefit);
    field("scans.evidence.gain", "1", "score per natural logarithm of the ratio of both sides",
          0.01, 100, e.gain);
    field("scans.evidence.enough", "1",
          "more observations than this tell no more than so many in the same proportions: a place "
          "does not become static because the recording goes on",
          8, 1e9, e.enough);
    field(
        "scans.evidence.longest_run", "1",
        "keyframes of an occupied run that count: how long a thing rests does not tell whether it "
        "is static",
        1, 255, e.longest_run);
    field(
        "scans.evidence.static_limit", "1",
        "how far below 0 the score of a static voxel may go; above 0 it ends at 1: neighbours may "
        "outvote any voxel but one that is surely static",
        1, 10, e.static_limit);

    auto& v = scans.vote;
    field("scans.vote.company", "1",
          "weight of neighbours that were there at the same time: things come and go as a whole", 0,
          10, v.company);
    field("scans.vote.neighborhood", "1",
          "weight of all neighbours: surfaces go on, and people walk where others did", 0, 10,
          v.neighborhood);
    field("scans.vote.far", "1", "weight of a neighbour that does not touch the voxel", 0, 1,
          v.far);
    field(
        "scans.vote.sure", "1",
        "scans with a point in the voxel, or keyframes that saw through it, after which its voice "
        "has half its weight: what was hardly looked at has little to say",
        0, 1000, v.sure);
    field("scans.vote.alone", "1", "weight of having no neighbour: a lone voxel is not outvoted",
          0.01, 10, v.alone);
    field("scans.vote.steepness", "1", "log-odds of being dynamic per unit of the sum", 0.1, 100,
          v.steepness);
    field("scans.vote.ask_again", "1",
          "an instant verdict is made anew when the voxel's score has changed by more: a tenth of "
          "its range",
          0, 2, v.ask_again);

    auto& i = scans.instances;
    field("scans.instances.every", "s",
          "clusters are sought in a scan if so much time has passed since the last: things overlap "
          "where they were then",
          0.01, 10, i.every);
    field("scans.instances.reach", "m",
          "... as far as this from the sensor: beyond, points lie too far apart", 1, 150, i.reach);
    field("scans.instances.cell", "m",
          "seen from above, points in cells of this size that touch each other are one cluster",
          0.1, 5, i.cell);
    field("scans.instances.ground_cell", "m",
          "the ground of a cell of this size is the lowest point in it or beside it", 0.1, 20,
          i.ground_cell);
    field("scans.instances.ground", "m",
          "points less high over the ground are left out, or it would connect everything", 0, 10,
          i.ground);
    field("scans.instances.top", "m",
          "... and so are points higher than this: a canopy or a ceiling", 0.1, 100, i.top);
    field("scans.instances.largest", "m", "what is longer is no cluster: walls, hedges", 0.5, 1000,
          i.largest);
    field("scans.instances.fewest", "1", "voxels of a cluster that is followed", 1, 1000, i.fewest);
    field("scans.instances.overlap", "1",
          "share of a cluster's voxels in blocks of voxels where its track was, at least", 0.01, 1,
          i.overlap);
    field("scans.instances.jump", "m",
          "a cluster is not its track if its middle is farther from where that was or would be by "
          "now: two things that touch are one cluster for a while",
          0.05, 100, i.jump);
    field("scans.instances.growth", "1", "... nor if it is so many times larger or smaller", 1, 100,
          i.growth);
    field("scans.instances.lost", "s", "a track that was not seen for so long is lost", 0.1, 100,
          i.lost);
    field("scans.instances.dynamic_share", "1",
          "a cluster is dynamic if this share of its voxels is, by instant verdicts", 0.01, 1,
          i.dynamic_share);
    field("scans.instances.dynamic_scans", "1",
          "a track moves if it was dynamic in so many scans: in one, evidence is thin", 1, 1000,
          i.dynamic_scans);
    field("scans.instances.gone", "m", "... and has gone this far: leaves stay where they are", 0,
          100, i.gone);
    field("scans.instances.share", "1",
          "a voxel is dynamic if its points were part of what moves in this share of its scans",
          0.5, 1, i.share);

    auto& c = scans.contact;
    field("scans.contact.fewest", "1", "static voxels that make a surface", 3, 100, c.fewest);
    field("scans.contact.flat", "m", "most that they may be off it, root mean square: range noise",
          0, 1, c.flat);
    field("scans.contact.outlier", "m", "a static voxel this far off it belongs to something else",
          0, 1, c.outlier);
    field("scans.contact.lowest", "m",
          "something that moves on a surface rises over it by this much, or it is the surface", 0,
          1, c.lowest);
    field("scans.contact.height", "m",
          "a point this high over the surface belongs to what moves: on ground, range noise shifts "
          "a point along it far more than across",
          0, 1, c.height);
    field("scans.contact.roughness", "1",
          "... if that is also this many times what the surface's own voxels are off it: poses are "
          "not exact",
          0, 100, c.roughness);
}

}  // namespace dynamic_filter
