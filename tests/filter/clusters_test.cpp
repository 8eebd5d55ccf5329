// SPDX-License-Identifier: MIT
#include "filter/clusters.hpp"

#include <gtest/gtest.h>

#include <set>

namespace dynamic_filter {
namespace clusters_test {

/// Points 1.8 m below the sensor: flat ground, and what is put on it.
struct Place {
    Points points;
    std::vector<int> things;  // of each point; -1: ground

    Place() {
        for (float x = -20.0F; x < 20.0F; x += 0.5F) {
            for (float y = -20.0F; y < 20.0F; y += 0.5F) add({x, y, -1.8F}, -1);
        }
    }
    void add(const Point& p, int thing) {
        points.push_back(p);
        things.push_back(thing);
    }
    void add_box(int thing, const Point& low, const Point& high) {
        for (float x = low.x(); x <= high.x(); x += 0.2F) {
            for (float y = low.y(); y <= high.y(); y += 0.2F) {
                for (float z = low.z(); z <= high.z(); z += 0.2F) add({x, y, z}, thing);
            }
        }
    }
    [[nodiscard]] Clusters clusters() const {
        const PointVoxels voxels(points.size(), 0);
        return find_clusters(points, voxels, ScansConfig{}.instances);
    }
    /// The clusters of a thing's points that stand out from the ground.
    [[nodiscard]] std::set<std::uint32_t> clusters_of(int thing) const {
        const Clusters found = clusters();
        std::set<std::uint32_t> result;
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (things[i] == thing && points[i].z() > -1.5F) result.insert(found.of_points[i]);
        }
        return result;
    }
};

TEST(FindClusters, ThingsThatStandApartAreTwo) {
    Place place;
    place.add_box(0, {5.0F, 0.0F, -1.8F}, {5.4F, 0.4F, -0.2F});
    place.add_box(1, {5.0F, 2.0F, -1.8F}, {9.4F, 3.6F, -0.4F});
    const auto person = place.clusters_of(0), car = place.clusters_of(1);
    ASSERT_EQ(person.size(), 1U);
    ASSERT_EQ(car.size(), 1U);
    EXPECT_NE(*person.begin(), *car.begin());
    EXPECT_EQ(place.clusters().count, 2U);
}

TEST(FindClusters, TheGroundIsNoCluster) {
    const Place place;
    EXPECT_EQ(place.clusters().count, 0U);
    EXPECT_EQ(place.clusters_of(-1).size(), 0U);
}

TEST(FindClusters, NorIsAWallOrACanopy) {
    Place place;
    place.add_box(0, {-15.0F, 6.0F, -1.8F}, {15.0F, 6.2F, 1.0F});
    place.add_box(1, {-3.0F, -6.0F, 2.0F}, {3.0F, -3.0F, 2.2F});
    EXPECT_EQ(place.clusters_of(0), std::set{kNoCluster});
    EXPECT_EQ(place.clusters_of(1), std::set{kNoCluster});
}

TEST(FindClusters, WhatTouchesAWallIsPartOfIt) {
    Place place;
    place.add_box(0, {-15.0F, 6.0F, -1.8F}, {15.0F, 6.2F, 1.0F});
    place.add_box(1, {0.0F, 5.6F, -1.8F}, {0.4F, 6.0F, -0.2F});
    EXPECT_EQ(place.clusters_of(1), std::set{kNoCluster});
}

TEST(FindClusters, PointsOfNoVoxelAndBeyondTheReachAreLeftOut) {
    Place place;
    place.add_box(0, {70.0F, 0.0F, -1.8F}, {70.4F, 0.4F, -0.2F});
    EXPECT_EQ(place.clusters_of(0), std::set{kNoCluster});
    place.add_box(1, {5.0F, 0.0F, -1.8F}, {5.4F, 0.4F, -0.2F});
    const PointVoxels none(place.points.size(), kNoVoxel);
    EXPECT_EQ(find_clusters(place.points, none, ScansConfig{}.instances).count, 0U);
    EXPECT_EQ(find_clusters({}, {}, ScansConfig{}.instances).count, 0U);
}

}  // namespace clusters_test
}  // namespace dynamic_filter
