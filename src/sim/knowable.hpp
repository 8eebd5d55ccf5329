// SPDX-License-Identifier: MIT
/// What could be known of each point of a simulated recording.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "dynamic_filter/simulation.hpp"
#include "geometry/knowable.hpp"
#include "sim/seen_through.hpp"
#include "sim/thing_states.hpp"

namespace dynamic_filter::sim {

/// The beams of the returns of a scan, with the sensor where it was when it measured each.
std::vector<Beam> exact_beams(const Simulation& simulation, const SimulatedScan& scan);

/// First note() every scan in order, then look() at every one again, because only then it is known
/// which voxels are asked for; then decide(). Memory: the dynamic points and their voxels.
class Knowable {
public:
    void note(const SimulatedScan& scan, std::span<const Beam> beams);
    void look(std::span<const Beam> beams) { seen_through_.add_scan(beams); }
    void decide() { states_ = states_of(seen_, stamps_); }
    /// Parallel to the points of a scan; needs decide().
    [[nodiscard]] std::vector<KnowablePoint> of_scan(std::size_t scan) const;

private:
    struct DynamicPoint {
        std::uint32_t index, voxel, thing;
    };
    std::vector<std::vector<DynamicPoint>> dynamic_;  // by scan
    std::vector<std::size_t> points_;                 // by scan: their number
    std::vector<SeenThings> seen_;
    std::vector<double> stamps_;
    SeenThrough seen_through_;
    std::vector<StatesOfThings> states_;
};

}  // namespace dynamic_filter::sim
