// SPDX-License-Identifier: MIT
// This file is compiled several times, each time with its own DYNAMIC_FILTER_LEVEL and instruction
// set. It uses only builtins and raw pointers: an inline library function compiled for AVX could be
// linked into code that runs on older machines.
#include "geometry/project_kernel.hpp"

#include <numbers>

namespace dynamic_filter::kernel::DYNAMIC_FILTER_LEVEL {

namespace {

constexpr float kPi = std::numbers::pi_v<float>;

/// atan2 by a polynomial on [0, 1]. The error is below 2e-5 rad, which is far less than a pixel.
/// (0, 0) gives 0. There are no branches, so that the compiler can vectorize the loop.
inline float polynomial_atan2(float y, float x) {
    const float ax = __builtin_fabsf(x), ay = __builtin_fabsf(y);
    const float larger = ax > ay ? ax : ay, smaller = ax > ay ? ay : ax;
    const float t = larger > 0.0F ? smaller / larger : 0.0F;
    const float s = t * t;
    float angle =
        t * (0.99997726F +
             s * (-0.33262347F +
                  s * (0.19354346F + s * (-0.11643287F + s * (0.05265332F + s * -0.01172120F)))));
    angle = ay > ax ? 0.5F * kPi - angle : angle;
    angle = x < 0.0F ? kPi - angle : angle;
    return y < 0.0F ? -angle : angle;
}

}  // namespace

void project(const ProjectArgs& args) {
    const float* const xyz = args.xyz;
    const float* const m = args.matrix;
    const float m00 = m[0], m01 = m[1], m02 = m[2], m03 = m[3];
    const float m10 = m[4], m11 = m[5], m12 = m[6], m13 = m[7];
    const float m20 = m[8], m21 = m[9], m22 = m[10], m23 = m[11];
    const auto columns = static_cast<float>(args.columns), rows = static_cast<float>(args.rows);
    const float per_azimuth = args.inverse_azimuth_step,
                per_elevation = args.inverse_elevation_step;
    const float elevation_min = args.elevation_min;
    const std::int32_t stride = args.columns;
    std::int32_t* const __restrict pixel = args.pixel;
    float* const __restrict range = args.range;

    for (std::size_t i = 0; i < args.count; ++i) {
        const float px = xyz[3 * i], py = xyz[3 * i + 1], pz = xyz[3 * i + 2];
        const float x = m00 * px + m01 * py + m02 * pz + m03;
        const float y = m10 * px + m11 * py + m12 * pz + m13;
        const float z = m20 * px + m21 * py + m22 * pz + m23;
        const float across_sq = x * x + y * y;
        const float r = __builtin_sqrtf(across_sq + z * z);
        const float elevation = polynomial_atan2(z, __builtin_sqrtf(across_sq));
        float column = (polynomial_atan2(y, x) + kPi) * per_azimuth;
        // An azimuth of +pi is the same as -pi.
        column = column >= columns ? column - columns : column;
        const float row = (elevation - elevation_min) * per_elevation;
        // Comparisons with NaN are false, so NaN is not in the image.
        const bool inside = (r > 0.0F) & (r < 1e30F) & (row >= 0.0F) & (row < rows) &
                            (column >= 0.0F) & (column < columns);
        const auto column_index = static_cast<std::int32_t>(inside ? column : 0.0F);
        const auto row_index = static_cast<std::int32_t>(inside ? row : 0.0F);
        pixel[i] = inside ? row_index * stride + column_index : -1;
        range[i] = r;
    }
}

void to_spherical(const SphericalArgs& args) {
    const float* const xyz = args.xyz;
    const float* const m = args.matrix;
    const float m00 = m[0], m01 = m[1], m02 = m[2], m03 = m[3];
    const float m10 = m[4], m11 = m[5], m12 = m[6], m13 = m[7];
    const float m20 = m[8], m21 = m[9], m22 = m[10], m23 = m[11];
    float* const __restrict azimuth = args.azimuth;
    float* const __restrict elevation = args.elevation;
    float* const __restrict range = args.range;

    for (std::size_t i = 0; i < args.count; ++i) {
        const float px = xyz[3 * i], py = xyz[3 * i + 1], pz = xyz[3 * i + 2];
        const float x = m00 * px + m01 * py + m02 * pz + m03;
        const float y = m10 * px + m11 * py + m12 * pz + m13;
        const float z = m20 * px + m21 * py + m22 * pz + m23;
        const float across_sq = x * x + y * y;
        azimuth[i] = polynomial_atan2(y, x);
        elevation[i] = polynomial_atan2(z, __builtin_sqrtf(across_sq));
        range[i] = __builtin_sqrtf(across_sq + z * z);
    }
}

}  // namespace dynamic_filter::kernel::DYNAMIC_FILTER_LEVEL
