// SPDX-License-Identifier: MIT
#include "dynamic_filter/back_end/evidence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace dynamic_filter {

namespace {

void count(std::uint16_t& counter, unsigned weight) {
    constexpr unsigned kMost = std::numeric_limits<std::uint16_t>::max();
    counter = static_cast<std::uint16_t>(std::min(kMost, counter + weight));
}

/// scale * (n + offset)^exponent, from a table: pow() would be most of what a look costs.
class Power {
public:
    Power(float scale, int offset, float exponent)
        : scale_(scale), offset_(offset), exponent_(exponent), values_(4096) {
        for (std::size_t n = 0; n < values_.size(); ++n) values_[n] = compute(n);
    }
    [[nodiscard]] float operator()(std::size_t n) const {
        return n < values_.size() ? values_[n] : compute(n);
    }

private:
    [[nodiscard]] float compute(std::size_t n) const {
        return scale_ * std::pow(static_cast<float>(static_cast<int>(n) + offset_), exponent_);
    }
    float scale_;
    int offset_;
    float exponent_;
    std::vector<float> values_;
};

}  // namespace

void record(Evidence& evidence, Sight sight, unsigned weight) {
    if (sight == Sight::nothing) return;
    count(sight == Sight::occupied ? evidence.seen : evidence.passed, weight);
    if (evidence.last != Sight::nothing && evidence.last != sight) {
        count(evidence.switches, weight);
    }
    evidence.last = sight;
}

float transience(const Evidence& e) {
    constexpr float kOffset = 2.0F;  // so that one observation more or less is not everything
    static const Power by_switches(0.45F, 1, 0.9F), by_returns(1.0F, 0, 0.2F);
    const auto returns = [&](std::uint16_t n) { return by_returns(std::max<std::uint16_t>(n, 1)); };
    const float owned = returns(e.owned);
    const float expected = by_switches(e.switches) * returns(e.seen) * owned * owned + kOffset;
    const float passed = e.passed + kOffset;
    return (passed * passed - expected * expected) / (passed * passed + expected * expected);
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
