// SPDX-License-Identifier: MIT
/// The inner loop of the line of sight. sight_kernel.cpp is compiled once per instruction-set
/// level.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/best_kernel.hpp"

namespace dynamic_filter::kernel {

struct SightArgs {
    // The image, as in BeamImage::View.
    const std::uint32_t* pixels = nullptr;
    const std::uint16_t* farthest_cm = nullptr;
    int columns = 0, rows = 0, first_column = 0, stored_columns = 0;
    float azimuth_step = 0.0F, elevation_step = 0.0F, elevation_min = 0.0F;
    // The values of SightMargins.
    float beside = 0.0F, beyond = 0.0F, touch = 0.0F, surface = 0.0F, per_metre = 0.0F;
    float nearest = 0.0F, farthest = 0.0F;
    float own_pixels = 0.0F, close_pixels = 0.0F, close_beside = 0.0F, same_spot = 0.0F;
    float clear = 0.0F, clear_unseen = 0.0F, apart = 0.0F;
    // The places, and the resulting values of Sight.
    const float *azimuth = nullptr, *elevation = nullptr, *range = nullptr;
    std::size_t count = 0;
    std::uint8_t* sights = nullptr;
};

DYNAMIC_FILTER_DECLARE_KERNEL(void, check_lines_of_sight, SightArgs)

}  // namespace dynamic_filter::kernel
