// SPDX-License-Identifier: MIT
/// Counter-based random numbers. Each value is a hash of the place where it is used, so the order
/// of the calls and the number of threads have no effect.
#pragma once

#include <cstdint>

namespace dynamic_filter::sim {

/// Finalizer of splitmix64 (Steele et al., OOPSLA 2014): every input bit affects every output bit.
constexpr std::uint64_t mix(std::uint64_t x) {
    x += 0x9e3779b97f4a7c15ULL;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
    return x ^ (x >> 31);
}

constexpr std::uint64_t hash(std::uint64_t a, std::uint64_t b) { return mix(mix(a) ^ b); }
constexpr std::uint64_t hash(std::uint64_t a, std::uint64_t b, std::uint64_t c) {
    return hash(hash(a, b), c);
}

/// Uniform in [0, 1).
constexpr double unit(std::uint64_t bits) { return static_cast<double>(bits >> 11) * 0x1.0p-53; }

/// A standard normal number (Box and Muller 1958) from the two hashes that follow `bits`.
double normal(std::uint64_t bits);

/// A sequence of random numbers, for code that runs once and in order (building scenes). Compilers
/// evaluate the arguments of a call in any order, so at most one of them may draw.
struct Random {
    std::uint64_t key = 0;
    std::uint64_t count = 0;

    std::uint64_t bits() { return hash(key, count++); }
    double uniform(double low, double high) { return low + (high - low) * unit(bits()); }
    /// Uniform in {0, ..., n - 1}.
    int below(int n) { return static_cast<int>(unit(bits()) * n); }
    bool chance(double probability) { return unit(bits()) < probability; }
};

}  // namespace dynamic_filter::sim
