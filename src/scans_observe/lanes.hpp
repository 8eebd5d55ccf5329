// SPDX-License-Identifier: MIT
/// Vectors of sixteen floats for the kernels; the compiler splits them if the machine has shorter
/// vectors. All functions are inlined, so that the code of one instruction-set level is not linked
/// into another one.
#pragma once

#include <cstddef>
#include <cstdint>

namespace dynamic_filter::kernel::DYNAMIC_FILTER_LEVEL {

constexpr int kLanes = 16;

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
