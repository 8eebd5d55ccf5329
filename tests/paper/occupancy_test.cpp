// SPDX-License-Identifier: MIT
#include "paper/occupancy.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "paper/submap.hpp"
#include "support/random.hpp"

namespace dynamic_filter {
namespace occupancy_test {

const Point kRay = Point(1.0F, 0.05F, 0.05F).normalized();

ImageGrid sphere() { return make_grid(0.1F, 0.1F, -1.5707F, 1.5707F); }

BackEndConfig config_with(double depth, bool check = true, bool correction = true) {
    BackEndConfig config;
    config.depth_channel = depth;
    config.visibility_check = check;
    config.incident_correction = correction;
    config.incident_threshold_deg = 75.0;
    return config;
}

/// Submaps with their voxels numbered, and the local map that they make.
struct Scene {
    std::vector<BufferedSubmap> submaps;
    VoxelIndex index;

    void add(const Points& points, const Points& normals) {
        BufferedSubmap b;
        b.submap.points = points;
        b.normals = normals;
        std::set<std::uint32_t> ids;
        for (const Point& p : points) ids.insert(index.insert(*voxel_of(p, 0.2F)));
        b.voxels.assign(ids.begin(), ids.end());
        submaps.push_back(b);
    }
    [[nodiscard]] std::vector<const BufferedSubmap*> nearby() const {
        std::vector<const BufferedSubmap*> all;
        for (const auto& b : submaps) all.push_back(&b);
        return all;
    }
    [[nodiscard]] LocalMap local_map(const Pose& pose, const BackEndConfig& config) const {
        std::vector<std::uint32_t> scratch(index.size(), 0);
        auto owned = count_owners(nearby(), scratch);
        EXPECT_EQ(scratch, std::vector<std::uint32_t>(index.size(), 0));
        return occupancy(std::move(owned), check_visibility(nearby(), pose, sphere(), config),
                         index, 0.2F, pose, sphere(), config);
    }
    [[nodiscard]] float probability_at(const Point& p, const BackEndConfig& config) const {
        const LocalMap local = local_map(Pose::Identity(), config);
        const auto id = index.find(*voxel_of(p, 0.2F));
        const auto it = std::find(local.voxels.begin(), local.voxels.end(), *id);
        return local.probability[static_cast<std::size_t>(it - local.voxels.begin())];
    }
};

/// One line of sight with cells A < B < C < D, five submaps: three own A, two B, four C. The last
/// one meets B at a grazing angle, so its boundary ends there although it owns D behind.
Scene figure_4a() {
    const Point a = 4.0F * kRay, b = 6.0F * kRay, c = 8.0F * kRay, d = 10.0F * kRay;
    const Point grazing = Point(-kRay.y(), kRay.x(), 0.0F).normalized();
    Scene scene;
    scene.add({a, c}, {kRay, kRay});
    scene.add({a, c}, {kRay, kRay});
    scene.add({a, b, c}, {kRay, kRay, kRay});
    scene.add({c}, {kRay});
    scene.add({b, d}, {grazing, kRay});
    return scene;
}

TEST(Occupancy, CountsAsInFigure4a) {
    const Scene scene = figure_4a();
    for (const double depth : {0.5, 1.0}) {
        const auto config = config_with(depth);
        EXPECT_FLOAT_EQ(scene.probability_at(4.0F * kRay, config), 3.0F / 5.0F);
        EXPECT_FLOAT_EQ(scene.probability_at(6.0F * kRay, config), 2.0F / 5.0F);
        EXPECT_FLOAT_EQ(scene.probability_at(8.0F * kRay, config), 4.0F / 4.0F);
        EXPECT_FLOAT_EQ(scene.probability_at(10.0F * kRay, config),
                        1.0F / 1.0F);  // its owner counts
    }
}

TEST(Occupancy, WithoutIncidentCorrectionTheGrazingSubmapSeesFarther) {
    const Scene scene = figure_4a();
    const auto config = config_with(0.5, true, false);
    EXPECT_FLOAT_EQ(scene.probability_at(4.0F * kRay, config), 3.0F / 5.0F);
    EXPECT_FLOAT_EQ(scene.probability_at(6.0F * kRay, config), 2.0F / 5.0F);
    EXPECT_FLOAT_EQ(scene.probability_at(8.0F * kRay, config), 4.0F / 5.0F);
}

TEST(Occupancy, WithoutVisibilityCheckEveryNearbySubmapCounts) {
    const Scene scene = figure_4a();
    const auto config = config_with(0.5, false);
    EXPECT_FLOAT_EQ(scene.probability_at(4.0F * kRay, config), 3.0F / 5.0F);
    EXPECT_FLOAT_EQ(scene.probability_at(8.0F * kRay, config), 4.0F / 5.0F);
    EXPECT_FLOAT_EQ(scene.probability_at(10.0F * kRay, config), 1.0F / 5.0F);
}

Scene random_scene(test::Random& random, std::size_t submaps, std::size_t points,
                   double half_width) {
    Scene scene;
    for (std::size_t j = 0; j < submaps; ++j) {
        Points normals;
        for (std::size_t i = 0; i < points; ++i)
            normals.push_back(random.direction().cast<float>());
        scene.add(random.points(points, half_width), normals);
    }
    return scene;
}

TEST(Occupancy, AgreesWithBruteForceAndNCheckIsNeverBelowNOcc) {
    test::Random random(1);
    for (const std::size_t count : {1, 2, 7, 63, 64}) {
        for (const double depth : {0.2, 0.0}) {
            const Scene scene = random_scene(random, count, 200, 2.0);
            const Pose pose = random.pose(1.0, 3.0);
            const auto config = config_with(depth), blind = config_with(depth, false);
            const auto boundaries = check_visibility(scene.nearby(), pose, sphere(), config);
            const LocalMap local = scene.local_map(pose, config),
                           all = scene.local_map(pose, blind);
            ASSERT_EQ(local.voxels.size(), scene.index.size());
            for (std::size_t i = 0; i < local.voxels.size(); ++i) {
                const Point at = center(scene.index.key(local.voxels[i]), 0.2F);
                Projection seen;
                project(std::span(&at, 1), pose.inverse().cast<float>(), sphere(), seen);
                int n_occ = 0, n_check = 0;
                for (std::size_t j = 0; j < count; ++j) {
                    const auto& own = scene.submaps[j].voxels;
                    const bool owns =
                        std::find(own.begin(), own.end(), local.voxels[i]) != own.end();
                    const bool reaches =
                        seen.pixel[0] >= 0 &&
                        boundaries[j][static_cast<std::size_t>(seen.pixel[0])] >=
                            depth_channel(seen.range[0], static_cast<float>(depth));
                    n_occ += owns ? 1 : 0;
                    n_check += owns || reaches ? 1 : 0;
                }
                ASSERT_EQ(local.probability[i],
                          static_cast<float>(n_occ) / static_cast<float>(n_check));
                ASSERT_LE(local.probability[i], 1.0F);
                ASSERT_EQ(all.probability[i],
                          static_cast<float>(n_occ) / static_cast<float>(count));
            }
        }
    }
}

TEST(Occupancy, ManyVoxelsAreThoseOfFewOnes) {
    test::Random random(2);  // more voxels than one thread takes at once
    const Scene scene = random_scene(random, 3, 4000, 20.0);
    const LocalMap local = scene.local_map(Pose::Identity(), config_with(0.2));
    ASSERT_GT(local.voxels.size(), 9000U);
    const auto boundaries =
        check_visibility(scene.nearby(), Pose::Identity(), sphere(), config_with(0.2));
    std::vector<std::uint32_t> scratch(scene.index.size(), 0);
    const Ownership owned = count_owners(scene.nearby(), scratch);
    for (std::size_t i = 0; i < owned.voxels.size(); i += 13) {
        const LocalMap one =
            occupancy({{owned.voxels[i]}, {owned.owners[i]}}, boundaries, scene.index, 0.2F,
                      Pose::Identity(), sphere(), config_with(0.2));
        ASSERT_EQ(one.probability[0], local.probability[i]);
    }
}

TEST(Occupancy, AnEmptyPixelCountsNothing) {
    Scene scene;
    scene.add({5.0F * kRay}, {kRay});
    scene.add({-5.0F * kRay}, {kRay});
    EXPECT_EQ(scene.probability_at(5.0F * kRay, config_with(0.2)), 1.0F);
    EXPECT_EQ(scene.probability_at(5.0F * kRay, config_with(0.0)), 1.0F);
}

TEST(Occupancy, AVoxelAtTheQueryPoseItselfCountsItsOwners) {
    Scene scene;
    const Point middle = center(pack({3, 4, 5}), 0.2F);
    scene.add({middle, 5.0F * kRay}, {kRay, kRay});
    Pose pose = Pose::Identity();
    pose.translation() = middle.cast<double>();
    const LocalMap local = scene.local_map(pose, config_with(0.2));
    EXPECT_EQ(local.probability, (std::vector<float>{1.0F, 1.0F}));
}

TEST(CountOwners, ListsVoxelsInTheOrderTheyAreMetWithOneBitPerOwner) {
    std::vector<BufferedSubmap> submaps(64);
    for (std::uint32_t j = 0; j < 64; ++j) submaps[j].voxels = {j % 2, 2 + j};
    std::vector<const BufferedSubmap*> nearby;
    for (const auto& s : submaps) nearby.push_back(&s);
    std::vector<std::uint32_t> scratch(100, 0);
    const Ownership owned = count_owners(nearby, scratch);
    ASSERT_EQ(owned.voxels.size(), 66U);
    EXPECT_EQ(std::vector<std::uint32_t>(owned.voxels.begin(), owned.voxels.begin() + 5),
              (std::vector<std::uint32_t>{0, 2, 1, 3, 4}));
    EXPECT_EQ(owned.owners[0], 0x5555555555555555ULL);
    EXPECT_EQ(owned.owners[2], 0xaaaaaaaaaaaaaaaaULL);
    EXPECT_EQ(owned.owners[65], std::uint64_t{1} << 63);
    EXPECT_EQ(scratch, std::vector<std::uint32_t>(100, 0));
}

TEST(CountOwners, OfNoSubmapsIsEmpty) {
    std::vector<std::uint32_t> scratch;
    EXPECT_TRUE(count_owners({}, scratch).voxels.empty());
}

}  // namespace occupancy_test
}  // namespace dynamic_filter
