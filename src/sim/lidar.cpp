// SPDX-License-Identifier: MIT
#include "lidar.hpp"

#include <algorithm>
#include <cmath>

#include "dynamic_filter/parallel.hpp"
#include "portable.hpp"
#include "random.hpp"

namespace dynamic_filter::sim {
namespace {

struct Echo {
    float range = 0.0F;  // 0: no return
    float intensity = 0.0F;
    Kind kind = Kind::structure;
};

/// The returned power falls with range squared, incidence and reflectivity (Lambert); what is
/// weak is lost more often.
double detection(const Hit& hit, double max_range) {
    constexpr double gain = 4.0;  // white, facing, at the maximum range: 98 % return
    const double ratio = max_range / static_cast<double>(hit.range);
    const double power = static_cast<double>(hit.reflectivity * hit.cosine) * ratio * ratio;
    return 0.998 * (1.0 - portable_exp(-gain * std::min(power, 10.0)));
}

Echo measure(const Hit& hit, const Sensor& sensor, std::uint64_t bits) {
    constexpr double resolution = 0.002;  // [m] as the sensors' own formats
    if (!hit.found || static_cast<double>(hit.range) < sensor.min_range) return {};
    if (unit(hash(bits, 3)) >= detection(hit, sensor.max_range)) return {};
    const double noisy = static_cast<double>(hit.range) + sensor.sigma * normal(bits);
    const double range = resolution * std::floor(noisy / resolution + 0.5);
    if (range < sensor.min_range || range > sensor.max_range) return {};
    const float shade = hit.reflectivity * std::sqrt(hit.cosine);
    return {static_cast<float>(range), std::clamp(shade, 0.0F, 1.0F), hit.kind};
}

}  // namespace

Returns sense(const Caster& caster, const Sensor& sensor, const Pose& T_world_sensor,
              std::uint64_t seed, std::size_t scan) {
    const auto directions = ray_directions(sensor, seed, scan);
    const Eigen::Matrix3f R = T_world_sensor.linear().cast<float>();
    const Eigen::Vector3f origin = T_world_sensor.translation().cast<float>();
    const auto reach = static_cast<float>(sensor.max_range);
    std::vector<Echo> echoes(directions.size());
    parallel_for(directions.size(), 1024, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const Hit hit = caster.cast(origin, R * directions[i], reach);
            echoes[i] = measure(hit, sensor, hash(hash(seed, 0x11da2), scan, i));
        }
    });
    Returns out;
    for (std::size_t i = 0; i < echoes.size(); ++i) {
        if (echoes[i].range == 0.0F) continue;
        out.points.emplace_back(directions[i] * echoes[i].range);
        out.intensity.push_back(echoes[i].intensity);
        out.labels.push_back(is_dynamic(echoes[i].kind) ? Label::dynamic : Label::static_);
        out.kinds.push_back(echoes[i].kind);
    }
    return out;
}

}  // namespace dynamic_filter::sim
