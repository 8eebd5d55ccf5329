// SPDX-License-Identifier: MIT
/// @file
/// Parallel loops; all threads of the library's computations are started here. Loop bodies write
/// only to the elements of their own range, so results do not depend on scheduling.
///
/// - Ownership: bodies are borrowed for the call.
/// - Threads: may be called from any thread, also from within a body.
/// - Errors: an exception of a body is passed on; if several bodies throw, the first one.
#pragma once

#include <cstddef>
#include <functional>

namespace dynamic_filter {

/// Calls `body(begin, end)` on disjoint ranges that cover [0, count), possibly in parallel. A range
/// of `grain` items or fewer is not split further; a range may also be much longer. If a body
/// throws, its exception is rethrown here after all running ranges have ended; some ranges may then
/// never have been started.
void parallel_for(std::size_t count, std::size_t grain,
                  const std::function<void(std::size_t, std::size_t)>& body);

/// The most threads that may be asked for; oneTBB stores this number in 16 bits.
inline constexpr int kMostThreads = 1024;

/// Runs `work` so that each parallel_for inside it uses at most `threads` threads (0 or less: all
/// cores). Returns when `work` has returned; an exception of `work` is rethrown.
void with_threads(int threads, const std::function<void()>& work);

/// Largest number of threads that parallel_for uses if it is called from here.
int current_threads();

/// Number of cores that this process may use.
int available_threads();

}  // namespace dynamic_filter
