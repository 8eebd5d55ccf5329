// SPDX-License-Identifier: MIT
/// The instruction-set levels for which kernels are compiled, and the choice of the best level for
/// this machine. These are macros because the levels are namespaces, and not all levels exist on
/// all machines.
#pragma once

#ifdef DYNAMIC_FILTER_X86_LEVELS
#define DYNAMIC_FILTER_BEST_KERNEL(function)                                        \
    (__builtin_cpu_supports("avx512f") ? ::dynamic_filter::kernel::avx512::function \
     : __builtin_cpu_supports("avx2")  ? ::dynamic_filter::kernel::avx2::function   \
                                       : ::dynamic_filter::kernel::baseline::function)
#define DYNAMIC_FILTER_DECLARE_KERNEL(result, function, Args) \
    namespace baseline {                                      \
    result function(const Args& args);                        \
    }                                                         \
    namespace avx2 {                                          \
    result function(const Args& args);                        \
    }                                                         \
    namespace avx512 {                                        \
    result function(const Args& args);                        \
    }
#else
#define DYNAMIC_FILTER_BEST_KERNEL(function) (::dynamic_filter::kernel::baseline::function)
#define DYNAMIC_FILTER_DECLARE_KERNEL(result, function, Args) \
    namespace baseline {                                      \
    result function(const Args& args);                        \
    }
#endif
