// SPDX-License-Identifier: MIT
#include "check/overlay.hpp"

#include <gtest/gtest.h>

#include "support/random.hpp"

namespace dynamic_filter::io {
namespace overlay_test {

/// What a sensor sees from each pose of the same scattered things.
Samples seen_from(const std::vector<Pose>& poses) {
    test::Random random(1);
    const Points things = random.points(3000, 20.0);
    Samples samples;
    for (std::size_t i = 0; i < poses.size(); ++i) {
        samples[i].T_world_sensor = poses[i];
        for (const Point& p : things) {
            samples[i].upright.push_back(poses[i].inverse().cast<float>() * p);
        }
    }
    return samples;
}

std::vector<Pose> along_a_curve() {
    std::vector<Pose> poses;
    for (int i = 0; i < 4; ++i) {
        Pose pose = Pose::Identity();
        pose.translation() = Eigen::Vector3d(1.7 * i + 5.0, 0.6 * i, 0.1 * i);
        pose.linear() =
            Eigen::AngleAxisd(0.2 * i + 0.3, Eigen::Vector3d::UnitZ()).toRotationMatrix();
        poses.push_back(pose);
    }
    return poses;
}

double share_of(const std::vector<Overlay>& overlays, const std::string& name) {
    for (const Overlay& overlay : overlays) {
        if (overlay.reading == name) return overlay.share;
    }
    ADD_FAILURE() << name;
    return -1.0;
}

// The same things are in other voxels as seen from elsewhere, so the share is less than one.
TEST(Overlay, IsLargeForTheReadingThatIsTrue) {
    const std::vector<Pair> pairs{{0, 1}, {0, 3}};
    Samples samples = seen_from(along_a_curve());
    auto overlays = compare(samples, pairs);
    ASSERT_EQ(overlays.size(), readings().size());
    EXPECT_EQ(overlays.front().reading, kAsGiven);
    EXPECT_GT(share_of(overlays, kAsGiven), 0.9);
    EXPECT_LT(share_of(overlays, "inverse"), 0.3);
    EXPECT_LT(share_of(overlays, kInWorld), 0.3);
    for (auto& [index, sample] : samples) {
        sample.T_world_sensor = Pose(sample.T_world_sensor.inverse());
    }
    overlays = compare(samples, pairs);
    EXPECT_GT(share_of(overlays, "inverse"), 0.9);
    EXPECT_LT(share_of(overlays, kAsGiven), 0.3);
}

TEST(Overlay, OnlyPairsThatWereReadAreCompared) {
    Samples samples = seen_from(along_a_curve());
    samples.erase(1);
    EXPECT_TRUE(compare(samples, {{0, 1}}).empty());
    const auto both = compare(samples, {{0, 1}, {0, 3}}), one = compare(samples, {{0, 3}});
    EXPECT_EQ(share_of(both, kAsGiven), share_of(one, kAsGiven));
}

TEST(Search, FindsHowFarAPoseIsOff) {
    Samples samples = seen_from(along_a_curve());
    Search search = search_around(samples[0], samples[1]);
    EXPECT_GT(search.given, 0.9);
    EXPECT_LT(search.offset, 0.1);
    samples[1].T_world_sensor.translation() +=
        samples[1].T_world_sensor.linear() * Eigen::Vector3d(1.5, -2.0, 0.0);
    search = search_around(samples[0], samples[1]);
    EXPECT_LT(search.given, 0.3);
    EXPECT_GT(search.best, 0.9);
    EXPECT_NEAR(search.offset, 2.5, 1e-9);
}

}  // namespace overlay_test
}  // namespace dynamic_filter::io
