// SPDX-License-Identifier: MIT
/// @file
/// The one door to threads. Bodies write by index only, so results do not depend on scheduling.
///
/// - Ownership: bodies are borrowed for the call.
/// - Threads: callable from any, also from a body.
/// - Errors: what the bodies throw.
#pragma once

#include <cstddef>
#include <functional>

namespace dynamic_filter {

/// Calls `body(begin, end)` on disjoint ranges that cover [0, count), possibly at the same time.
/// An exception of the body is rethrown here. Ranges hold about `grain` items.
void parallel_for(std::size_t count, std::size_t grain,
                  const std::function<void(std::size_t, std::size_t)>& body);

/// Runs `work` so that parallel_for inside it uses at most `threads` threads (0: all cores).
void with_threads(int threads, const std::function<void()>& work);

/// Threads that parallel_for uses at most if called from here.
int current_threads();

/// Cores that this process may run on.
int available_threads();

}  // namespace dynamic_filter
