// SPDX-License-Identifier: MIT
/// The specification of the neighbours' vote, one voter at a time. The vector kernel is tested
/// against it at every instruction-set level.
#pragma once

#include <algorithm>
#include <cmath>

#include "vote_kernel.hpp"

namespace dynamic_filter::kernel {

/// What the voters say of the voxel: the weighted mean score of those that were there at the same
/// time, and that of all, as far as they lie within two cells. Within +-(company + neighborhood).
inline float vote_scalar(const VoteArgs& args) {
    float company = 0.0F, companions = 0.0F, around = 0.0F, neighbors = 0.0F;
    for (std::size_t i = 0; i < args.count; ++i) {
        const float distance =
            std::max({std::abs(args.x[i] - args.own_x), std::abs(args.y[i] - args.own_y),
                      std::abs(args.z[i] - args.own_z)});
        if (distance < 0.5F || distance > 2.0F) continue;  // the voxel itself, or too far
        const float both =
            std::min(args.last[i], args.own_last) - std::max(args.first[i], args.own_first) + 1.0F;
        const float either =
            std::max(args.last[i], args.own_last) - std::min(args.first[i], args.own_first) + 1.0F;
        const float together = both > 0.0F ? both / either : 0.0F;
        company += together * args.score[i];
        companions += together * args.weight[i];
        const float share = distance > 1.5F ? args.far : 1.0F;
        around += share * args.score[i];
        neighbors += share * args.weight[i];
    }
    return args.company * company / (companions + args.alone) +
           args.neighborhood * around / (neighbors + args.alone);
}

}  // namespace dynamic_filter::kernel
