// SPDX-License-Identifier: MIT
/// Tells by the scans which of several readings of a recording is right, where nothing else does.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <vector>

#include "dynamic_filter/cloud.hpp"
#include "dynamic_filter/types.hpp"

namespace dynamic_filter::io {

/// Some scans at several places of a recording.
class ScanOverlay {
public:
    /// Reads about 15 scans; those that cannot be read are left out.
    ScanOverlay(std::size_t scans, const std::function<Cloud(std::size_t)>& read);
    /// The scans that were read.
    [[nodiscard]] std::vector<std::size_t> scans() const;

    /// Mean share, 0..1, of the upright structures of a scan that stand where those of another scan
    /// stand, which is 2 to 20 scans apart, at these poses. `poses`: by scan; those of scans()
    /// count.
    [[nodiscard]] double share(const std::function<Pose(std::size_t)>& poses,
                               bool points_in_world = false) const;

private:
    struct Pair {
        std::size_t from, to;
    };
    std::vector<Pair> pairs_;
    std::map<std::size_t, Cloud> clouds_;
};

/// True if the share of a reading is larger than another one by more than chance.
bool overlays_better(double share, double than);

}  // namespace dynamic_filter::io
