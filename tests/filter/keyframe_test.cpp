// SPDX-License-Identifier: MIT
#include "filter/keyframe.hpp"

#include <gtest/gtest.h>

namespace dynamic_filter {
namespace keyframe_test {

Scan scan_at(double stamp, double x) {
    Scan scan;
    scan.stamp = stamp;
    scan.T_world_sensor.translation().x() = x;
    return scan;
}

TEST(Keyframe, IsWhatComesLateOrFarEnoughAfterTheLastBothInclusive) {
    const KeyframeConfig config{.interval = 0.5, .distance = 2.0};
    const Scan last = scan_at(10.0, 1.0);
    EXPECT_FALSE(is_keyframe(last, scan_at(10.0, 1.0), config));
    EXPECT_FALSE(is_keyframe(last, scan_at(10.49, 2.99), config));
    EXPECT_TRUE(is_keyframe(last, scan_at(10.5, 1.0), config));
    EXPECT_TRUE(is_keyframe(last, scan_at(10.0, 3.0), config));
    EXPECT_TRUE(is_keyframe(last, scan_at(10.0, -1.0), config));
}

}  // namespace keyframe_test
}  // namespace dynamic_filter
