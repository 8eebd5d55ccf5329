// SPDX-License-Identifier: MIT
/// Finds the mirrors, and the panes that reflect beams, of a map.
#pragma once

#include <vector>

#include "dynamic_filter/settings.hpp"
#include "filter/evidence_map.hpp"
#include "filter/mirror.hpp"

namespace dynamic_filter {

/// Lets the kept keyframes observe what lies behind the mirrors anew, without the beams that were
/// reflected: these seemed to pass through it. Keyframes that are no longer kept do not count.
void observe_behind(const std::vector<Mirror>& mirrors, EvidenceMap& map);

/// The mirrors of the map that the kept keyframes saw. Source: docs/how-it-works.md, "Mirrors".
std::vector<Mirror> find_mirrors(const EvidenceMap& map, const ScansConfig::Mirrors& config);

}  // namespace dynamic_filter
