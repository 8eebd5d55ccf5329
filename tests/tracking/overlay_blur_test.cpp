// SPDX-License-Identifier: MIT
#include "tracking/overlay_blur.hpp"

#include <gtest/gtest.h>

#include "dynamic_filter/motion.hpp"
#include "support/planes.hpp"

namespace dynamic_filter {
namespace overlay_blur_test {

struct Drive {
    std::vector<Scan> scans;
    std::vector<Pose> truth;
};

constexpr double kSpeed = 10.0;  // [m/s] along x

/// Through a hall; each scan takes 0.1 s, or none.
Drive drive(bool sweeping) {
    test::Random random(1);
    Drive drive;
    Twist velocity = Twist::Zero();
    velocity.x() = kSpeed;
    for (int i = 0; i < 8; ++i) {
        const double stamp = 0.1 * i;
        drive.truth.push_back(exp(velocity * stamp));
        Scan scan{.points = moved(test::points_on(test::hall(), 5.0, 0.01, random),
                                  drive.truth.back().inverse()),
                  .stamp = stamp};
        for (Point& p : scan.points) {
            if (!sweeping) break;
            scan.times.push_back(random.uniform_f(0.0, 0.1));
            p = (exp(velocity * static_cast<double>(scan.times.back())).inverse() *
                 p.cast<double>())
                    .cast<float>();
        }
        drive.scans.push_back(std::move(scan));
    }
    return drive;
}

TEST(OverlayBlur, IsLeastAtTheTruePoses) {
    for (const bool sweeping : {false, true}) {
        const auto [scans, truth] = drive(sweeping);
        const double best = overlay_blur(scans, truth, {});
        EXPECT_GT(best, 0.01);
        EXPECT_LT(best, 0.03);
        test::Random random(2);
        double before = best;
        for (const double noise : {0.02, 0.05, 0.1}) {
            auto poses = truth;
            for (Pose& pose : poses) pose = pose * random.pose(noise, 0.0);
            const double blur = overlay_blur(scans, poses, {});
            EXPECT_GT(blur, 1.1 * before);
            before = blur;
        }
    }
}

TEST(OverlayBlur, OfSweepsWithoutTimesIsWorse) {
    auto [scans, truth] = drive(true);
    const double with_times = overlay_blur(scans, truth, {});
    for (Scan& scan : scans) scan.times.clear();
    EXPECT_GT(overlay_blur(scans, truth, {}), 1.4 * with_times);
}

TEST(OverlayBlur, LooksAtTheGivenPosesOnlyAndNotAtWhereTheyBegin) {
    auto [scans, truth] = drive(false);
    const double blur = overlay_blur(scans, truth, {});
    for (Scan& scan : scans) scan.T_world_sensor.translation().y() = 1e3 * scan.stamp;
    EXPECT_EQ(overlay_blur(scans, truth, {}), blur);
    for (Pose& pose : truth) pose = Eigen::Translation3d(1e6, -1e6, 30.0) * pose;
    EXPECT_NEAR(overlay_blur(scans, truth, {}), blur, 0.01 * blur);
}

TEST(OverlayBlur, OfOneScanIsNothing) {
    const auto [scans, truth] = drive(false);
    EXPECT_EQ(overlay_blur({}, {}, {}), 0.0);
    EXPECT_EQ(overlay_blur({scans.data(), 1}, {truth.data(), 1}, {}), 0.0);
}

}  // namespace overlay_blur_test
}  // namespace dynamic_filter
