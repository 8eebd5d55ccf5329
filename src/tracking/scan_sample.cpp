// SPDX-License-Identifier: MIT
#include "tracking/scan_sample.hpp"

#include <algorithm>
#include <utility>

#include "geometry/voxel_index.hpp"

namespace dynamic_filter {
namespace {

// Largest number of points used; of larger scans, every second, third, ... point is used.
constexpr std::size_t kLookedAt = 60000;
constexpr double kMapSpacing = 0.4;  // in voxels of the map

/// Indices of the first point in each voxel.
std::vector<std::uint32_t> first_in_voxels(const Points& points, double size) {
    const auto per_metre = static_cast<float>(1.0 / size);
    const auto [keys, of_keys] = keys_of(points, per_metre);
    std::vector<std::uint32_t> voxels(keys.size());
    VoxelIndex().insert(keys, voxels);
    std::vector<std::uint32_t> first;
    for (std::size_t i = 0; i < voxels.size(); ++i) {
        if (voxels[i] == first.size()) first.push_back(of_keys[i]);
    }
    return first;
}

template <class IsChosen>
ScanSample some_of(const ScanSample& sample, const IsChosen& is_chosen) {
    ScanSample some;
    for (std::size_t i = 0; i < sample.points.size(); ++i) {
        if (!is_chosen(i)) continue;
        some.chosen.push_back(sample.chosen[i]);
        some.points.push_back(sample.points[i]);
        if (!sample.times.empty()) some.times.push_back(sample.times[i]);
    }
    return some;
}

ScanSample these_of(const ScanSample& sample, const std::vector<std::uint32_t>& places) {
    auto next = places.begin();
    return some_of(sample, [&](std::size_t i) {
        if (next == places.end() || *next != i) return false;
        ++next;
        return true;
    });
}

/// Every second, third, ... point of those within the range of the settings.
ScanSample in_range(const Points& points, std::span<const float> times,
                    const OdometryConfig& config) {
    const auto near = static_cast<float>(config.nearest * config.nearest);
    const auto far = static_cast<float>(config.farthest * config.farthest);
    const std::size_t stride = 1 + points.size() / kLookedAt;
    ScanSample usable;
    for (std::size_t i = 0; i < points.size(); i += stride) {
        const float range = points[i].squaredNorm();
        if (!is_measured(points[i]) || range < near || range > far) continue;
        usable.chosen.push_back(static_cast<std::uint32_t>(i));
        usable.points.push_back(points[i]);
        if (!times.empty()) usable.times.push_back(times[i]);
    }
    return usable;
}

}  // namespace

ScanSample sample_for_map(const Points& points, std::span<const float> times,
                          const OdometryConfig& config) {
    const ScanSample usable = in_range(points, times, config);
    return these_of(usable, first_in_voxels(usable.points, kMapSpacing * config.voxel));
}

ScanSample sample_for_registration(const ScanSample& of_map, const OdometryConfig& config) {
    std::vector<std::uint32_t> first = first_in_voxels(of_map.points, config.spacing);
    const auto most = static_cast<std::size_t>(config.points);
    if (first.size() > most) {
        for (std::size_t i = 0; i < most; ++i) first[i] = first[i * first.size() / most];
        first.resize(most);
    }
    return these_of(of_map, first);
}

Scan thinned_scan(const Scan& scan, const OdometryConfig& config) {
    ScanSample sample = sample_for_map(scan.points, scan.times, config);
    Scan thin{std::move(sample.points), scan.T_world_sensor, scan.stamp, scan.index, scan.has_pose,
              std::move(sample.times)};
    return thin;
}

ScanSample without_dynamic(const ScanSample& sample, const Labels& labels) {
    if (labels.empty()) return sample;
    return some_of(sample,
                   [&](std::size_t i) { return labels[sample.chosen[i]] != Label::dynamic; });
}

}  // namespace dynamic_filter
