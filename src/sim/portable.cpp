// SPDX-License-Identifier: MIT
#include "sim/portable.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dynamic_filter::sim {

double portable_exp(double x) {
    x = std::clamp(x, -700.0, 700.0);
    const double k = std::floor(x / std::numbers::ln2 + 0.5);
    const double r = x - k * std::numbers::ln2;  // |r| <= 0.35
    double sum = 1.0;
    for (int n = 13; n > 0; --n) sum = 1.0 + sum * r / n;
    return std::ldexp(sum, static_cast<int>(k));
}

double portable_log(double x) {
    int exponent = 0;
    double m = std::frexp(x, &exponent);  // [0.5, 1)
    if (m < std::numbers::sqrt2 / 2.0) {
        m *= 2.0;
        --exponent;
    }
    const double z = (m - 1.0) / (m + 1.0);  // log m = 2 atanh z, |z| < 0.172
    const double z2 = z * z;
    double sum = 0.0;
    for (int n = 17; n > 0; n -= 2) sum = sum * z2 + 1.0 / n;
    return 2.0 * z * sum + exponent * std::numbers::ln2;
}

SinCos portable_sincos(double x) {
    const double quarter = std::numbers::pi / 2.0;
    const double k = std::floor(x / quarter + 0.5);
    const double r = x - k * quarter;  // |r| <= 0.79
    const double r2 = r * r;
    double s = 1.0;
    double c = 1.0;
    for (int n = 16; n > 0; n -= 2) {
        s = 1.0 - s * r2 / (n * (n + 1));
        c = 1.0 - c * r2 / (n * (n - 1));
    }
    s *= r;
    switch (static_cast<long long>(k) & 3) {
        case 0:
            return {s, c};
        case 1:
            return {c, -s};
        case 2:
            return {-s, -c};
        default:
            return {-c, s};
    }
}

}  // namespace dynamic_filter::sim
