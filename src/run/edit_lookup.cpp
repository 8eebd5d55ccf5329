// SPDX-License-Identifier: MIT
#include "run/edit_lookup.hpp"

#include <cmath>

#include "geometry/verdict_code.hpp"

namespace dynamic_filter::app {

EditLookup::EditLookup(const Edits& edits) : cell_size_(edits.cell_size) {
    for (const Edit& edit : edits.edits) {
        for (std::int32_t from = 0; from < 3; ++from) {
            for (const CellRun& run : edit.cells[static_cast<std::size_t>(from)]) {
                for (std::uint32_t k = 0; k < run.count; ++k) {
                    const Key key{run.x + static_cast<std::int32_t>(k), run.y, run.z, from};
                    const auto entry = static_cast<std::uint32_t>(entries_.size());
                    const auto [at, is_new] = newest_.emplace(key, entry);
                    const bool of_all = !edit.scans.has_value();
                    entries_.push_back({of_all ? 0U : edit.scans->first,
                                        of_all ? UINT32_MAX : edit.scans->second,
                                        is_new ? kNone : at->second, edit.label});
                    at.value() = entry;
                }
            }
        }
    }
}

Label EditLookup::label_of(const Eigen::Vector3d& world, Label from, std::uint32_t scan) const {
    Key key{0, 0, 0, verdict_code(from)};
    for (int axis = 0; axis < 3; ++axis) {
        const double cell = std::floor(world[axis] / cell_size_);
        if (!(std::abs(cell) < 2e9)) return from;  // no cell has that number, nor has NaN one
        key[static_cast<std::size_t>(axis)] = static_cast<std::int32_t>(cell);
    }
    const auto found = newest_.find(key);
    if (found == newest_.end()) return from;
    for (std::uint32_t at = found->second; at != kNone; at = entries_[at].before) {
        if (entries_[at].first <= scan && scan <= entries_[at].last) return entries_[at].label;
    }
    return from;
}

}  // namespace dynamic_filter::app
