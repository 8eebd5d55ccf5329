// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

#include "dynamic_filter/parallel.hpp"
#include "dynamic_filter/scores.hpp"

namespace dynamic_filter::eval {

/// Calls `use(i, scan)` with every scan in order; a few scans are read ahead in parallel.
template <class F>
void for_each_scan(std::size_t scans, const ScanSource& source, F&& use) {
    constexpr std::size_t kAhead = 16;
    for (std::size_t first = 0; first < scans; first += kAhead) {
        std::vector<std::optional<LabelledScan>> batch(std::min(kAhead, scans - first));
        parallel_for(batch.size(), 1, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) batch[i] = source(first + i);
        });
        for (std::size_t i = 0; i < batch.size(); ++i) {
            if (batch[i]) use(first + i, *batch[i]);
        }
    }
}

}  // namespace dynamic_filter::eval
