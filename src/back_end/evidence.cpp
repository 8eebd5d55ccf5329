// SPDX-License-Identifier: MIT
#include "dynamic_filter/back_end/evidence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dynamic_filter {

namespace {

void count(std::uint16_t& counter) {
    if (counter < std::numeric_limits<std::uint16_t>::max()) ++counter;
}

}  // namespace

void record(Evidence& evidence, Sight sight) {
    if (sight == Sight::nothing) return;
    count(sight == Sight::occupied ? evidence.seen : evidence.passed);
    if (evidence.last != Sight::nothing && evidence.last != sight) count(evidence.switches);
    evidence.last = sight;
}

float transience(const Evidence& e) {
    constexpr float kOffset = 2.0F;  // so that one observation more or less is not everything
    const auto log_of = [](std::uint16_t n) {
        return std::log(static_cast<float>(std::max<std::uint16_t>(n, 1)));
    };
    const float returns = log_of(e.seen) + 2.0F * log_of(e.owned);
    const float expected =
        0.45F * std::exp(0.9F * std::log(1.0F + e.switches) + 0.2F * returns) + kOffset;
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
