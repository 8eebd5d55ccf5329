// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace dynamic_filter {

/// The value that would be at `rank` if the values were sorted; there must be more than `rank`.
template <class T>
T value_at_rank(std::vector<T> values, std::size_t rank) {
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(rank);
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

/// The upper one of two middle values; 0 if there are no values.
template <class T>
T median(std::vector<T> values) {
    const std::size_t middle = values.size() / 2;
    return values.empty() ? T{} : value_at_rank(std::move(values), middle);
}

/// The 99th percentile, rounded down to a value that is there; 0 if there are no values. A few
/// values may be far above all others.
template <class T>
T usual_most(std::vector<T> values) {
    if (values.empty()) return T{};
    const std::size_t rank = 99 * (values.size() - 1) / 100;
    return value_at_rank(std::move(values), rank);
}

/// The hash of several whole numbers, such as the place of a cell.
struct NumbersHash {
    template <class Numbers>
    std::size_t operator()(const Numbers& numbers) const {
        std::uint64_t hash = 0;
        for (const auto number : numbers) {
            hash = (hash ^ static_cast<std::uint64_t>(number)) * 0x9E3779B97F4A7C15ULL;
            hash ^= hash >> 29U;
        }
        return static_cast<std::size_t>(hash);
    }
};

}  // namespace dynamic_filter
