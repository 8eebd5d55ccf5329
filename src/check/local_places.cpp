// SPDX-License-Identifier: MIT
#include "check/local_places.hpp"

#include <algorithm>

#include "check/meeting_places.hpp"
#include "check/place_offset.hpp"
#include "dynamic_filter/parallel.hpp"

namespace dynamic_filter::io {
namespace {

constexpr double kApart = 5.0;  // [m] of the way

/// One scan after each kApart of the way, or less often, so that there are `most` at most.
std::vector<std::size_t> places_along(const Positions& positions, std::size_t most) {
    const std::vector<double> way = way_of(positions);
    if (way.empty()) return {};
    const double spacing = std::max(kApart, way.back() / static_cast<double>(most));
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < positions.size(); ++i) {
        if (!positions[i].allFinite()) continue;
        if (places.empty() || way[i] - way[places.back()] >= spacing) places.push_back(i);
    }
    return places;
}

}  // namespace

std::vector<Local> locals_of(std::span<const Recording* const> drives, std::size_t most) {
    std::vector<Local> locals;
    std::vector<Positions> positions;
    for (std::size_t d = 0; d < drives.size(); ++d) {
        positions.push_back(positions_of(*drives[d]));
        for (const std::size_t scan :
             places_along(positions.back(), std::max<std::size_t>(1, most / drives.size()))) {
            locals.push_back({{d, scan}, positions[d][scan], {}});
        }
    }
    parallel_for(locals.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            Local& local = locals[k];
            const Positions& of_drive = positions[local.place.drive];
            local.cloud = cloud_around(*drives[local.place.drive],
                                       scans_around(of_drive, local.place.scan, 2.0, 2), local.at);
            local.signature = signature_of(local.cloud);
        }
    });
    return locals;
}

}  // namespace dynamic_filter::io
