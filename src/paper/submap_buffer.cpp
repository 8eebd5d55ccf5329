// SPDX-License-Identifier: MIT
#include "paper/submap_buffer.hpp"

#include <algorithm>
#include <tuple>

namespace dynamic_filter {

std::vector<std::size_t> search_radius(const std::vector<BufferedSubmap>& buffer,
                                       const Eigen::Vector3d& position, double radius,
                                       std::size_t most, std::size_t anchor) {
    // Distance, difference of indices, index.
    std::vector<std::tuple<double, std::size_t, std::size_t>> found;
    for (std::size_t i = 0; i < buffer.size(); ++i) {
        const double d = (buffer[i].submap.T_map_submap.translation() - position).norm();
        if (d <= radius) found.emplace_back(d, i > anchor ? i - anchor : anchor - i, i);
    }
    std::sort(found.begin(), found.end());
    if (found.size() > most) found.resize(most);
    std::vector<std::size_t> indices;
    for (const auto& [distance, age, index] : found) indices.push_back(index);
    return indices;
}

}  // namespace dynamic_filter
