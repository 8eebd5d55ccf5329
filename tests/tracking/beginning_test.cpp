// SPDX-License-Identifier: MIT
#include "tracking/beginning.hpp"

#include <gtest/gtest.h>

#include "support/planes.hpp"

namespace dynamic_filter {
namespace beginning_test {

/// Scans at 10 Hz in a hall; the sensor drives at this speed from the first scan on.
std::vector<Scan> scans_at(double speed) {
    test::Random random(7);
    std::vector<Scan> scans;
    for (std::size_t i = 0; i < kBeginning; ++i) {
        const double stamp = 0.1 * static_cast<double>(i);
        const Point here(static_cast<float>(speed * stamp) - 5.0F, 0.0F, 0.0F);
        Scan scan{.points = {}, .stamp = stamp, .index = i, .has_pose = false};
        for (const Point& p : test::points_on(test::hall(), 4.0, 0.02, random)) {
            scan.points.push_back(p - here);
        }
        scans.push_back(std::move(scan));
    }
    return scans;
}

TEST(Beginning, IsTheVelocityOfTheFirstScans) {
    for (const double speed : {0.0, 2.0, 8.0}) {
        const auto velocity = initial_velocity(scans_at(speed), {});
        ASSERT_TRUE(velocity);
        EXPECT_NEAR((*velocity)[0], speed, 0.3);
        EXPECT_NEAR(velocity->tail<5>().norm(), 0.0, 0.3);
    }
}

TEST(Beginning, NeedsThreeScansAndTime) {
    std::vector<Scan> scans = scans_at(2.0);
    EXPECT_FALSE(initial_velocity(std::span(scans).first(2), {}));
    for (Scan& scan : scans) scan.stamp = 1.0;
    EXPECT_FALSE(initial_velocity(scans, {}));
}

}  // namespace beginning_test
}  // namespace dynamic_filter
