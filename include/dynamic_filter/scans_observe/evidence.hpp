// SPDX-License-Identifier: MIT
/// What the keyframes said about a voxel, and how that makes it look (Sec. III-C1).
#pragma once

#include <cstdint>
#include <vector>

#include "dynamic_filter/scans_observe/config.hpp"
#include "dynamic_filter/scans_observe/sight.hpp"

namespace dynamic_filter {

/// What a weak sight counts: an eighth of a sure one.
inline constexpr unsigned kWeak = 1, kSure = 8;

/// Counters of one voxel. Before one overflows, all are halved.
struct Evidence {
    std::uint16_t n_own = 0;      ///< scans with a point in it
    std::uint16_t n_occ = 0;      ///< keyframes that saw it occupied
    std::uint16_t n_free = 0;     ///< keyframes that saw through it
    std::uint16_t n_switch = 0;   ///< changes between the two, in the order of the keyframes
    std::uint16_t occupied = 0;   ///< as n_occ, but weighed, and of each run its beginning
    std::uint16_t free = 0;       ///< as n_free, but weighed
    std::uint16_t hits = 0;       ///< as n_occ, but of each run its beginning, and with a point
    std::uint16_t passes = 0;     ///< as n_free, but with a beam through the voxel itself
    std::uint16_t n_flicker = 0;  ///< changes between such keyframes and hits
    std::uint16_t moved = 0;      ///< scans in which its points were part of what moves
    std::uint8_t run = 0;         ///< keyframes of the present run, as far as they count
    Sight last = Sight::unknown;  ///< what the newest keyframe saw: occupied or free
    Sight last_near = Sight::unknown;  ///< of the newest hit (occupied) or pass (free)
    bool seen_empty = false;           ///< surely free since the last point in it
    std::uint32_t since = 0;           ///< the first scan with a point in it since then
    std::uint32_t first_owner = 0;     ///< the first scan with a point in it, by their order ...
    std::uint32_t last_owner = 0;      ///< ... and the last
};

/// What a keyframe saw of a voxel, as if `weight` keyframes like it had seen it. `hit`: its own
/// scan has a point in the voxel.
struct Observation {
    Sight sight = Sight::unknown;
    unsigned weight = 1;
    bool hit = false;
};

/// Takes in what the next keyframe saw. An occupied run lasts from when a voxel is first seen
/// occupied until it is seen free: of each, only the first `longest_run` keyframes (up to 255) tell
/// anything new about whether the voxel is static. False if the score is the same as before.
bool record(Evidence& evidence, const Observation& observation, unsigned longest_run);

/// Notes that this scan, by the order of the scans, has a point in the voxel: once a scan.
void record_owner(Evidence& evidence, std::uint32_t scan);

/// Notes that in so many scans the points in the voxel were part of something that moves.
void record_moved(Evidence& evidence, unsigned scans);

/// True while none saw through it and fewer than two saw it: one of those is the scan that found
/// it.
inline bool is_unknown(const Evidence& e) { return e.n_occ < 2 && e.n_free == 0; }

/// Whether the voxel was empty most of the time and only crossed by something, -static_limit..1;
/// below 0: no. A porous surface, an edge or a leaf is seen through now and then, between returns;
/// where something came or went, the voxel is free in few long runs. So how often it was seen free
/// is compared with what the number of runs and of returns lead one to expect of a static voxel:
///     expected = flicker (1 + n_switch)^switch_power occupied^occupied_power hits^hit_power
///     gain * log((free + offset) / (expected + offset))
/// Something thin, as a bar or an awning seen from below, lies between the beams of most scans, and
/// is static all the same. So the same is asked of those keyframes alone that had a beam through
/// the voxel itself, and the smaller score counts:
///     thin = thin_flicker (1 + n_flicker)^switch_power hits^(occupied_power + hit_power)
///     gain * (log((passes + thin_offset) / (thin + thin_offset)) + thin_benefit)
/// Where observations are more than `enough`, all counters are scaled down to so many first: the
/// sum of the exponents is more than one, so without that every busy place would become static once
/// a recording is long enough. Thread-safe.
class DynamicScore {
public:
    explicit DynamicScore(const ScansConfig::Evidence& config);
    float operator()(const Evidence& evidence) const;
    /// How often a static voxel with these counters would be seen free.
    [[nodiscard]] float expected_free(const Evidence& evidence) const;

private:
    /// (n + shift)^exponent, from a table in steps of 1/16: pow() would be most of what a
    /// look costs.
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
    /// By how much counters are scaled down, with so many observations.
    [[nodiscard]] float scale_of(float observations) const;
    /// How often a static voxel is seen free, by counters that are scaled down already.
    [[nodiscard]] float expected(float flicker, float switches, float occupied, float hits) const;
    /// The same for the evidence of all keyframes.
    [[nodiscard]] float expected(const Evidence& evidence, float scale) const;
    /// Logarithms of the ratio: of all keyframes, and of those with a beam through the voxel.
    [[nodiscard]] float seen(const Evidence& evidence) const;
    [[nodiscard]] float passed(const Evidence& evidence) const;
    Power by_switches_, by_occupied_, by_hits_;
    float flicker_, offset_, thin_flicker_, thin_offset_, thin_benefit_, gain_, enough_, lowest_;
};

/// How much of their time two voxels were there together: the overlap of the spans between their
/// first and last owner, over their union, 0..1. Voxels of one thing come and go together.
float co_presence(const Evidence& a, const Evidence& b);

}  // namespace dynamic_filter
