// SPDX-License-Identifier: MIT
#include "dynamic_filter/poses.hpp"

#include <cmath>
#include <cstring>

#include "support/bytes.hpp"
#include "support/random.hpp"

namespace dynamic_filter::io {
namespace trajectory_test {

/// Moving and turning at constant rates.
Pose pose_of_ride(double time) {
    Pose pose = Pose::Identity();
    pose.linear() = Eigen::AngleAxisd(0.8 * time, Eigen::Vector3d(0.1, 0.2, 1.0).normalized())
                        .toRotationMatrix();
    pose.translation() = Eigen::Vector3d(15.0, -4.0, 0.5) * time;
    return pose;
}
Trajectory ride(double begin, double end, double step) {
    Trajectory trajectory;
    for (double time = begin; time <= end; time += step) {
        trajectory.stamps.push_back(time);
        trajectory.poses.push_back(pose_of_ride(time));
    }
    return trajectory;
}
double apart(const Pose& a, const Pose& b) {
    return (a.matrix() - b.matrix()).cwiseAbs().maxCoeff();
}

TEST(Trajectory, IsPutInOrder) {
    Trajectory t{{3, 1, 2, 1}, {pose_of_ride(3), pose_of_ride(1), pose_of_ride(2), Pose()}};
    put_in_order(t);
    EXPECT_EQ(t.stamps, (std::vector<double>{1, 2, 3}));
    EXPECT_EQ(apart(t.poses[0], pose_of_ride(1)), 0.0);
    EXPECT_EQ(apart(t.poses[2], pose_of_ride(3)), 0.0);
}

TEST(PoseAt, LiesOnTheRide) {
    const Trajectory trajectory = ride(0.0, 10.0, 0.5);
    for (double time = 0.0; time <= 9.999; time += 0.0137) {
        const auto pose = pose_at(trajectory, time);
        ASSERT_TRUE(pose) << time;
        EXPECT_LT(apart(*pose, pose_of_ride(time)), 1e-9) << time;
    }
}

/// Against the weighting of the two poses around it, found one after the other.
TEST(PoseAt, AgreesWithBruteForce) {
    test::Random random(5);
    Trajectory trajectory;
    for (int i = 0; i < 50; ++i) {
        trajectory.stamps.push_back(i + random.uniform(0.0, 0.9));
        trajectory.poses.push_back(random.pose(20.0, 3.1));
    }
    for (int k = 0; k < 2000; ++k) {
        const double time = random.uniform(-1.0, 52.0);
        const auto& stamps = trajectory.stamps;
        const auto got = pose_at(trajectory, time, 1.2);
        std::size_t i = 0;
        while (i + 1 < stamps.size() && !(stamps[i] <= time && time <= stamps[i + 1])) ++i;
        const bool none = i + 1 == stamps.size() || stamps[i + 1] - stamps[i] > 1.2;
        ASSERT_EQ(got.has_value(), !none) << time;
        if (none) continue;
        const double share = (time - stamps[i]) / (stamps[i + 1] - stamps[i]);
        const Pose &a = trajectory.poses[i], &b = trajectory.poses[i + 1];
        const Eigen::Quaterniond turn =
            Eigen::Quaterniond(a.linear()).slerp(share, Eigen::Quaterniond(b.linear()));
        EXPECT_LT((got->linear() - turn.toRotationMatrix()).cwiseAbs().maxCoeff(), 1e-9);
        const Eigen::Vector3d at = a.translation() + share * (b.translation() - a.translation());
        EXPECT_LT((got->translation() - at).norm(), 1e-9);
    }
}

TEST(PoseAt, GapsAndEnds) {
    Trajectory trajectory = ride(0.0, 1.0, 0.25);
    EXPECT_FALSE(pose_at(trajectory, -0.01));
    EXPECT_FALSE(pose_at(trajectory, 1.01));
    EXPECT_FALSE(pose_at(trajectory, std::nan("")));
    EXPECT_FALSE(pose_at({}, 0.0));
    for (const double time : {-0.2, 1.2}) {  // the motion goes on
        EXPECT_FALSE(pose_at(trajectory, time, 1.0, 0.1));
        const auto beyond = pose_at(trajectory, time, 1.0, 0.3);
        ASSERT_TRUE(beyond);
        EXPECT_LT(apart(*beyond, pose_of_ride(time)), 1e-9);
    }
    trajectory.stamps.push_back(3.0);
    trajectory.poses.push_back(pose_of_ride(3.0));
    EXPECT_FALSE(pose_at(trajectory, 2.0));
    EXPECT_TRUE(pose_at(trajectory, 2.0, 2.5));
    EXPECT_TRUE(pose_at(trajectory, 3.0));  // what is known is no gap
    const Trajectory one{{5.0}, {pose_of_ride(5.0)}};
    EXPECT_TRUE(pose_at(one, 5.1, 1.0, 0.2));
    EXPECT_FALSE(pose_at(one, 5.1));
}

/// A cloud whose points were measured over 0.1 s, told as `unit` [s] from `zero`.
template <class T>
Cloud timed(const std::string& name, FieldType type, double unit, double zero) {
    Cloud cloud;
    for (const char* axis : {"x", "y", "z"}) add_field(cloud, axis, FieldType::f32);
    add_field(cloud, name, type);
    cloud.data.resize(101 * cloud.point_bytes);
    for (int i = 0; i <= 100; ++i) {
        const auto value = static_cast<T>((zero + 0.001 * i) / unit);
        std::memcpy(cloud.data.data() + static_cast<std::size_t>(i) * cloud.point_bytes + 12,
                    &value, sizeof value);
    }
    return cloud;
}

TEST(PointTimes, UnitsAndZeros) {
    constexpr double kStamp = 1.6e9;
    const std::vector<Cloud> clouds = {
        timed<std::uint32_t>("t", FieldType::u32, 1e-9, 0.0),
        timed<float>("time", FieldType::f32, 1.0, 0.0),
        timed<float>("time", FieldType::f32, 1e-3, 0.0),
        timed<std::uint32_t>("offset_time", FieldType::u32, 1e-6, 0.0),
        timed<double>("timestamp", FieldType::f64, 1.0, kStamp),
        timed<double>("timestamp", FieldType::f64, 1e-6, kStamp),
        timed<double>("timestamp", FieldType::f64, 1e-9, kStamp),
        timed<std::uint64_t>("timestamp", FieldType::u64, 1e-9, kStamp),
    };
    for (std::size_t c = 0; c < clouds.size(); ++c) {
        const std::vector<float> times = point_times(clouds[c], kStamp);
        ASSERT_EQ(times.size(), 101U) << c;
        for (int i = 0; i <= 100; ++i) {
            EXPECT_NEAR(times[static_cast<std::size_t>(i)], 0.001 * i, 2e-6) << c;
        }
    }
}

TEST(PointTimes, BeforeTheStamp) {
    const auto times = point_times(timed<float>("time", FieldType::f32, 1.0, -0.1), 7.0);
    ASSERT_EQ(times.size(), 101U);
    EXPECT_NEAR(times[0], -0.1, 1e-6);
    EXPECT_NEAR(times[100], 0.0, 1e-6);
}

TEST(PointTimes, MayGoBack) {
    Cloud cloud = timed<float>("time", FieldType::f32, 1.0, 0.0);
    const auto forth = point_times(cloud, 7.0);
    const auto first = std::prev(cloud.data.end(), static_cast<std::ptrdiff_t>(cloud.point_bytes));
    std::swap_ranges(first, cloud.data.end(), cloud.data.begin());
    const auto back = point_times(cloud, 7.0);
    ASSERT_EQ(back.size(), forth.size());
    EXPECT_EQ(back.front(), forth.back());
    EXPECT_EQ(back.back(), forth.front());
}

TEST(PointTimes, OfAnotherClockCountFromTheFirst) {
    const auto times = point_times(timed<double>("t", FieldType::f64, 1.0, 1.5e9), 1.6e9);
    ASSERT_EQ(times.size(), 101U);
    EXPECT_EQ(times.front(), 0.0F);
    EXPECT_NEAR(times.back(), 0.1, 1e-6);
}

TEST(PointTimes, WhatSaysNothing) {
    Cloud equal = timed<float>("time", FieldType::f32, 1.0, 0.0);
    std::fill(equal.data.begin(), equal.data.end(), std::byte{0x3d});
    EXPECT_TRUE(point_times(equal, 0.0).empty());
    EXPECT_TRUE(point_times(timed<float>("intensity", FieldType::f32, 1.0, 0.0), 0.0).empty());
    EXPECT_TRUE(point_times(timed<float>("time", FieldType::f32, 1e20, 0.0), 0.0).empty());
    EXPECT_TRUE(point_times(timed<float>("time", FieldType::f32, 1e-30, 0.0), 0.0).empty());
    Cloud none = timed<float>("time", FieldType::f32, 1.0, 0.0);
    none.data.clear();
    EXPECT_TRUE(point_times(none, 0.0).empty());
}

TEST(UndoMotion, PointsAreWhereTheyWereAtTheStamp) {
    const Trajectory trajectory = ride(0.0, 3.0, 0.1);
    constexpr double kStamp = 1.05;
    test::Random random(9);
    Points points, expected;
    std::vector<float> times;
    for (int i = 0; i < 5000; ++i) {
        const Eigen::Vector3d world =
            random.point(40.0).cast<double>() + pose_of_ride(kStamp).translation();
        times.push_back(random.uniform_f(-0.1, 0.1));
        const Pose then = pose_of_ride(kStamp + times.back());
        points.emplace_back((then.inverse() * world).cast<float>());
        expected.emplace_back((pose_of_ride(kStamp).inverse() * world).cast<float>());
    }
    undo_motion(points, times, kStamp, trajectory);
    for (std::size_t i = 0; i < points.size(); ++i) {
        EXPECT_LT((points[i] - expected[i]).norm(), 1e-3F);
    }
}

TEST(UndoMotion, WhatCannotBeMovedStays) {
    const Trajectory trajectory = ride(0.0, 1.0, 0.1);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const Points before = {{1, 2, 3}, {1, 2, 3}, {0, 0, 0}, {1, 2, 3}};
    const std::vector<float> times = {5.0F, nan, 0.05F};  // too late, unknown, no return, none
    Points points = before;
    undo_motion(points, times, 0.5, trajectory);
    EXPECT_EQ(points, before);
    undo_motion(points, {0.1F}, 9.0, trajectory);  // the scan itself has no pose
    EXPECT_EQ(points, before);
}

}  // namespace trajectory_test
}  // namespace dynamic_filter::io
