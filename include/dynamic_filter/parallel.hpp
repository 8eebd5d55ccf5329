// SPDX-License-Identifier: MIT
/// @file
/// The one door to threads. Bodies write by index only, so results do not depend on scheduling.
///
/// - Ownership: bodies are borrowed for the call.
/// - Threads: callable from any, also from a body.
/// - Errors: what a body throws, the first if there are several.
#pragma once

#include <cstddef>
#include <functional>

namespace dynamic_filter {

/// Calls `body(begin, end)` on disjoint ranges that cover [0, count), possibly at the same time.
/// A range of `grain` items or fewer is not split further, and a range may be much longer. An
/// exception of the body is rethrown here, when no range is in work any more; some may then never
/// have begun.
void parallel_for(std::size_t count, std::size_t grain,
                  const std::function<void(std::size_t, std::size_t)>& body);

/// Runs `work` so that parallel_for inside it uses at most `threads` threads (0 or less: all
/// cores). Returns when `work` has; its exception is rethrown.
void with_threads(int threads, const std::function<void()>& work);

/// Threads that parallel_for uses at most if called from here.
int current_threads();

/// Cores that this process may run on.
int available_threads();

}  // namespace dynamic_filter
