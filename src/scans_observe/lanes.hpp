// SPDX-License-Identifier: MIT
/// Sixteen floats at a time, for the kernels: the compiler splits them where vectors are shorter.
/// Everything is inlined, so that no level's code is linked into another's.
#pragma once

#include <cstddef>
#include <cstdint>

namespace dynamic_filter::kernel::DYNAMIC_FILTER_LEVEL {

constexpr int kLanes = 16;

using Floats = float __attribute__((vector_size(4 * kLanes)));
using Ints = std::int32_t __attribute__((vector_size(4 * kLanes)));  // masks: 0 or -1

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
