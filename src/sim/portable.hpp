// SPDX-License-Identifier: MIT
/// Elementary functions from IEEE basic operations only. Those of the C library may differ in the
/// last bit between processors; as a crowd is a chaotic system, its trajectories would then differ.
#pragma once

namespace dynamic_filter::sim {

struct SinCos {
    double sin = 0.0;
    double cos = 1.0;
};

double portable_exp(double x);     ///< relative error < 1e-12 for |x| < 700
double portable_log(double x);     ///< x > 0; absolute error < 1e-12
SinCos portable_sincos(double x);  ///< absolute error < 1e-12 for |x| < 1e5

}  // namespace dynamic_filter::sim
