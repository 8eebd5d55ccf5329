// SPDX-License-Identifier: MIT
#include "dynamic_filter/scans_observe/evidence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dynamic_filter {

namespace {

constexpr unsigned kMost = std::numeric_limits<std::uint16_t>::max();

/// Halves all counters until each can take so many more: their proportions are what tells.
void make_room(Evidence& e, unsigned weight) {
    const auto largest = [&] {
        return std::max({e.n_own, e.n_occ, e.n_free, e.n_switch, e.occupied, e.free, e.hits});
    };
    while (largest() + weight > kMost) {
        for (std::uint16_t* counter :
             {&e.n_own, &e.n_occ, &e.n_free, &e.n_switch, &e.occupied, &e.free, &e.hits}) {
            *counter = static_cast<std::uint16_t>((*counter + 1) / 2);  // what was seen stays seen
        }
    }
}

void add(std::uint16_t& counter, unsigned weight) {
    counter = static_cast<std::uint16_t>(counter + weight);
}

}  // namespace

void record(Evidence& e, const Observation& o, unsigned longest_run) {
    if (o.sight == Sight::unknown) return;
    const unsigned weight = std::min(o.weight, kMost / (2 * kSure));
    make_room(e, kSure * weight);
    const unsigned each = is_weak(o.sight) ? kWeak : kSure;
    const Sight now = is_free(o.sight) ? Sight::free : Sight::occupied;
    if (e.last != now) {
        if (e.last != Sight::unknown) add(e.n_switch, weight);
        e.run = 0;
    }
    const unsigned new_of_run = std::min(weight, longest_run - e.run);
    if (now == Sight::free) {
        add(e.n_free, weight);
        add(e.free, each * weight);
    } else {
        add(e.n_occ, weight);
        add(e.occupied, each * new_of_run);
        if (o.hit) add(e.hits, new_of_run);
    }
    e.run = static_cast<std::uint8_t>(e.run + new_of_run);
    e.last = now;
}

void record_owner(Evidence& evidence, std::uint32_t scan) {
    if (evidence.n_own > 0 && evidence.last_owner == scan) return;
    make_room(evidence, 1);
    add(evidence.n_own, 1);
    evidence.last_owner = scan;
}

DynamicScore::Power::Power(float scale, int shift, float exponent)
    : scale_(scale), shift_(static_cast<float>(shift)), exponent_(exponent), values_(8192) {
    for (std::size_t i = 0; i < values_.size(); ++i) {
        values_[i] = compute(static_cast<float>(i) / kSteps);
    }
}

float DynamicScore::Power::compute(float n) const {
    return scale_ * std::pow(n + shift_, exponent_);
}

DynamicScore::DynamicScore(const ScansConfig::Evidence& config)
    : by_switches_(static_cast<float>(config.flicker), 1, static_cast<float>(config.switch_power)),
      by_occupied_(1.0F, 0, static_cast<float>(config.occupied_power)),
      by_hits_(1.0F, 0, static_cast<float>(config.hit_power)),
      offset_(static_cast<float>(config.offset)),
      gain_(static_cast<float>(config.gain)),
      enough_(static_cast<float>(config.enough)),
      lowest_(-static_cast<float>(config.static_limit)) {}

float DynamicScore::scale_of(const Evidence& e) const {
    const float observations = static_cast<float>(e.occupied + e.free) / kSure;
    return observations > enough_ ? enough_ / observations : 1.0F;
}

float DynamicScore::expected(const Evidence& e, float scale) const {
    const float occupied = static_cast<float>(e.occupied) / kSure;
    return by_switches_(scale * e.n_switch) * by_occupied_(std::max(scale * occupied, 1.0F)) *
           by_hits_(std::max(scale * e.hits, 1.0F));
}

float DynamicScore::expected_free(const Evidence& e) const {
    const float scale = scale_of(e);
    return expected(e, scale) / scale;
}

float DynamicScore::operator()(const Evidence& e) const {
    const float scale = scale_of(e);
    const float free = scale * static_cast<float>(e.free) / kSure;
    const float ratio = (free + offset_) / (expected(e, scale) + offset_);
    return std::clamp(gain_ * std::log(ratio), lowest_, 1.0F);
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
