// SPDX-License-Identifier: MIT
#include "export/octomap/octree_file.hpp"

#include <gtest/gtest.h>
#include <octomap/octomap.h>

#include <map>
#include <memory>
#include <sstream>

#include "support/random.hpp"

namespace dynamic_filter::app {
namespace octree_file_test {

constexpr double kVoxel = 0.1;  // [m]

/// Blocks of noise, blocks that are free throughout, and a cube of 16 of them that can be pruned.
std::vector<SeenBlock> sample_blocks() {
    test::Random random(11);
    std::map<VoxelKey, SeenBlock> blocks;
    for (int i = 0; i < 300; ++i) {
        const Eigen::Vector3i number = (10.0 * random.direction()).cast<int>();
        SeenBlock block{pack(kWalkBlock * number), random.next() & random.next(), random.next()};
        if (random.chance(0.3)) block = {block.corner, 0, ~std::uint64_t{0}};
        block.free &= ~block.occupied;
        blocks[block.corner] = block;
    }
    for (int i = 0; i < 64; ++i) {
        const Cell corner = Cell(-400, 800, 16) + kWalkBlock * Cell(i / 16, i / 4 % 4, i % 4);
        blocks[pack(corner)] = {pack(corner), ~std::uint64_t{0}, 0};
    }
    for (const Cell& outermost : {Cell(-32768, -32768, -32768), Cell(32764, 32764, 32764)}) {
        blocks[pack(outermost)] = {pack(outermost), 1, 2};
    }
    std::vector<SeenBlock> all;
    for (const auto& [corner, block] : blocks) all.push_back(block);
    return all;
}

std::unique_ptr<octomap::OcTree> read(const std::string& file, OctreeKind kind) {
    std::istringstream stream(file);
    if (kind == OctreeKind::full) {
        return std::unique_ptr<octomap::OcTree>(
            dynamic_cast<octomap::OcTree*>(octomap::AbstractOcTree::read(stream)));
    }
    auto tree = std::make_unique<octomap::OcTree>(1.0);
    return tree->readBinary(stream) ? std::move(tree) : nullptr;
}

class OctreeFile : public testing::TestWithParam<OctreeKind> {};

TEST_P(OctreeFile, IsReadByOctomap) {
    const std::vector<SeenBlock> blocks = sample_blocks();
    const auto tree = read(octree_file(blocks, kVoxel, GetParam()), GetParam());
    ASSERT_NE(tree, nullptr);
    EXPECT_EQ(tree->getResolution(), kVoxel);
    std::map<VoxelKey, SeenBlock> by_corner;
    for (const SeenBlock& block : blocks) by_corner[block.corner] = block;
    std::size_t known = 0, expected = 0;
    for (const auto& [corner, block] : by_corner) {
        expected += static_cast<std::size_t>(std::popcount(block.occupied | block.free));
        for (int i = 0; i < 64; ++i) {
            const Cell voxel = unpack(corner) + Cell(i / 16, i / 4 % 4, i % 4);
            const Eigen::Vector3d middle = (voxel.cast<double>().array() + 0.5) * kVoxel;
            const auto* const node = tree->search(middle.x(), middle.y(), middle.z());
            const bool is_occupied = (block.occupied & bit_in_block(voxel)) != 0;
            const bool is_free = (block.free & bit_in_block(voxel)) != 0;
            ASSERT_EQ(node != nullptr, is_occupied || is_free);
            if (node == nullptr) continue;
            EXPECT_EQ(tree->isNodeOccupied(node), is_occupied);
            EXPECT_FLOAT_EQ(node->getLogOdds(), is_occupied ? tree->getClampingThresMaxLog()
                                                            : tree->getClampingThresMinLog());
        }
    }
    for (auto leaf = tree->begin_leafs(); leaf != tree->end_leafs(); ++leaf) {
        known += std::size_t{1} << (3 * (tree->getTreeDepth() - leaf.getDepth()));
    }
    EXPECT_EQ(known, expected);  // and nothing else
}

TEST_P(OctreeFile, IsPruned) {
    const auto tree = read(octree_file(sample_blocks(), kVoxel, GetParam()), GetParam());
    ASSERT_NE(tree, nullptr);
    const std::size_t nodes = tree->size();
    tree->prune();
    EXPECT_EQ(tree->size(), nodes);
}

TEST_P(OctreeFile, DoesNotDependOnTheOrder) {
    std::vector<SeenBlock> blocks = sample_blocks();
    const std::string file = octree_file(blocks, kVoxel, GetParam());
    std::reverse(blocks.begin(), blocks.end());
    EXPECT_EQ(octree_file(blocks, kVoxel, GetParam()), file);
}

INSTANTIATE_TEST_SUITE_P(Kinds, OctreeFile, testing::Values(OctreeKind::binary, OctreeKind::full));

}  // namespace octree_file_test
}  // namespace dynamic_filter::app
