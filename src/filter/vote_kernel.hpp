// SPDX-License-Identifier: MIT
/// The inner loop of the vote of neighbors. vote_kernel.cpp is compiled once per instruction-set
/// level.
#pragma once

#include <cstddef>

#include "base/best_kernel.hpp"

namespace dynamic_filter::kernel {

/// The voters as parallel arrays: cell along each axis, weight, score times weight, first and last
/// owner.
struct VoteArgs {
    const float *x = nullptr, *y = nullptr, *z = nullptr;
    const float *weight = nullptr, *score = nullptr, *first = nullptr, *last = nullptr;
    std::size_t count = 0;  ///< a multiple of kVoters
    // Data of the voxel on which they vote.
    float own_x = 0.0F, own_y = 0.0F, own_z = 0.0F, own_first = 0.0F, own_last = 0.0F;
    // The weights of ScansConfig::Vote.
    float company = 0.0F, neighborhood = 0.0F, far = 0.0F, alone = 0.0F;
};

/// The arrays are filled up to a multiple of this with voters that are out of reach.
constexpr std::size_t kVoters = 16;
constexpr float kOutOfReach = 8e6F;  // cells; farther than any key

DYNAMIC_FILTER_DECLARE_KERNEL(float, vote, VoteArgs)

}  // namespace dynamic_filter::kernel
