// SPDX-License-Identifier: MIT
/// Tables, pictures and the page of changes.
#pragma once

#include <string>
#include <vector>

#include "draw/png.hpp"
#include "dynamic_filter/types.hpp"
#include "upkeep/changes.hpp"
#include "upkeep/unseen.hpp"

namespace dynamic_filter::app {

struct ChangesOfMap {
    std::vector<Change> went, came;
    SeenVoxels voxels;
};

/// changes.csv: a row for each change; `number` is that of the field `change` in its cloud.
std::string changes_csv(const ChangesOfMap& changes);
/// changes.json: the same, and how many voxels were seen at which date.
std::string changes_json(const ChangesOfMap& changes);
/// index.html: a slider between old.png and new.png, and the changes, largest first.
std::string changes_page(const ChangesOfMap& changes);

/// What rests at a date and what changed, from above. `kept` and `changed` are relative to the same
/// origin for both dates; `box` is what the picture shows.
io::Image date_from_above(const Points& kept, const Points& changed, const Eigen::AlignedBox3f& box,
                          const io::Color& color);

inline constexpr io::Color kCameColor{20, 140, 60};

}  // namespace dynamic_filter::app
