// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

namespace dynamic_filter::app {

/// A number in [0, 1) for a point of a scan: as if drawn at random, and the same whenever asked.
inline double lot_of(std::size_t scan, std::size_t point) {
    std::uint64_t x = (std::uint64_t{scan} << 32U | point) + 0x9E3779B97F4A7C15ULL;
    x = (x ^ (x >> 30U)) * 0xBF58476D1CE4E5B9ULL;
    x = (x ^ (x >> 27U)) * 0x94D049BB133111EBULL;
    return static_cast<double>(x >> 32U) * 0x1p-32;
}

/// Whether a point of a scan is among that share of all.
inline bool is_sampled(std::size_t scan, std::size_t point, double share) {
    return lot_of(scan, point) < share;
}

/// Shuffles, so that the first n items are a fair sample for every n.
template <class T>
std::vector<T> shuffled(std::vector<T> items) {
    std::mt19937 random(1);
    for (std::size_t i = items.size(); i > 1; --i) std::swap(items[i - 1], items[random() % i]);
    return items;
}

}  // namespace dynamic_filter::app
