// SPDX-License-Identifier: MIT
#include "filter/vote.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/best_kernel.hpp"
#include "dynamic_filter/parallel.hpp"
#include "filter/vote_kernel.hpp"

namespace dynamic_filter {

namespace {

/// The voxels that may vote on the voxels of a block. Cells are counted from the first cell of the
/// block.
struct Neighborhood {
    // Cells of a block and of the two cells around it.
    static constexpr std::size_t kMost = 8 * 8 * 8;
    using Column = std::array<float, kMost>;
    Column x{}, y{}, z{}, weight{}, score{}, first{}, last{};
    std::size_t count = 0;
    std::array<std::uint32_t, kMost> voters{};  // kNoVoxel: too far away
    std::array<Cell, kMost> cells{};

    /// Collects the voters for the voxels `asked`, which all lie in this block. A voxel that is too
    /// far from all of them keeps its slot, so that sums are rounded in the same way for any
    /// selection, but its data are not read.
    void gather(const EvidenceGrid& grid, std::uint32_t block, const Eigen::AlignedBox3i& asked,
                float sure) {
        constexpr int kReach = 2;
        const Cell low = asked.min().array() - kReach, high = asked.max().array() + kReach;
        count = 0;
        grid.neighbors().each_around(
            grid.voxels(), kReach, block, [&](std::uint32_t v, const Cell& cell) {
                const bool near =
                    (cell.array() >= low.array()).all() && (cell.array() <= high.array()).all();
                if (near) __builtin_prefetch(&grid[v]);
                voters[count] = near ? v : kNoVoxel;
                cells[count++] = cell;
            });
        for (std::size_t i = 0; i < count; ++i) {
            if (voters[i] == kNoVoxel) {
                x[i] = kernel::kOutOfReach;
            } else {
                add(i, grid[voters[i]], sure);
            }
        }
        while (count % kernel::kVoters != 0) x[count++] = kernel::kOutOfReach;
    }
    void add(std::size_t i, const EvidenceGrid::State& voter, float sure) {
        const Evidence& e = voter.evidence;
        const auto looks = static_cast<float>(e.n_own + e.n_free);
        x[i] = static_cast<float>(cells[i].x());
        y[i] = static_cast<float>(cells[i].y());
        z[i] = static_cast<float>(cells[i].z());
        weight[i] = looks / (looks + sure);
        score[i] = weight[i] * std::max(voter.score, -1.0F);
        first[i] = static_cast<float>(e.first_owner);
        last[i] = static_cast<float>(e.last_owner);
    }
    [[nodiscard]] float vote_on(const Cell& cell, const Evidence& e,
                                const ScansConfig::Vote& config) const {
        static const auto kernel = DYNAMIC_FILTER_BEST_KERNEL(vote);
        return kernel({.x = x.data(),
                       .y = y.data(),
                       .z = z.data(),
                       .weight = weight.data(),
                       .score = score.data(),
                       .first = first.data(),
                       .last = last.data(),
                       .count = count,
                       .own_x = static_cast<float>(cell.x()),
                       .own_y = static_cast<float>(cell.y()),
                       .own_z = static_cast<float>(cell.z()),
                       .own_first = static_cast<float>(e.first_owner),
                       .own_last = static_cast<float>(e.last_owner),
                       .company = static_cast<float>(config.company),
                       .neighborhood = static_cast<float>(config.neighborhood),
                       .far = static_cast<float>(config.far),
                       .alone = static_cast<float>(config.alone)});
    }
};

/// Upper limit of the occupancy of a voxel whose points belonged to moving objects. It is one half
/// at the share at which the voxel is dynamic.
float rest_of(const Evidence& e, const ScansConfig::Instances& config) {
    if (e.moved == 0) return 1.0F;
    const float moved = static_cast<float>(e.moved) / static_cast<float>(e.n_own);
    return std::max(1.0F - 0.5F * moved / static_cast<float>(config.share), 0.0F);
}

}  // namespace

std::vector<std::optional<float>> occupancy_of(const EvidenceGrid& grid,
                                               std::span<const std::uint32_t> voxels,
                                               const ScansConfig& scans) {
    const ScansConfig::Vote& config = scans.vote;
    // Pairs of block and index in `voxels`.
    std::vector<std::pair<std::uint32_t, std::size_t>> by_block;
    for (std::size_t i = 0; i < voxels.size(); ++i) {
        by_block.emplace_back(grid.voxels().block_of_voxel(voxels[i]), i);
    }
    std::sort(by_block.begin(), by_block.end());
    std::vector<std::optional<float>> result(voxels.size());
    const auto steepness = static_cast<float>(config.steepness);
    const auto sure = static_cast<float>(config.sure);
    constexpr std::size_t kGrain = 512;
    parallel_for(by_block.size(), kGrain, [&](std::size_t begin, std::size_t end) {
        Neighborhood neighborhood;
        for (std::size_t i = begin; i < end; ++i) {
            const auto [block, at] = by_block[i];
            const auto cell_of_voxel = [&, corner = grid.voxels().corner(block)](std::uint32_t v) {
                return Cell(unpack(grid.voxels().key(v)) - corner);
            };
            if (i == begin || by_block[i - 1].first != block) {
                Eigen::AlignedBox3i asked;
                std::size_t next = i;
                for (; next < end && by_block[next].first == block; ++next) {
                    asked.extend(cell_of_voxel(voxels[by_block[next].second]));
                }
                if (next < end) {
                    grid.neighbors().prefetch(grid.voxels(), by_block[next].first);
                    grid.neighbors().prefetch_row(by_block[std::min(next + 8, end - 1)].first);
                }
                neighborhood.gather(grid, block, asked, sure);
            }
            const std::uint32_t v = voxels[at];
            const float vote = neighborhood.vote_on(cell_of_voxel(v), grid[v].evidence, config);
            if (vote == 0.0F && is_unknown(grid[v].evidence)) continue;
            const float occupancy = 1.0F / (1.0F + std::exp(steepness * (grid[v].score + vote)));
            result[at] = std::min(occupancy, rest_of(grid[v].evidence, scans.instances));
        }
    });
    return result;
}

}  // namespace dynamic_filter
