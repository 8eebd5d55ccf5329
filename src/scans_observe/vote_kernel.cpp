// SPDX-License-Identifier: MIT
// This file is compiled several times, like sight_kernel.cpp.
#include "vote_kernel.hpp"

#include "lanes.hpp"

namespace dynamic_filter::kernel::DYNAMIC_FILTER_LEVEL {

namespace {

constexpr float kReach = 2.0F;  // cells

DF_INLINE float sum(Floats v) {
    float total = 0.0F;
    for (int k = 0; k < kLanes; ++k) total += v[k];
    return total;
}

}  // namespace

float vote(const VoteArgs& args) {
    const Floats zero{};
    Floats company{}, companions{}, around{}, neighbors{};
    for (std::size_t i = 0; i < args.count; i += kLanes) {
        const Floats distance = larger(magnitude(load(args.x + i) - args.own_x),
                                       larger(magnitude(load(args.y + i) - args.own_y),
                                              magnitude(load(args.z + i) - args.own_z)));
        const Ints votes = (distance > 0.5F) & (distance <= kReach);
        const Floats score = load(args.score + i);
        const Floats first = load(args.first + i), last = load(args.last + i);
        const Floats both =
            smaller(last, zero + args.own_last) - larger(first, zero + args.own_first) + 1.0F;
        const Floats either =
            larger(last, zero + args.own_last) - smaller(first, zero + args.own_first) + 1.0F;
        const Floats together = (votes & (both > 0.0F)) ? both / either : zero;
        const Floats weight = load(args.weight + i);
        company += together * score;
        companions += together * weight;
        const Floats share = votes ? (distance > 1.5F ? zero + args.far : zero + 1.0F) : zero;
        around += share * score;
        neighbors += share * weight;
    }
    return args.company * sum(company) / (sum(companions) + args.alone) +
           args.neighborhood * sum(around) / (sum(neighbors) + args.alone);
}

}  // namespace dynamic_filter::kernel::DYNAMIC_FILTER_LEVEL
