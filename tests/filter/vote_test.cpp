// SPDX-License-Identifier: MIT
#include "filter/vote.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "filter/evidence_map.hpp"
#include "support/filled_map.hpp"

namespace dynamic_filter {
namespace vote_test {

using test::drive;
using test::every_scan;
using test::filled;
using test::probability_of;

const DynamicScore score(ScansConfig{}.evidence);

/// Own score, that of the company and that of the neighbourhood, by asking all voxels of the map.
float brute_force_probability(const EvidenceMap& map, std::uint32_t voxel) {
    const Evidence& own = map.grid()[voxel].evidence;
    const Cell home = unpack(map.grid().voxels().key(voxel));
    const ScansConfig::Vote config;
    double company = 0.0, companions = config.alone, around = 0.0, neighbors = config.alone;
    for (std::uint32_t v = 0; v < map.grid().voxels().size(); ++v) {
        const int cells = (unpack(map.grid().voxels().key(v)) - home).cwiseAbs().maxCoeff();
        if (v == voxel || cells > 2) continue;
        const Evidence& e = map.grid()[v].evidence;
        const double value = is_unknown(e) ? 0.0 : std::max(score(e), -1.0F);
        const double looks = e.n_own + e.n_free, weight = looks / (looks + config.sure);
        const double together = weight * co_presence(own, e);
        const double share = weight * (cells == 1 ? 1.0 : config.far);
        company += together * value, companions += together;
        around += share * value, neighbors += share;
    }
    const double sum = (is_unknown(own) ? 0.0 : score(own)) +
                       config.company * company / companions +
                       config.neighborhood * around / neighbors;
    return static_cast<float>(1.0 / (1.0 + std::exp(3.0 * sum)));
}

TEST(OccupancyOf, ProbabilityAddsUpTheVoxelItsCompanyAndItsNeighborhood) {
    const EvidenceMap map = filled(drive(12, true), every_scan());
    std::vector<std::uint32_t> all(map.grid().voxels().size());
    std::iota(all.begin(), all.end(), 0U);
    const auto together = occupancy_of(map.grid(), all, ScansConfig{});
    int compared = 0;
    for (std::uint32_t v = 0; v < map.grid().voxels().size(); v += 11) {
        if (!together[v]) continue;
        ASSERT_NEAR(*probability_of(map, v), brute_force_probability(map, v), 1e-5F) << v;
        ASSERT_EQ(probability_of(map, v), together[v]);  // whoever else is asked about
        ++compared;
    }
    EXPECT_GT(compared, 100);
}

TEST(OccupancyOf, IsUnknownUntilAnotherKeyframeLookedAtTheVoxelOrAtANeighbor) {
    const auto scans = drive(2, false);
    const EvidenceMap one = filled({scans[0]}, every_scan());
    for (std::uint32_t v = 0; v < one.grid().voxels().size(); ++v)
        EXPECT_FALSE(probability_of(one, v));
    const EvidenceMap two = filled({scans[0], scans[0]}, every_scan());
    for (std::uint32_t v = 0; v < two.grid().voxels().size(); ++v) {
        if (!is_unknown(two.grid()[v].evidence)) {
            ASSERT_TRUE(probability_of(two, v).has_value());
        }
        EXPECT_GT(probability_of(two, v).value_or(1.0F), 0.5F);
    }
}

}  // namespace vote_test
}  // namespace dynamic_filter
