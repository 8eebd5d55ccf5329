// SPDX-License-Identifier: MIT
#include "dynamic_filter/scans_observe/evidence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dynamic_filter {

namespace {

void count(std::uint16_t& counter, unsigned weight) {
    constexpr unsigned kMost = std::numeric_limits<std::uint16_t>::max();
    counter = static_cast<std::uint16_t>(std::min(kMost, counter + weight));
}

}  // namespace

void record(Evidence& evidence, Sight sight, unsigned weight) {
    if (sight == Sight::unknown) return;
    count(sight == Sight::occupied ? evidence.n_occ : evidence.n_free, weight);
    if (evidence.last != Sight::unknown && evidence.last != sight) {
        count(evidence.n_switch, weight);
    }
    evidence.last = sight;
}

DynamicScore::Power::Power(float scale, int shift, float exponent)
    : scale_(scale), shift_(shift), exponent_(exponent), values_(4096) {
    for (std::size_t n = 0; n < values_.size(); ++n) values_[n] = compute(n);
}

float DynamicScore::Power::compute(std::size_t n) const {
    return scale_ * std::pow(static_cast<float>(static_cast<int>(n) + shift_), exponent_);
}

DynamicScore::DynamicScore(const ScansConfig::Evidence& config)
    : by_switches_(static_cast<float>(config.flicker), 1, static_cast<float>(config.switch_power)),
      by_returns_(1.0F, 0, static_cast<float>(config.return_power)),
      offset_(static_cast<float>(config.offset)) {}

float DynamicScore::operator()(const Evidence& e) const {
    const auto returns = [&](std::uint16_t n) {
        return by_returns_(std::max<std::uint16_t>(n, 1));
    };
    const float own = returns(e.n_own);
    const float expected = by_switches_(e.n_switch) * returns(e.n_occ) * own * own + offset_;
    const float free = e.n_free + offset_;
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
