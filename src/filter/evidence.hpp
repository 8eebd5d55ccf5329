// SPDX-License-Identifier: MIT
/// What the keyframes observed of a voxel, and the score that follows from it (Sec. III-C1).
#pragma once

#include <cstdint>
#include <vector>

#include "dynamic_filter/settings.hpp"
#include "filter/sight.hpp"

namespace dynamic_filter {

/// Weight of a weak and of a sure observation: a weak one counts an eighth.
inline constexpr unsigned kWeak = 1, kSure = 8;

/// Counters of one voxel. All counters are halved before one of them overflows.
struct Evidence {
    std::uint16_t n_own = 0;   ///< scans with a point in the voxel
    std::uint16_t n_occ = 0;   ///< keyframes that saw it occupied
    std::uint16_t n_free = 0;  ///< keyframes that saw through it
    /// Changes between occupied and free, in the order of the keyframes.
    std::uint16_t n_switch = 0;
    /// As n_occ, but weighted, and only the first keyframes of each occupied run.
    std::uint16_t occupied = 0;
    std::uint16_t free = 0;  ///< as n_free, but weighted
    /// As n_occ, but only keyframes of `occupied` with a point in the voxel.
    std::uint16_t hits = 0;
    /// As n_free, but only keyframes with a beam through the voxel itself.
    std::uint16_t passes = 0;
    std::uint16_t n_flicker = 0;       ///< changes between hits and passes
    std::uint16_t moved = 0;           ///< scans in which its points belonged to a moving object
    std::uint8_t run = 0;              ///< counted keyframes of the present run, occupied or free
    Sight last = Sight::unknown;       ///< latest observation: occupied or free
    Sight last_near = Sight::unknown;  ///< latest hit (occupied) or pass (free)
    bool seen_empty = false;           ///< true if it was surely free since its latest point
    std::uint32_t since = 0;           ///< first scan with a point in it after it was seen empty
    std::uint32_t first_owner = 0;     ///< first scan with a point in it, in the order of the scans
    std::uint32_t last_owner = 0;      ///< last scan with a point in it, in the order of the scans
};

/// What a keyframe observed of a voxel. It counts as if `weight` similar keyframes had observed the
/// same. `hit`: the scan of the keyframe has a point in the voxel.
struct Observation {
    Sight sight = Sight::unknown;
    unsigned weight = 1;
    bool hit = false;
};

/// Adds the observation of the next keyframe. An *occupied run* lasts from the first keyframe that
/// sees the voxel occupied until one sees it free. Only the first `longest_run` keyframes of a run
/// (at most 255) are counted, because a longer rest does not tell whether the object is static.
/// Returns false if the score cannot have changed.
bool record(Evidence& evidence, const Observation& observation, unsigned longest_run);

/// The evidence as if no keyframe had observed the voxel yet, and nothing had moved there: what
/// moved was found by what keyframes observed.
Evidence without_observations(const Evidence& evidence);

/// Records that a scan has a point in the voxel; `scan` counts in the order of the scans. Call it
/// once per scan.
void record_owner(Evidence& evidence, std::uint32_t scan);

/// Records that in `scans` scans the points in the voxel belonged to a moving object.
void record_moved(Evidence& evidence, unsigned scans);

/// True if no keyframe saw through the voxel and at most one saw it occupied: that one may be the
/// scan that found the voxel.
inline bool is_unknown(const Evidence& e) { return e.n_occ < 2 && e.n_free == 0; }

/// Score of a voxel, from -static_limit to 1. Above 0, the voxel was mostly empty and something
/// crossed it; below 0, it is static. A porous surface, an edge or a leaf is sometimes seen
/// through, between two returns; where something came or went, the voxel is free in few long runs.
/// So the number of free observations is compared with the number that is expected of a static
/// voxel with the same number of runs and returns:
///
///     expected = flicker (1 + n_switch)^switch_power occupied^occupied_power hits^hit_power
///     gain * log((free + offset) / (expected + offset))
///
/// Thin objects, such as a bar or an awning seen from below, lie between the beams of most scans.
/// They look free to these scans although they are static. So a second score uses only the
/// keyframes that had a beam through the voxel itself, and the smaller of both scores counts:
///
///     thin = thin_flicker (1 + n_flicker)^switch_power hits^(occupied_power + hit_power)
///     gain * (log((passes + thin_offset) / (thin + thin_offset)) + thin_benefit)
///
/// If there are more than `enough` observations, all counters are first scaled down to that number.
/// The exponents add up to more than one, so without this scaling every busy place would become
/// static in a long recording. Source: docs/how-it-works.md, "Evidence of a voxel". Thread-safe.
class DynamicScore {
public:
    explicit DynamicScore(const ScansConfig::Evidence& config);
    float operator()(const Evidence& evidence) const;
    /// Number of free observations that is expected of a static voxel with these counters.
    [[nodiscard]] float expected_free(const Evidence& evidence) const;

private:
    /// (n + shift)^exponent from a table in steps of 1/16. Calls of pow() would take most of the
    /// time of a score.
    class Power {
    public:
        Power(int shift, float exponent);
        [[nodiscard]] float operator()(float n) const {
            const auto step = static_cast<std::size_t>(kSteps * n + 0.5F);
            return step < values_.size() ? values_[step] : compute(n);
        }

    private:
        static constexpr float kSteps = 16.0F;
        [[nodiscard]] float compute(float n) const;
        float shift_, exponent_;
        std::vector<float> values_;
    };
    /// Factor by which counters are scaled down if there are so many observations.
    [[nodiscard]] float scale_of(float observations) const;
    /// Expected number of free observations of a static voxel; the counters are already scaled
    /// down.
    [[nodiscard]] float expected(float flicker, float switches, float occupied, float hits) const;
    /// The same for the evidence of all keyframes.
    [[nodiscard]] float expected(const Evidence& evidence, float scale) const;
    /// Logarithms of the ratio between observed and expected: for all keyframes, and for those with
    /// a beam through the voxel.
    [[nodiscard]] float seen(const Evidence& evidence) const;
    [[nodiscard]] float passed(const Evidence& evidence) const;
    Power by_switches_, by_occupied_, by_hits_;
    float flicker_, offset_, thin_flicker_, thin_offset_, thin_benefit_, gain_, enough_, lowest_;
};

/// Share of time, 0..1, in which two voxels had points together: the overlap of their spans between
/// first and last owner, divided by the union of the spans. Voxels of one object appear and
/// disappear together.
float co_presence(const Evidence& a, const Evidence& b);

}  // namespace dynamic_filter
