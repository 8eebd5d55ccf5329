// SPDX-License-Identifier: MIT
/// Which scans of a recording have ground truth.
#pragma once

#include <cstddef>
#include <vector>

#include "dynamic_filter/recording.hpp"

namespace dynamic_filter::io {

/// The indices of the scans that have ground truth, in order.
std::vector<std::size_t> scans_with_truth(const Info& info);

/// True if scans lack ground truth because only some were to have it, such as the key frames of a
/// data set: at least half of them lack it. Where most scans have it, the others lack it by
/// mistake.
bool is_sparse_truth(std::size_t with_truth, std::size_t scans);

}  // namespace dynamic_filter::io
