// SPDX-License-Identifier: MIT
/// Draws the walkers: body sizes, speeds, companies, and starting points on their routes.
#pragma once

#include <functional>
#include <vector>

#include "sim/crowd.hpp"
#include "sim/obstacles.hpp"
#include "sim/random.hpp"

namespace dynamic_filter::sim {

/// An adult (1.5 to 1.95 m) or, with a probability of one tenth, a child (1.0 to 1.35 m).
Walker draw_walker(Random& random);

/// A walker like `leader`, on the same route at `offset` [m] to the left, who talks where the
/// leader talks.
Walker companion(const Walker& leader, double offset, Random& random);

/// Places all walkers somewhere on their routes, clear of obstacles and, if there is room, of each
/// other.
void scatter(std::vector<Walker>& walkers, const DistanceField& field, Random& random);

}  // namespace dynamic_filter::sim
