// SPDX-License-Identifier: MIT
/// The inner loop of the projection. project_kernel.cpp is compiled once per instruction-set level.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/best_kernel.hpp"

namespace dynamic_filter::kernel {

struct ProjectArgs {
    const float* xyz = nullptr;  ///< 3 * count values
    std::size_t count = 0;
    const float* matrix = nullptr;  ///< row-major 3x4
    float elevation_min = 0.0F, inverse_azimuth_step = 0.0F, inverse_elevation_step = 0.0F;
    int columns = 0, rows = 0;
    std::int32_t* pixel = nullptr;
    float* range = nullptr;
};

struct SphericalArgs {
    const float* xyz = nullptr;  ///< 3 * count values
    std::size_t count = 0;
    const float* matrix = nullptr;  ///< row-major 3x4
    float *azimuth = nullptr, *elevation = nullptr, *range = nullptr;
};

DYNAMIC_FILTER_DECLARE_KERNEL(void, project, ProjectArgs)
DYNAMIC_FILTER_DECLARE_KERNEL(void, to_spherical, SphericalArgs)

}  // namespace dynamic_filter::kernel
