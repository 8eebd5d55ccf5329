// SPDX-License-Identifier: MIT
#include "sim/lidar.hpp"

#include <algorithm>
#include <cmath>

#include "dynamic_filter/motion.hpp"
#include "dynamic_filter/parallel.hpp"
#include "sim/portable.hpp"
#include "sim/random.hpp"
#include "sim/strongest_return.hpp"

namespace dynamic_filter::sim {
namespace {

struct Echo {
    float range = 0.0F;  // 0: no return
    float intensity = 0.0F;
    Kind kind = Kind::structure;
    std::uint16_t instance = 0;
};

/// Probability of a return. The returned power depends on range squared, incidence angle and
/// reflectivity (Lambert); weak returns are lost more often.
double detection(const Hit& hit, double max_range) {
    constexpr double gain = 4.0;  // a white surface at the maximum range, seen head-on: 98 % return
    const double ratio = max_range / static_cast<double>(hit.range);
    const double power = static_cast<double>(hit.reflectivity * hit.cosine) * ratio * ratio;
    return 0.998 * (1.0 - portable_exp(-gain * std::min(power, 10.0)));
}

Echo measure(const Hit& hit, const Sensor& sensor, std::uint64_t bits) {
    constexpr double resolution = 0.002;  // [m] as in the data formats of real sensors
    if (!hit.found || static_cast<double>(hit.range) < sensor.min_range) return {};
    if (unit(hash(bits, 3)) >= detection(hit, sensor.max_range)) return {};
    const double noisy = static_cast<double>(hit.range) + sensor.sigma * normal(bits);
    const double range = resolution * std::floor(noisy / resolution + 0.5);
    if (range < sensor.min_range || range > sensor.max_range) return {};
    const float shade = hit.reflectivity * std::sqrt(hit.cosine);
    return {static_cast<float>(range), std::clamp(shade, 0.0F, 1.0F), hit.kind, hit.instance};
}

/// The rays of one scan; they are cast in parts.
struct Shot {
    const Caster& caster;
    const Sensor& sensor;
    const std::vector<Eigen::Vector3f>& directions;
    std::uint64_t seed;
    std::size_t scan;

    void cast(std::size_t first, std::size_t last, const SweepPose& T_world_sensor,
              Returns& out) const;
};

void Shot::cast(std::size_t first, std::size_t last, const SweepPose& T_world_sensor,
                Returns& out) const {
    const auto reach = static_cast<float>(sensor.max_range);
    const auto share_of = [&](std::size_t i) {
        return static_cast<double>(i) / static_cast<double>(directions.size());
    };
    std::vector<Echo> echoes(last - first);
    parallel_for(echoes.size(), 1024, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const Pose pose = T_world_sensor(share_of(first + i));
            const Eigen::Vector3f origin = pose.translation().cast<float>();
            const Eigen::Vector3f ray = pose.linear().cast<float>() * directions[first + i];
            echoes[i] = measure(strongest_return(caster, origin, ray, reach), sensor,
                                hash(hash(seed, 0x11da2), scan, first + i));
        }
    });
    for (std::size_t i = 0; i < echoes.size(); ++i) {
        if (echoes[i].range == 0.0F) continue;
        out.points.emplace_back(directions[first + i] * echoes[i].range);
        out.intensity.push_back(echoes[i].intensity);
        out.labels.push_back(is_dynamic(echoes[i].kind) ? Label::dynamic : Label::static_);
        out.kinds.push_back(echoes[i].kind);
        out.instances.push_back(echoes[i].instance);
        out.shares.push_back(static_cast<float>(share_of(first + i)));
    }
}

}  // namespace

Returns sense(const Caster& caster, const Sensor& sensor, const Pose& T_world_sensor,
              std::uint64_t seed, std::size_t scan) {
    const auto directions = ray_directions(sensor, seed, scan);
    Returns out;
    Shot{caster, sensor, directions, seed, scan}.cast(
        0, directions.size(), [&](double) { return T_world_sensor; }, out);
    return out;
}

Returns sweep(const Caster& caster, const Sensor& sensor, const SweepPose& T_world_sensor,
              const std::function<void(double)>& begin_slice, std::uint64_t seed,
              std::size_t scan) {
    constexpr std::size_t kSlices = 32;
    const auto directions = ray_directions(sensor, seed, scan);
    const Shot shot{caster, sensor, directions, seed, scan};
    Returns out;
    Pose begin = T_world_sensor(0.0);
    for (std::size_t k = 0; k < kSlices; ++k) {
        const auto share = [](std::size_t slices) { return static_cast<double>(slices) / kSlices; };
        begin_slice(share(k) + 0.5 / kSlices);
        const Pose end = T_world_sensor(share(k + 1));
        const Twist motion = log(begin.inverse() * end);
        const auto within = [&](double s) {
            return begin * exp((s - share(k)) * kSlices * motion);
        };
        shot.cast(k * directions.size() / kSlices, (k + 1) * directions.size() / kSlices, within,
                  out);
        begin = end;
    }
    return out;
}

}  // namespace dynamic_filter::sim
