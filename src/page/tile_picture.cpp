// SPDX-License-Identifier: MIT
#include "page/tile_picture.hpp"

#include <algorithm>
#include <cmath>

namespace dynamic_filter::app {

int picture_edge(const TileSquare& square, double voxel_size, int most) {
    const double voxels = std::floor(square.side / voxel_size + 1e-6);
    return static_cast<int>(std::clamp(voxels, 1.0, static_cast<double>(most)));
}

std::vector<std::uint8_t> picture_from_above(const TilePoints& points, const TileSquare& square,
                                             int edge, const HeightRange& heights) {
    const double pixels = edge / square.side;
    const auto pixel = [&](double at) {
        return std::clamp(static_cast<int>(at * pixels), 0, edge - 1);
    };
    std::vector<std::uint8_t> picture(static_cast<std::size_t>(edge) *
                                      static_cast<std::size_t>(edge));
    for (const Eigen::Vector3d& p : points.positions) {
        const int column = pixel(p.x() - square.west), row = edge - 1 - pixel(p.y() - square.south);
        const double share = (p.z() - heights.low) / (heights.high - heights.low);
        const auto value = static_cast<std::uint8_t>(1.0 + 254.0 * std::clamp(share, 0.0, 1.0));
        std::uint8_t& there = picture[static_cast<std::size_t>(row * edge + column)];
        there = std::max(there, value);
    }
    return picture;
}

}  // namespace dynamic_filter::app
