// SPDX-License-Identifier: MIT
/// The inner loop of the line of sight, compiled once per instruction-set level from
/// sight_kernel.cpp.
#pragma once

#include <cstddef>
#include <cstdint>

#include "best_kernel.hpp"

namespace dynamic_filter::kernel {

struct SightArgs {
    // The image, as BeamImage::View has it.
    const std::uint32_t* pixels = nullptr;
    const std::uint16_t* farthest_cm = nullptr;
    int columns = 0, rows = 0, first_column = 0, stored_columns = 0;
    float azimuth_step = 0.0F, elevation_step = 0.0F, elevation_min = 0.0F;
    // SightMargins.
    float beside = 0.0F, beyond = 0.0F, touch = 0.0F, surface = 0.0F, per_metre = 0.0F;
    float nearest = 0.0F, farthest = 0.0F;
    float own_pixels = 0.0F, close_pixels = 0.0F, close_beside = 0.0F, same_spot = 0.0F;
    float clear = 0.0F, clear_unseen = 0.0F;
    // Places, and what is seen of them: Sight.
    const float *azimuth = nullptr, *elevation = nullptr, *range = nullptr;
    std::size_t count = 0;
    std::uint8_t* sights = nullptr;
};

DYNAMIC_FILTER_DECLARE_KERNEL(void, check_lines_of_sight, SightArgs)

}  // namespace dynamic_filter::kernel
