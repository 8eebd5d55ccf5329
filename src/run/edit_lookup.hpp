// SPDX-License-Identifier: MIT
#pragma once

#include <tsl/robin_map.h>

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "base/numbers.hpp"
#include "run/edits.hpp"

namespace dynamic_filter::app {

/// Finds the label that the edits give a point, by one look-up for any number of edits. Immutable
/// once built; thread-safe.
class EditLookup {
public:
    explicit EditLookup(const Edits& edits);
    /// `world` [m]; `from`: the filter's verdict; `scan`: row, counted from 0 over the run's
    /// labels.
    [[nodiscard]] Label label_of(const Eigen::Vector3d& world, Label from,
                                 std::uint32_t scan) const;

private:
    using Key = std::array<std::int32_t, 4>;  // cell, verdict_code of `from`
    static constexpr std::uint32_t kNone = UINT32_MAX;
    /// An edit of a cell. `before`: the earlier edit, used for scans outside of this one's range.
    struct Entry {
        std::uint32_t first, last, before;
        Label label;
    };
    double cell_size_;
    tsl::robin_map<Key, std::uint32_t, NumbersHash> newest_;
    std::vector<Entry> entries_;
};

}  // namespace dynamic_filter::app
