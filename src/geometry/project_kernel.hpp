// SPDX-License-Identifier: MIT
/// The projection's inner loop, compiled once per instruction-set level from project_kernel.cpp.
#pragma once

#include <cstddef>
#include <cstdint>

namespace dynamic_filter::kernel {

struct ProjectArgs {
    const float* xyz = nullptr;  ///< count * 3
    std::size_t count = 0;
    const float* matrix = nullptr;  ///< row-major 3x4
    float elevation_min = 0.0F, inverse_azimuth_step = 0.0F, inverse_elevation_step = 0.0F;
    int columns = 0, rows = 0;
    std::int32_t* pixel = nullptr;
    float* range = nullptr;
};

struct SphericalArgs {
    const float* xyz = nullptr;  ///< count * 3
    std::size_t count = 0;
    const float* matrix = nullptr;  ///< row-major 3x4
    float *azimuth = nullptr, *elevation = nullptr, *range = nullptr;
};

namespace baseline {
void project(const ProjectArgs& args);
void to_spherical(const SphericalArgs& args);
}  // namespace baseline
#ifdef DYNAMIC_FILTER_X86_LEVELS
namespace avx2 {
void project(const ProjectArgs& args);
void to_spherical(const SphericalArgs& args);
}  // namespace avx2
namespace avx512 {
void project(const ProjectArgs& args);
void to_spherical(const SphericalArgs& args);
}  // namespace avx512
#endif

}  // namespace dynamic_filter::kernel
