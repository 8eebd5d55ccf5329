// SPDX-License-Identifier: MIT
/// Which of a kernel's instruction-set levels this machine runs best. A macro, because the levels
/// are namespaces, and not all exist everywhere.
#pragma once

#ifdef DYNAMIC_FILTER_X86_LEVELS
#define DYNAMIC_FILTER_BEST_KERNEL(function)                                        \
    (__builtin_cpu_supports("avx512f") ? ::dynamic_filter::kernel::avx512::function \
     : __builtin_cpu_supports("avx2")  ? ::dynamic_filter::kernel::avx2::function   \
                                       : ::dynamic_filter::kernel::baseline::function)
#else
#define DYNAMIC_FILTER_BEST_KERNEL(function) (::dynamic_filter::kernel::baseline::function)
#endif
