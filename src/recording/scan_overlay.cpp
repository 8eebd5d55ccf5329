// SPDX-License-Identifier: MIT
#include "recording/scan_overlay.hpp"

#include "dynamic_filter/error.hpp"
#include "recording/recording_parts.hpp"
#include "tracking/upright.hpp"

namespace dynamic_filter::io {

ScanOverlay::ScanOverlay(std::size_t scans, const std::function<Cloud(std::size_t)>& read) {
    constexpr std::size_t kPlaces = 4;
    const auto add = [&](std::size_t i) {
        if (clouds_.contains(i)) return;
        try {
            clouds_.emplace(i, read(i));
        } catch (const InputError&) {
            return;  // a rejected scan
        }
    };
    for (std::size_t k = 0; k < kPlaces; ++k) {
        const std::size_t from = k * scans / kPlaces;
        for (const std::size_t apart : {2U, 8U, 20U}) {
            const std::size_t to = from + apart;
            if (to >= scans) continue;
            pairs_.push_back({from, to});
            add(from);
            add(to);
        }
    }
}

std::vector<std::size_t> ScanOverlay::scans() const {
    std::vector<std::size_t> scans;
    for (const auto& [i, cloud] : clouds_) scans.push_back(i);
    return scans;
}

double ScanOverlay::share(const std::function<Pose(std::size_t)>& poses,
                          bool points_in_world) const {
    std::map<std::size_t, Points> upright;
    for (const auto& [i, cloud] : clouds_) {
        const Pose pose = poses(i);
        if (!pose.matrix().allFinite()) continue;
        upright[i] =
            upright_points(points_in_world ? into_sensor(cloud, 1.0, pose) : positions(cloud));
    }
    double sum = 0.0;
    std::size_t count = 0;
    for (const Pair& pair : pairs_) {
        if (!clouds_.contains(pair.from) || !clouds_.contains(pair.to)) continue;
        ++count;
        const auto a = upright.find(pair.from), b = upright.find(pair.to);
        if (a == upright.end() || b == upright.end()) continue;
        sum += upright_overlay(a->second, b->second, poses(pair.from).inverse() * poses(pair.to));
    }
    return count == 0 ? 0.0 : sum / static_cast<double>(count);
}

bool overlays_better(double share, double than) {
    constexpr double kRatio = 1.03, kMore = 0.005;
    return share > kRatio * than + kMore;
}

}  // namespace dynamic_filter::io
