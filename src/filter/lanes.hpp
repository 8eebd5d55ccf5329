// SPDX-License-Identifier: MIT
/// Vectors of floats for the kernels, as long as the registers of the instruction-set level. All
/// functions are inlined, so that the code of one level is not linked into another one.
#pragma once

#include <cstddef>
#include <cstdint>

namespace dynamic_filter::kernel::DYNAMIC_FILTER_LEVEL {

// As many as fit into a register: gcc 12 splits longer vectors badly.
#if defined(__AVX512F__)
#define DF_LANES 16
#elif defined(__AVX2__)
#define DF_LANES 8
#else
#define DF_LANES 4
#endif
constexpr int kLanes = DF_LANES;

using Floats = float __attribute__((vector_size(4 * kLanes)));
// Masks: 0 is false, -1 is true.
using Ints = std::int32_t __attribute__((vector_size(4 * kLanes)));

#define DF_INLINE static inline __attribute__((always_inline))

DF_INLINE Floats load(const float* values) {
    Floats out;
    __builtin_memcpy(&out, values, sizeof out);
    return out;
}
DF_INLINE Floats to_floats(Ints v) { return __builtin_convertvector(v, Floats); }
DF_INLINE Floats smaller(Floats a, Floats b) { return a < b ? a : b; }
DF_INLINE Floats larger(Floats a, Floats b) { return a > b ? a : b; }
DF_INLINE Floats magnitude(Floats a) { return a < 0.0F ? -a : a; }

}  // namespace dynamic_filter::kernel::DYNAMIC_FILTER_LEVEL
