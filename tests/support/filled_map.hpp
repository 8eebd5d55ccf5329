// SPDX-License-Identifier: MIT
/// Maps of the method "scans" in which every scan is a keyframe.
#pragma once

#include <optional>
#include <vector>

#include "filter/evidence_map.hpp"
#include "filter/vote.hpp"
#include "support/room.hpp"

namespace dynamic_filter::test {

inline Config every_scan() {
    Config config;
    config.keyframe.interval = 0.0;
    return config;
}

inline EvidenceMap filled(const std::vector<RoomScan>& scans, const Config& config) {
    EvidenceMap map(config);
    StageTimes times;
    for (const auto& s : scans) {
        map.insert(s.scan, times);
        map.observe_elsewhere(times);
    }
    return map;
}

inline std::optional<float> probability_of(const EvidenceMap& map, std::uint32_t voxel) {
    return occupancy_of(map.grid(), {&voxel, 1}, ScansConfig{})[0];
}

}  // namespace dynamic_filter::test
