// SPDX-License-Identifier: MIT
#include "recording/two_authors.hpp"

#include <gtest/gtest.h>

#include "support/random.hpp"

namespace dynamic_filter::io {
namespace two_authors_test {

void add(Trajectory& poses, double stamp, double x, double y = 0.0) {
    poses.stamps.push_back(stamp);
    poses.poses.emplace_back(Eigen::Translation3d(x, y, 0.0));
}

TEST(TwoAuthors, PosesThatAlternateAreSplit) {
    Trajectory poses;
    for (int i = 0; i < 200; ++i) {
        const double t = 0.02 * i;
        add(poses, t, t);
        if (i % 5 == 0) add(poses, t + 0.004, t, 0.4 + 0.05 * t);
    }
    const auto split = split_authors(poses);
    ASSERT_TRUE(split);
    EXPECT_EQ((*split)[0].poses.size(), 200U);
    EXPECT_EQ((*split)[1].poses.size(), 40U);
    for (const Pose& pose : (*split)[0].poses) EXPECT_EQ(pose.translation().y(), 0.0);
}

TEST(TwoAuthors, AJumpIsOfOneAuthor) {
    Trajectory poses;
    for (int i = 0; i < 200; ++i) add(poses, 0.02 * i, 0.02 * i, i < 100 ? 0.0 : 3.0);
    EXPECT_FALSE(split_authors(poses));
}

TEST(TwoAuthors, NoiseIsOfOneAuthor) {
    for (const double speed : {0.0, 0.001, 0.1}) {
        test::Random random(3);
        Trajectory poses;
        for (int i = 0; i < 500; ++i) {
            add(poses, 0.02 * i, speed * i + 0.05 * random.uniform(-1.0, 1.0),
                0.05 * random.uniform(-1.0, 1.0));
        }
        EXPECT_FALSE(split_authors(poses)) << speed;
    }
}

TEST(TwoAuthors, FewPosesAreNotSplit) {
    Trajectory poses;
    for (int i = 0; i < 10; ++i) add(poses, 0.1 * i, i % 2);
    EXPECT_FALSE(split_authors(poses));
    EXPECT_FALSE(split_authors({}));
}

}  // namespace two_authors_test
}  // namespace dynamic_filter::io
