// SPDX-License-Identifier: MIT
#include "paper/merge.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "support/random.hpp"

namespace dynamic_filter {
namespace merge_test {

constexpr double kSize = 0.5;

Pose at(const Eigen::Vector3d& place) {
    Pose pose = Pose::Identity();
    pose.translation() = place;
    return pose;
}

TEST(Merge, TheNearestPoseAmongThoseWithAnOpinionDecidesAndTiesGoToTheEarlier) {
    test::Random random(1);
    for (int repeat = 0; repeat < 50; ++repeat) {
        VoxelIndex index;
        for (int i = 0; i < 100; ++i) {
            index.insert(pack((random.point(4.0).array() * 2.0F).floor().cast<int>().matrix()));
        }
        std::vector<LocalMap> locals(6);
        std::vector<Pose> poses;
        for (LocalMap& local : locals) {
            for (std::uint32_t v = 0; v < index.size(); ++v) {
                if (!random.chance(0.4)) continue;
                local.voxels.push_back(v);
                local.probability.push_back(random.uniform_f(0.0, 1.0));
            }
            // Lattice poses in between voxels, some twice: many equal distances.
            poses.push_back(at(random.point(3.0).array().round().matrix().cast<double>()));
        }
        poses[3] = poses[1];
        MergedMap merged;
        for (std::size_t q = 0; q < 6; ++q) merge(merged, locals[q], poses[q], index, kSize);
        for (std::uint32_t v = 0; v < index.size(); ++v) {
            const Point c = center(index.key(v), static_cast<float>(kSize));
            std::optional<float> expected;
            double nearest = std::numeric_limits<double>::infinity();
            for (std::size_t q = 0; q < 6; ++q) {
                for (std::size_t i = 0; i < locals[q].voxels.size(); ++i) {
                    const double d = (c.cast<double>() - poses[q].translation()).squaredNorm();
                    if (locals[q].voxels[i] != v || d >= nearest) continue;
                    nearest = d;
                    expected = locals[q].probability[i];
                }
            }
            ASSERT_EQ(merged.probability[v], expected);
            ASSERT_EQ(merged.distance_sq[v], nearest);
        }
    }
}

TEST(Merge, VoxelsWithoutAnOpinionStayWithoutOne) {
    VoxelIndex index;
    for (int x = 0; x < 3; ++x) index.insert(pack({x, 0, 0}));
    MergedMap merged;
    merge(merged, {{1}, {0.5F}}, Pose::Identity(), index, kSize);
    EXPECT_EQ(merged.probability,
              (std::vector<std::optional<float>>{std::nullopt, 0.5F, std::nullopt}));
}

TEST(Merge, GrowsWithTheIndexAndKeepsWhatWasDecided) {
    VoxelIndex index;
    index.insert(pack({0, 0, 0}));
    MergedMap merged;
    merge(merged, {{0}, {0.25F}}, Pose::Identity(), index, kSize);
    index.insert(pack({9, 0, 0}));
    merge(merged, {{0, 1}, {0.75F, 0.5F}}, at({50, 0, 0}), index, kSize);
    EXPECT_EQ(merged.probability, (std::vector<std::optional<float>>{0.25F, 0.5F}));
}

TEST(Merge, OfEmptyMapsIsEmpty) {
    MergedMap merged;
    merge(merged, {}, Pose::Identity(), {}, kSize);
    EXPECT_TRUE(merged.probability.empty());
}

}  // namespace merge_test
}  // namespace dynamic_filter
