// SPDX-License-Identifier: MIT
#include "export/octomap/octree_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <span>

namespace dynamic_filter::app {

namespace {

constexpr int kChildren = 8;
constexpr int kRootLevel = 16, kBlockLevel = 2;  // a node of level n is 2^n voxels wide
constexpr std::size_t kFullBytes = 5, kBinaryBytes = 2;

/// In the order of what a node says of its children: the greatest.
enum class Space : std::uint8_t { unknown, free, occupied };

/// Of the probabilities .971 and .1192, at which OctoMap clamps.
float log_odds(Space space) { return space == Space::occupied ? 3.5110307F : -2.0000279F; }

struct Node {
    Space space = Space::unknown;
    bool has_children = false;  ///< false: all of it is alike
};

/// The bits of three numbers in turn; x is the lowest, as in the numbers of OctoMap's children.
std::uint64_t interleaved(const Cell& cell) {
    std::uint64_t bits = 0;
    for (int bit = 0; bit < kRootLevel; ++bit) {
        for (int axis = 0; axis < 3; ++axis) {
            bits |= static_cast<std::uint64_t>(cell[axis] >> bit & 1) << (3 * bit + axis);
        }
    }
    return bits;
}

/// A block whose voxels are in the order of the tree, each octant a byte.
struct TreeBlock {
    std::uint64_t place = 0;  // interleaved
    std::uint64_t occupied = 0, free = 0;
};

std::uint64_t in_order_of_tree(std::uint64_t mask) {
    static const auto places = [] {
        std::array<std::uint8_t, 64> table{};
        for (int x = 0; x < kWalkBlock; ++x) {
            for (int y = 0; y < kWalkBlock; ++y) {
                for (int z = 0; z < kWalkBlock; ++z) {
                    table[static_cast<std::size_t>(16 * x + 4 * y + z)] =
                        static_cast<std::uint8_t>(interleaved({x, y, z}));
                }
            }
        }
        return table;
    }();
    std::uint64_t ordered = 0;
    for (; mask != 0; mask &= mask - 1) {
        ordered |= std::uint64_t{1} << places[static_cast<std::size_t>(std::countr_zero(mask))];
    }
    return ordered;
}

std::vector<TreeBlock> sorted(const std::vector<SeenBlock>& blocks) {
    constexpr int kMiddle = 1 << (kRootLevel - 1);
    std::vector<TreeBlock> tree;
    tree.reserve(blocks.size());
    for (const SeenBlock& block : blocks) {
        const Cell corner = unpack(block.corner).array() + kMiddle;
        tree.push_back(
            {interleaved(corner), in_order_of_tree(block.occupied), in_order_of_tree(block.free)});
    }
    std::sort(tree.begin(), tree.end(),
              [](const TreeBlock& a, const TreeBlock& b) { return a.place < b.place; });
    return tree;
}

/// Writes nodes depth first, each before its children.
class TreeWriter {
public:
    explicit TreeWriter(OctreeKind kind) : is_full_(kind == OctreeKind::full) {}

    /// The node of a level whose blocks these are.
    Node node(std::span<const TreeBlock> blocks, int level) {
        if (blocks.empty()) return {};
        if (level == kBlockLevel) return node(blocks[0].occupied, blocks[0].free, level);
        return parent([&](std::uint64_t child) {
            const auto end = std::partition_point(blocks.begin(), blocks.end(), [&](auto& block) {
                return (block.place >> (3 * (level - 1)) & 7U) <= child;
            });
            const auto count = static_cast<std::size_t>(end - blocks.begin());
            const Node made = node(blocks.first(count), level - 1);
            blocks = blocks.subspan(count);
            return made;
        });
    }

    [[nodiscard]] const std::string& bytes() const { return bytes_; }
    [[nodiscard]] std::size_t nodes() const { return nodes_; }

private:
    /// A node within a block; its voxels are the lowest bits.
    Node node(std::uint64_t occupied, std::uint64_t free, int level) {
        if (level == 0) {
            return leaf((occupied & 1U) != 0 ? Space::occupied
                        : (free & 1U) != 0   ? Space::free
                                             : Space::unknown);
        }
        const int bits = level == 1 ? 1 : kChildren;
        return parent([&](std::uint64_t child) {
            return node(occupied >> (child * bits), free >> (child * bits), level - 1);
        });
    }

    /// `child(n)` writes child n. Children that are all alike are taken back: the node is a leaf.
    template <class Child>
    Node parent(const Child& child) {
        const std::size_t at = bytes_.size(), nodes_before = nodes_;
        bytes_.resize(at + (is_full_ ? kFullBytes : kBinaryBytes));
        ++nodes_;
        std::array<Node, kChildren> children;
        for (std::uint64_t n = 0; n < kChildren; ++n) children[n] = child(n);
        Node node{Space::unknown, false};
        for (const Node& one : children) {
            node.space = std::max(node.space, one.space);
            node.has_children |= one.has_children || one.space != children[0].space;
        }
        if (node.has_children) {
            is_full_ ? put_full(at, node, children) : put_binary(at, children);
            return node;
        }
        bytes_.resize(at);
        nodes_ = nodes_before;
        return leaf(node.space);
    }
    Node leaf(Space space) {
        if (space == Space::unknown) return {};
        ++nodes_;
        if (is_full_) {
            bytes_.resize(bytes_.size() + kFullBytes);
            put_full(bytes_.size() - kFullBytes, {space, false}, {});
        }
        return {space, false};
    }
    void put_full(std::size_t at, const Node& node, const std::array<Node, kChildren>& children) {
        unsigned there = 0;
        for (unsigned n = 0; n < kChildren; ++n) {
            if (children[n].space != Space::unknown) there |= 1U << n;
        }
        const float value = log_odds(node.space);
        std::memcpy(bytes_.data() + at, &value, sizeof value);
        bytes_[at + sizeof value] = static_cast<char>(there);
    }
    void put_binary(std::size_t at, const std::array<Node, kChildren>& children) {
        unsigned codes = 0;
        for (unsigned n = 0; n < kChildren; ++n) {
            const Node& child = children[n];
            const unsigned code = child.has_children               ? 3
                                  : child.space == Space::occupied ? 2
                                  : child.space == Space::free     ? 1
                                                                   : 0;
            codes |= code << (2 * n);
        }
        bytes_[at] = static_cast<char>(codes & 0xFFU);
        bytes_[at + 1] = static_cast<char>(codes >> 8U);
    }

    bool is_full_;
    std::string bytes_;
    std::size_t nodes_ = 0;
};

}  // namespace

std::string octree_file(const std::vector<SeenBlock>& blocks, double voxel, OctreeKind kind) {
    TreeWriter writer(kind);
    writer.node(sorted(blocks), kRootLevel);
    return fmt::format("# Octomap OcTree{} file\n#\nid OcTree\nsize {}\nres {}\ndata\n{}",
                       kind == OctreeKind::binary ? " binary" : "", writer.nodes(), voxel,
                       writer.bytes());
}

}  // namespace dynamic_filter::app
