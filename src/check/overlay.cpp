// SPDX-License-Identifier: MIT
#include "check/overlay.hpp"

#include <tsl/robin_set.h>

#include "dynamic_filter/poses.hpp"
#include "geometry/voxel.hpp"

namespace dynamic_filter::io {
namespace {

using Voxels = tsl::robin_set<VoxelKey, VoxelHash>;
constexpr float kVoxel = 0.3F;  // [m]

Voxels voxels_of(const Points& points) {
    Voxels voxels;
    for (const Point& p : points) {
        if (const auto cell = cell_of(p, 1.0F / kVoxel)) voxels.insert(pack(*cell));
    }
    return voxels;
}

Points thinned(const Points& points) {
    constexpr std::size_t kMost = 2000;
    const std::size_t step = points.size() / kMost + 1;
    Points thin;
    for (std::size_t i = 0; i < points.size(); i += step) thin.push_back(points[i]);
    return thin;
}

double share_inside(const Points& points, const Pose& T_to_from, const Voxels& voxels) {
    if (points.empty()) return 0.0;
    const Eigen::Isometry3f transform = T_to_from.cast<float>();
    std::size_t inside = 0;
    for (const Point& p : points) {
        const auto cell = cell_of(transform * p, 1.0F / kVoxel);
        inside += cell && voxels.contains(pack(*cell)) ? 1 : 0;
    }
    return static_cast<double>(inside) / static_cast<double>(points.size());
}

std::vector<Reading> all_readings() {
    std::vector<Reading> all = {{kAsGiven, [](const Pose& pose) { return pose; }}};
    for (const PoseFix fix : pose_fixes()) {
        all.push_back({to_string(fix), [fix](const Pose& pose) { return fixed(fix, pose); },
                       fix == PoseFix::relative});
    }
    all.push_back({kPointsInFeet, [](const Pose& pose) {
                       Pose longer = pose;
                       longer.translation() /= 0.3048;
                       return longer;
                   }});
    all.push_back({kInWorld, [](const Pose&) { return Pose(Pose::Identity()); }});
    all.push_back({kInSensor, [](const Pose& pose) { return pose * pose; }});
    return all;
}

}  // namespace

const std::vector<Reading>& readings() {
    static const std::vector<Reading> all = all_readings();
    return all;
}

Pose pose_of(const Sample& sample, const Reading& reading) {
    return reading.pose(reading.is_chained ? sample.T_world_chained : sample.T_world_sensor);
}

std::vector<Overlay> compare(const Samples& samples, const std::vector<Pair>& pairs) {
    const std::vector<Reading>& all = readings();
    std::vector<Overlay> overlays;
    for (const Reading& reading : all) overlays.push_back({reading.name, 0.0});
    std::size_t compared = 0, of = SIZE_MAX;
    Voxels voxels;
    for (const Pair& pair : pairs) {
        const auto a = samples.find(pair.from), b = samples.find(pair.from + pair.apart);
        if (a == samples.end() || b == samples.end()) continue;
        if (of != pair.from) voxels = voxels_of(a->second.upright);
        of = pair.from;
        const Points points = thinned(b->second.upright);
        for (std::size_t r = 0; r < all.size(); ++r) {
            const Pose T_a_b = pose_of(a->second, all[r]).inverse() * pose_of(b->second, all[r]);
            overlays[r].share += share_inside(points, T_a_b, voxels);
        }
        ++compared;
    }
    if (compared == 0) return {};
    for (Overlay& overlay : overlays) overlay.share /= static_cast<double>(compared);
    return overlays;
}

double overlay_of(const Points& from, const Points& to, const Pose& T_from_to) {
    return share_inside(thinned(to), T_from_to, voxels_of(from));
}

Search search_around(const Sample& a, const Sample& b) {
    constexpr double kShiftStep = 0.5, kTurnStep = 2.0 * 3.14159265 / 180.0;
    const Voxels voxels = voxels_of(a.upright);
    Points points = thinned(b.upright);
    for (std::size_t i = 0; 4 * i < points.size(); ++i) points[i] = points[4 * i];
    points.resize((points.size() + 3) / 4);
    const Pose T_a_b = a.T_world_sensor.inverse() * b.T_world_sensor;
    Search search;
    search.given = search.best = share_inside(points, T_a_b, voxels);
    for (int x = -5; x <= 5; ++x) {
        for (int y = -5; y <= 5; ++y) {
            for (int turn = -2; turn <= 2; ++turn) {
                const Eigen::Vector3d offset(kShiftStep * x, kShiftStep * y, 0.0);
                const Pose moved = T_a_b * Eigen::Translation3d(offset) *
                                   Eigen::AngleAxisd(kTurnStep * turn, Eigen::Vector3d::UnitZ());
                const double share = share_inside(points, moved, voxels);
                if (share > search.best) search = {search.given, share, offset.norm()};
            }
        }
    }
    return search;
}

}  // namespace dynamic_filter::io
