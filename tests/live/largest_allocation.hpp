// SPDX-License-Identifier: MIT
/// Replaces operator new of the executable that it is linked into.
#pragma once

#include <cstddef>

namespace dynamic_filter::live {

/// [bytes] The largest allocation of this thread since the last call.
std::size_t pop_largest_allocation();

}  // namespace dynamic_filter::live
