// SPDX-License-Identifier: MIT
#include "sim/knowable.hpp"

#include <algorithm>
#include <limits>

#include "dynamic_filter/parallel.hpp"

namespace dynamic_filter::sim {

std::vector<Beam> exact_beams(const Simulation& simulation, const SimulatedScan& scan) {
    std::vector<Beam> beams(scan.points.size());
    const Pose at_stamp = simulation.exact_pose(scan.stamp);
    parallel_for(beams.size(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const Pose T_world_sensor =
                scan.times.empty() ? at_stamp
                                   : simulation.exact_pose(scan.stamp + double{scan.times[i]});
            beams[i] = {T_world_sensor.translation(),
                        T_world_sensor * scan.points[i].cast<double>()};
        }
    });
    return beams;
}

void Knowable::note(const SimulatedScan& scan, std::span<const Beam> beams) {
    std::vector<DynamicPoint> dynamic;
    std::vector<Eigen::Vector3d> world;
    std::vector<std::uint32_t> things;
    for (std::size_t i = 0; i < beams.size(); ++i) {
        const std::uint32_t thing = thing_of(scan.kinds[i], scan.instances[i]);
        if (thing == 0) continue;
        const std::uint32_t voxel = seen_through_.ask_for(beams[i].end);
        dynamic.push_back({static_cast<std::uint32_t>(i), voxel, thing});
        world.push_back(beams[i].end);
        things.push_back(thing);
    }
    dynamic_.push_back(std::move(dynamic));
    points_.push_back(beams.size());
    seen_.push_back(seen_things(world, things));
    stamps_.push_back(scan.stamp);
}

std::vector<KnowablePoint> Knowable::of_scan(std::size_t scan) const {
    constexpr std::uint32_t kMost = std::numeric_limits<std::uint16_t>::max();
    std::vector<KnowablePoint> points(points_[scan]);
    for (const DynamicPoint& p : dynamic_[scan]) {
        const StateOfThing& thing = states_[scan].at(p.thing);
        const std::uint32_t beams = seen_through_.beams_through(p.voxel);
        points[p.index] = {static_cast<std::uint16_t>(std::min(beams, kMost)), thing.state,
                           thing.is_seen_moving};
    }
    return points;
}

}  // namespace dynamic_filter::sim
