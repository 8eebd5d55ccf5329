// SPDX-License-Identifier: MIT
#include "formats/voxel_map/heights.hpp"

#include <algorithm>

namespace dynamic_filter::app {

HeightRange usual_heights(const MapIndex& index) {
    std::vector<double> low, high;
    for (const MapTile& tile : index.tiles) {
        if (tile.voxels == 0) continue;
        low.push_back(tile.min.z());
        high.push_back(tile.max.z());
    }
    if (low.empty()) return {};
    std::sort(low.begin(), low.end());
    std::sort(high.begin(), high.end());
    const std::size_t cut = low.size() / 50;
    return {low[cut], std::max(high[high.size() - 1 - cut], low[cut] + 1.0)};
}

}  // namespace dynamic_filter::app
