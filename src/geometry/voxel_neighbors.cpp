// SPDX-License-Identifier: MIT
#include "geometry/voxel_neighbors.hpp"

namespace dynamic_filter {

void VoxelNeighbors::update(const VoxelIndex& index) {
    const auto known = static_cast<std::uint32_t>(around_.size());
    around_.resize(index.blocks());
    for (std::uint32_t block = known; block < index.blocks(); ++block) {
        const Cell home = index.corner(block);
        for (std::size_t b = 0; b < around_[block].size(); ++b) {
            const auto step = [&](std::size_t of) { return 4 * (static_cast<int>(of % 3) - 1); };
            const Cell corner = home + Cell(step(b / 9), step(b / 3), step(b));
            const auto other = fits(corner) ? index.find_block(pack(corner)) : std::nullopt;
            around_[block][b] = other.value_or(kNoBlock);
            // The other block has this block as its neighbor in the opposite direction.
            if (other) around_[*other][around_[block].size() - 1 - b] = block;
        }
    }
}

}  // namespace dynamic_filter
