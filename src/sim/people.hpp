// SPDX-License-Identifier: MIT
/// Drawing of who walks: body sizes, speeds, companies, and where along their route they start.
#pragma once

#include <functional>
#include <vector>

#include "crowd.hpp"
#include "obstacles.hpp"
#include "random.hpp"

namespace dynamic_filter::sim {

/// Adult (1.5 to 1.95 m) or, one time in ten, child (1.0 to 1.35 m).
Walker draw_walker(Random& random);

/// Someone like `leader` who walks the same route at `offset` [m] to the left and talks where the
/// leader does.
Walker companion(const Walker& leader, double offset, Random& random);

/// Puts everyone somewhere along the own route, clear of obstacles and (if room allows) of others.
void scatter(std::vector<Walker>& walkers, const DistanceField& field, Random& random);

}  // namespace dynamic_filter::sim
