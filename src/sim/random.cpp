// SPDX-License-Identifier: MIT
#include "sim/random.hpp"

#include <cmath>
#include <numbers>

#include "sim/portable.hpp"

namespace dynamic_filter::sim {

double normal(std::uint64_t bits) {
    const double u = 1.0 - unit(hash(bits, 1));  // (0, 1]
    const double angle = 2.0 * std::numbers::pi * unit(hash(bits, 2));
    return std::sqrt(-2.0 * portable_log(u)) * portable_sincos(angle).cos;
}

}  // namespace dynamic_filter::sim
