// SPDX-License-Identifier: MIT
#include "sim/sensors.hpp"

#include <numbers>

#include "sim/degree.hpp"
#include "sim/portable.hpp"
#include "sim/random.hpp"

namespace dynamic_filter::sim {
namespace {

Eigen::Vector3f direction(const SinCos& a, const SinCos& e) {
    return Eigen::Vector3d(e.cos * a.cos, e.cos * a.sin, e.sin).cast<float>();
}

/// Two prisms that rotate at incommensurate speeds (as in Liu et al., "A Low-Cost and
/// High-Precision Scanning LiDAR", 2021): the sum of two rotating deflections, 70.4 x 77.2 degrees.
std::vector<Eigen::Vector3f> rosette(const Sensor& sensor, std::uint64_t seed, std::size_t scan) {
    constexpr double period = 0.1;              // [s] of one scan
    constexpr double turns_1 = 7294.0 / 60.0;   // [1/s]
    constexpr double turns_2 = -4664.3 / 60.0;  // [1/s]
    constexpr double half_width = 35.2 * degree, half_height = 38.6 * degree;
    const auto rays = static_cast<std::size_t>(sensor.columns);
    const double phase = unit(hash(seed, 0x705e));
    std::vector<Eigen::Vector3f> out(rays);
    for (std::size_t i = 0; i < rays; ++i) {
        const double t = period * (static_cast<double>(scan) +
                                   static_cast<double>(i) / static_cast<double>(rays));
        const SinCos a = portable_sincos(2.0 * std::numbers::pi * (turns_1 * t + phase));
        const SinCos b = portable_sincos(2.0 * std::numbers::pi * turns_2 * t);
        out[i] = direction(portable_sincos(half_width * 0.5 * (a.cos + b.cos)),
                           portable_sincos(half_height * 0.5 * (a.sin + b.sin)));
    }
    return out;
}

}  // namespace

const std::vector<Sensor>& sensor_table() {
    static const std::vector<Sensor> table = {
        {.name = "vlp16", .beams = 16, .top_deg = 15.0, .bottom_deg = -15.0, .columns = 1800},
        {.name = "hdl32", .beams = 32, .top_deg = 10.67, .bottom_deg = -30.67, .columns = 1084},
        {.name = "os64",
         .beams = 64,
         .top_deg = 22.5,
         .bottom_deg = -22.5,
         .columns = 2048,
         .sigma = 0.025},
        {.name = "hdl64",
         .beams = 64,
         .top_deg = 2.0,
         .bottom_deg = -24.8,
         .columns = 2083,
         .max_range = 120.0},
        {.name = "os128",
         .beams = 128,
         .top_deg = 22.5,
         .bottom_deg = -22.5,
         .columns = 1024,
         .sigma = 0.025},
        {.name = "solid", .columns = 24000, .max_range = 150.0},
    };
    return table;
}

std::vector<Eigen::Vector3f> ray_directions(const Sensor& sensor, std::uint64_t seed,
                                            std::size_t scan) {
    if (sensor.beams == 0) return rosette(sensor, seed, scan);
    const double start = unit(hash(seed, 0xa21, scan));
    const double spacing = (sensor.bottom_deg - sensor.top_deg) / (sensor.beams - 1);
    std::vector<SinCos> elevations;
    elevations.reserve(static_cast<std::size_t>(sensor.beams));
    for (int beam = 0; beam < sensor.beams; ++beam) {
        elevations.push_back(portable_sincos((sensor.top_deg + spacing * beam) * degree));
    }
    std::vector<Eigen::Vector3f> out;
    out.reserve(static_cast<std::size_t>(sensor.columns) * elevations.size());
    for (int column = 0; column < sensor.columns; ++column) {
        const SinCos a =
            portable_sincos(-2.0 * std::numbers::pi * (column + start) / sensor.columns);
        for (const SinCos& e : elevations) out.push_back(direction(a, e));
    }
    return out;
}

}  // namespace dynamic_filter::sim
