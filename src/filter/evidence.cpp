// SPDX-License-Identifier: MIT
#include "filter/evidence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dynamic_filter {

namespace {

constexpr unsigned kMostCount = std::numeric_limits<std::uint16_t>::max();

/// Halves all counters until each can grow by `weight`. Only the ratios of counters matter.
void make_room(Evidence& e, unsigned weight) {
    const unsigned any_bit =
        static_cast<unsigned>(e.n_own | e.n_occ | e.n_free | e.n_switch | e.occupied | e.free |
                              e.hits | e.passes | e.n_flicker | e.moved);
    if (any_bit + weight <= kMostCount) return;  // nearly always; no counter is larger than any_bit
    const auto largest = [&] {
        return std::max({e.n_own, e.n_occ, e.n_free, e.n_switch, e.occupied, e.free, e.hits,
                         e.passes, e.n_flicker, e.moved});
    };
    while (largest() + weight > kMostCount) {
        for (std::uint16_t* counter : {&e.n_own, &e.n_occ, &e.n_free, &e.n_switch, &e.occupied,
                                       &e.free, &e.hits, &e.passes, &e.n_flicker, &e.moved}) {
            // Rounded up, so that a counter above 0 stays above 0.
            *counter = static_cast<std::uint16_t>((*counter + 1) / 2);
        }
    }
}

void add(std::uint16_t& counter, unsigned weight) {
    counter = static_cast<std::uint16_t>(counter + weight);
}

/// True if all values that the score depends on are equal.
bool have_same_score(const Evidence& a, const Evidence& b) {
    return a.occupied == b.occupied && a.free == b.free && a.hits == b.hits &&
           a.passes == b.passes && a.n_switch == b.n_switch && a.n_flicker == b.n_flicker &&
           is_unknown(a) == is_unknown(b);
}

/// Counts hits and passes of beams through the voxel itself. Only these tell about objects that are
/// so thin that they lie between the beams of most scans.
void record_pass(Evidence& e, const Observation& o, unsigned weight) {
    const bool passed = is_passed(o.sight);
    if (!passed && !o.hit) return;
    if (passed) add(e.passes, weight);
    const Sight now = passed ? Sight::free : Sight::occupied;
    if (e.last_near != now && e.last_near != Sight::unknown) add(e.n_flicker, weight);
    e.last_near = now;
}

float observations_of(const Evidence& e) { return static_cast<float>(e.occupied + e.free) / kSure; }

}  // namespace

bool record(Evidence& e, const Observation& o, unsigned longest_run) {
    if (o.sight == Sight::unknown) return false;
    const Evidence before = e;
    const unsigned weight = std::min(o.weight, kMostCount / (2 * kSure));
    make_room(e, kSure * weight);
    const unsigned each = is_weak(o.sight) ? kWeak : kSure;
    const Sight now = is_free(o.sight) ? Sight::free : Sight::occupied;
    if (e.last != now) {
        if (e.last != Sight::unknown) add(e.n_switch, weight);
        e.run = 0;
    }
    record_pass(e, o, weight);
    const unsigned new_of_run = std::min(weight, longest_run - e.run);
    if (now == Sight::free) {
        add(e.n_free, weight);
        add(e.free, each * weight);
        e.seen_empty |= !is_weak(o.sight);
    } else {
        add(e.n_occ, weight);
        add(e.occupied, each * new_of_run);
        if (o.hit) add(e.hits, new_of_run);
    }
    e.run = static_cast<std::uint8_t>(e.run + new_of_run);
    e.last = now;
    return !have_same_score(before, e);
}

Evidence without_observations(const Evidence& evidence) {
    Evidence out;
    out.n_own = evidence.n_own;
    out.since = evidence.since;
    out.first_owner = evidence.first_owner;
    out.last_owner = evidence.last_owner;
    return out;
}

void record_owner(Evidence& evidence, std::uint32_t scan) {
    if (evidence.n_own > 0 && evidence.last_owner == scan) return;
    make_room(evidence, 1);
    if (evidence.n_own == 0 || evidence.seen_empty) evidence.since = scan;
    evidence.seen_empty = false;
    add(evidence.n_own, 1);
    evidence.last_owner = scan;
}

void record_moved(Evidence& evidence, unsigned scans) {
    const unsigned most = std::min(scans, kMostCount / 2);  // a voxel may be occupied for hours
    make_room(evidence, most);
    add(evidence.moved, most);
}

DynamicScore::Power::Power(int shift, float exponent)
    : shift_(static_cast<float>(shift)), exponent_(exponent), values_(8192) {
    for (std::size_t i = 0; i < values_.size(); ++i) {
        values_[i] = compute(static_cast<float>(i) / kSteps);
    }
}

float DynamicScore::Power::compute(float n) const { return std::pow(n + shift_, exponent_); }

DynamicScore::DynamicScore(const ScansConfig::Evidence& config)
    : by_switches_(1, static_cast<float>(config.switch_power)),
      by_occupied_(0, static_cast<float>(config.occupied_power)),
      by_hits_(0, static_cast<float>(config.hit_power)),
      flicker_(static_cast<float>(config.flicker)),
      offset_(static_cast<float>(config.offset)),
      thin_flicker_(static_cast<float>(config.thin_flicker)),
      thin_offset_(static_cast<float>(config.thin_offset)),
      thin_benefit_(static_cast<float>(config.thin_benefit)),
      gain_(static_cast<float>(config.gain)),
      enough_(static_cast<float>(config.enough)),
      lowest_(-static_cast<float>(config.static_limit)) {}

float DynamicScore::scale_of(float observations) const {
    return observations > enough_ ? enough_ / observations : 1.0F;
}

float DynamicScore::expected(float flicker, float switches, float occupied, float hits) const {
    return flicker * by_switches_(switches) * by_occupied_(std::max(occupied, 1.0F)) *
           by_hits_(std::max(hits, 1.0F));
}

float DynamicScore::expected(const Evidence& e, float scale) const {
    const float occupied = static_cast<float>(e.occupied) / kSure;
    return expected(flicker_, scale * e.n_switch, scale * occupied, scale * e.hits);
}

float DynamicScore::expected_free(const Evidence& e) const {
    const float scale = scale_of(observations_of(e));
    return expected(e, scale) / scale;
}

float DynamicScore::seen(const Evidence& e) const {
    const float scale = scale_of(observations_of(e));
    const float free = scale * static_cast<float>(e.free) / kSure;
    return std::log((free + offset_) / (expected(e, scale) + offset_));
}

float DynamicScore::passed(const Evidence& e) const {
    const float scale = scale_of(static_cast<float>(e.hits + e.passes));
    const float hits = scale * e.hits;
    const float thin = expected(thin_flicker_, scale * e.n_flicker, hits, hits);
    return std::log((scale * e.passes + thin_offset_) / (thin + thin_offset_)) + thin_benefit_;
}

float DynamicScore::operator()(const Evidence& e) const {
    return std::clamp(gain_ * std::min(seen(e), passed(e)), lowest_, 1.0F);
}

float co_presence(const Evidence& a, const Evidence& b) {
    const std::uint32_t first_both = std::max(a.first_owner, b.first_owner);
    const std::uint32_t last_both = std::min(a.last_owner, b.last_owner);
    if (last_both < first_both) return 0.0F;
    const std::uint32_t first_any = std::min(a.first_owner, b.first_owner);
    const std::uint32_t last_any = std::max(a.last_owner, b.last_owner);
    return static_cast<float>(last_both - first_both + 1) /
           static_cast<float>(last_any - first_any + 1);
}

}  // namespace dynamic_filter
