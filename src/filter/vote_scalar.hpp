// SPDX-License-Identifier: MIT
/// Reference implementation of the vote of neighbors, one voter at a time. Tests compare the vector
/// kernel with it at every instruction-set level.
#pragma once

#include <algorithm>
#include <cmath>

#include "filter/vote_kernel.hpp"

namespace dynamic_filter::kernel {

/// The vote on a voxel: the weighted mean score of the voters that had points at the same time,
/// plus that of all voters within two cells. It lies within +-(company + neighborhood).
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
