// SPDX-License-Identifier: MIT
#pragma once

#include <malloc.h>

namespace dynamic_filter::app {

/// The buffers of a scan come and go with every scan. What is freed stays with the process, and
/// with all of its threads, or the kernel would have to clear new pages again and again.
inline void keep_freed_memory() {
#ifdef __GLIBC__
    mallopt(M_MMAP_THRESHOLD, 32 << 20);  // the most that is allowed
    mallopt(M_TRIM_THRESHOLD, 256 << 20);
    mallopt(M_ARENA_MAX, 2);
#endif
}

}  // namespace dynamic_filter::app
