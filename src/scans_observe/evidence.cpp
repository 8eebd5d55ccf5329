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
    const auto largest = [&] { return std::max({e.n_own, e.n_occ, e.n_free, e.n_switch}); };
    while (largest() + weight > kMost) {
        for (std::uint16_t* counter : {&e.n_own, &e.n_occ, &e.n_free, &e.n_switch}) {
            *counter = static_cast<std::uint16_t>((*counter + 1) / 2);  // what was seen stays seen
        }
    }
}

void add(std::uint16_t& counter, unsigned weight) {
    counter = static_cast<std::uint16_t>(counter + weight);
}

}  // namespace

void record(Evidence& evidence, Sight sight, unsigned weight) {
    if (sight == Sight::unknown) return;
    weight = std::min(weight, kMost / 2);
    make_room(evidence, weight);
    add(sight == Sight::occupied ? evidence.n_occ : evidence.n_free, weight);
    if (evidence.last != Sight::unknown && evidence.last != sight) add(evidence.n_switch, weight);
    evidence.last = sight;
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
      by_returns_(1.0F, 0, static_cast<float>(config.return_power)),
      offset_(static_cast<float>(config.offset)),
      enough_(static_cast<float>(config.enough)) {}

float DynamicScore::operator()(const Evidence& e) const {
    const auto observations = static_cast<float>(e.n_occ + e.n_free);
    const float scale = observations > enough_ ? enough_ / observations : 1.0F;
    const auto returns = [&](std::uint16_t n) {
        return by_returns_(std::max(scale * static_cast<float>(n), 1.0F));
    };
    const float own = returns(e.n_own);
    const float expected =
        by_switches_(scale * e.n_switch) * returns(e.n_occ) * own * own + offset_;
    const float free = scale * e.n_free + offset_;
    return (free * free - expected * expected) / (free * free + expected * expected);
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
