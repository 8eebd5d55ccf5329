// SPDX-License-Identifier: MIT
// This file is compiled several times, like sight_kernel.cpp.
#include "filter/vote_kernel.hpp"

#include "filter/lanes.hpp"

namespace dynamic_filter::kernel::DYNAMIC_FILTER_LEVEL {

namespace {

constexpr float kReach = 2.0F;  // cells

// Sixteen sums at all levels, because the result depends on their number.
constexpr int kSums = 16, kParts = kSums / kLanes;
using Sums = Floats[kParts];

DF_INLINE float sum(const Sums& sums) {
    float total = 0.0F;
    for (const Floats& part : sums) {
        for (int k = 0; k < kLanes; ++k) total += part[k];
    }
    return total;
}

}  // namespace

float vote(const VoteArgs& args) {
    const Floats zero{};
    Sums company{}, companions{}, around{}, neighbors{};
    for (std::size_t i = 0; i < args.count; i += kSums) {
        for (int part = 0; part < kParts; ++part) {
            const std::size_t at = i + static_cast<std::size_t>(part * kLanes);
            const Floats distance = larger(magnitude(load(args.x + at) - args.own_x),
                                           larger(magnitude(load(args.y + at) - args.own_y),
                                                  magnitude(load(args.z + at) - args.own_z)));
            const Ints votes = (distance > 0.5F) & (distance <= kReach);
            const Floats score = load(args.score + at), weight = load(args.weight + at);
            const Floats first = load(args.first + at), last = load(args.last + at);
            const Floats both =
                smaller(last, zero + args.own_last) - larger(first, zero + args.own_first) + 1.0F;
            const Floats either =
                larger(last, zero + args.own_last) - smaller(first, zero + args.own_first) + 1.0F;
            const Floats together = (votes & (both > 0.0F)) ? both / either : zero;
            company[part] += together * score;
            companions[part] += together * weight;
            const Floats share = votes ? (distance > 1.5F ? zero + args.far : zero + 1.0F) : zero;
            around[part] += share * score;
            neighbors[part] += share * weight;
        }
    }
    return args.company * sum(company) / (sum(companions) + args.alone) +
           args.neighborhood * sum(around) / (sum(neighbors) + args.alone);
}

}  // namespace dynamic_filter::kernel::DYNAMIC_FILTER_LEVEL
