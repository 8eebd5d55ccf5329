// SPDX-License-Identifier: MIT
#include "filter/tracks.hpp"

#include <gtest/gtest.h>

namespace dynamic_filter {
namespace tracks_test {

const ScansConfig::Instances config;
const Point nowhere = Point::Zero();
constexpr float kJump = 0.8F;  // [m] config.jump

Cluster cluster_at(const Point& center, std::size_t voxels, float length = 1.0F) {
    Cluster cluster;
    cluster.voxels.resize(voxels);
    cluster.center = center;
    const Point half(0.5F * length, 0.2F, 0.4F);
    cluster.box = {center - half, center + half};
    return cluster;
}

/// Seen at second 0.
Track track_at(const Point& center, std::size_t voxels, const Point& velocity, int views = 5) {
    Track track;
    track.velocity = velocity;
    track.views = views;
    track.dynamic_scans = velocity.norm() > 0.0F ? 3 : 0;
    const Cluster cluster = cluster_at(center, voxels);
    track.seen = {0.0, center, cluster.box, Points(voxels, center)};
    return track;
}

struct Matching {
    std::map<TrackId, Track> tracks;
    std::vector<Cluster> clusters;
    Point sensor_velocity = Point::Zero();

    /// After half a second.
    std::optional<TrackId> of(std::size_t cluster) {
        for (Cluster& c : clusters) c.track.reset();
        match(clusters, tracks, 0.5, sensor_velocity, config);
        return clusters[cluster].track;
    }
};

TEST(Match, WhatMovesIsWhereItShouldBe) {
    Matching m;
    m.tracks[7] = track_at({0.0F, 0.0F, 0.0F}, 20, {4.0F, 0.0F, 0.0F});
    m.clusters = {cluster_at({1.5F, 0.0F, 0.0F}, 20), cluster_at({2.1F, 0.0F, 0.0F}, 20)};
    EXPECT_EQ(m.of(0), std::nullopt);
    EXPECT_EQ(m.of(1), 7U);  // nearer to 2 m
    m.clusters = {cluster_at({2.0F + kJump + 0.05F, 0.0F, 0.0F}, 20)};
    EXPECT_EQ(m.of(0), std::nullopt);
}

TEST(Match, WhatStandsOnAKnownPlaceIsNotWhatMovesPastIt) {
    Matching m;
    m.tracks[1] = track_at({2.2F, 0.0F, 0.0F}, 20, nowhere);
    m.tracks[7] = track_at({0.0F, 0.0F, 0.0F}, 20, {4.0F, 0.0F, 0.0F});
    m.clusters = {cluster_at({2.2F, 0.0F, 0.0F}, 20)};
    m.clusters[0].shared[1] = 12;
    EXPECT_EQ(m.of(0), 1U);
    m.clusters[0].shared[1] = 11;  // of 20: fewer than six in ten
    EXPECT_EQ(m.of(0), 7U);
}

TEST(Match, OtherwiseTheMostPlacesInCommonDecide) {
    Matching m;
    m.tracks[1] = track_at({0.0F, 0.0F, 0.0F}, 20, nowhere);
    m.tracks[2] = track_at({0.5F, 0.0F, 0.0F}, 20, nowhere);
    m.clusters = {cluster_at({0.2F, 0.0F, 0.0F}, 20)};
    m.clusters[0].shared = {{1, 5}, {2, 6}};
    EXPECT_EQ(m.of(0), 2U);
    m.clusters[0].shared = {{1, 3}, {2, 3}};  // fewer than a fifth
    EXPECT_EQ(m.of(0), std::nullopt);
}

TEST(Match, ATrackGoesOnOnce) {
    Matching m;
    m.tracks[1] = track_at({0.0F, 0.0F, 0.0F}, 20, nowhere);
    m.clusters = {cluster_at({0.0F, 0.0F, 0.0F}, 20), cluster_at({0.3F, 0.0F, 0.0F}, 20)};
    m.clusters[0].shared[1] = 8;
    m.clusters[1].shared[1] = 9;
    EXPECT_EQ(m.of(1), 1U);
    EXPECT_EQ(m.of(0), std::nullopt);
}

TEST(Match, WhatWasSeenOnceMayMoveAsTheSensorDoes) {
    Matching m;
    m.tracks[3] = track_at({10.0F, 0.0F, 0.0F}, 20, nowhere, 1);
    m.clusters = {cluster_at({13.0F, 0.0F, 0.0F}, 20)};
    EXPECT_EQ(m.of(0), std::nullopt);
    m.sensor_velocity = {6.0F, 0.0F, 0.0F};
    EXPECT_EQ(m.of(0), 3U);
    m.tracks[3].views = 2;  // and was seen at rest
    EXPECT_EQ(m.of(0), std::nullopt);
}

TEST(Match, WhatHasAnotherSizeIsAnotherThing) {
    Matching m;
    m.tracks[7] = track_at({0.0F, 0.0F, 0.0F}, 20, {4.0F, 0.0F, 0.0F});
    const Point there(2.0F, 0.0F, 0.0F);
    for (const auto& [voxels, length, fits] : {std::tuple(63U, 1.0F, true),
                                               {64U, 1.0F, false},
                                               {5U, 1.0F, false},
                                               {6U, 1.0F, true},
                                               {20U, 1.75F, true},
                                               {20U, 1.85F, false}}) {
        m.clusters = {cluster_at(there, voxels, length)};
        EXPECT_EQ(m.of(0).has_value(), fits) << voxels << ' ' << length;
    }
}

TEST(ExpectedStep, GoesOnAsBeforeOrWithTheSensor) {
    const Point sensor(3.0F, 0.0F, 0.0F);
    const Track known = track_at(nowhere, 20, {1.0F, 2.0F, 0.0F}, 2);
    EXPECT_EQ(expected_step(known, 0.5, sensor), Point(0.5F, 1.0F, 0.0F));
    const Track once = track_at(nowhere, 20, nowhere, 1);
    EXPECT_EQ(expected_step(once, 0.5, sensor), Point(1.5F, 0.0F, 0.0F));
}

}  // namespace tracks_test
}  // namespace dynamic_filter
