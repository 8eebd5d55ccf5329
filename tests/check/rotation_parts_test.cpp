// SPDX-License-Identifier: MIT
#include "check/rotation_parts.hpp"

#include <cmath>
#include <numbers>

#include "recording/recording_parts.hpp"
#include "support/recording.hpp"

namespace dynamic_filter::io {
namespace rotation_parts_test {

/// Scans of sectors of `width` degrees; each begins `step` degrees after the one before.
Recording sectors(double width, double step, std::size_t scans = 60) {
    RecordingParts parts;
    for (std::size_t i = 0; i < scans; ++i) {
        parts.info.scan_files.push_back(std::to_string(i) + ".bin");
        parts.info.stamps.push_back(0.01 * static_cast<double>(i));
    }
    parts.info.has_poses = false;
    parts.read_cloud = [=](std::size_t i) {
        Cloud cloud;
        for (const char* axis : {"x", "y", "z"}) add_field(cloud, axis, FieldType::f32);
        std::string bytes;
        for (double at = 0.0; at < width; at += 0.5) {
            const double angle = (step * double(i) + at) * std::numbers::pi / 180.0;
            bytes += floats({static_cast<float>(9.0 * std::cos(angle)),
                             static_cast<float>(9.0 * std::sin(angle)), 0.5F});
        }
        const auto raw = std::as_bytes(std::span(bytes));
        cloud.data.assign(raw.begin(), raw.end());
        return cloud;
    };
    return Recording(std::move(parts));
}

TEST(RotationParts, PacketsAreNamed) {
    for (const double step : {36.0, -36.0}) {
        const auto found = find_rotation_parts(sectors(36.0, step));
        ASSERT_TRUE(found) << step;
        EXPECT_HAS(found->what, "each scan covers 36 degrees of a rotation");
        EXPECT_HAS(found->advice, "join the 10 parts");
    }
    const auto halves = find_rotation_parts(sectors(180.0, 180.0));
    ASSERT_TRUE(halves);
    EXPECT_HAS(halves->what, "covers 180 degrees");
}

TEST(RotationParts, WholeRotationsAndFixedViewsAreNone) {
    EXPECT_FALSE(find_rotation_parts(sectors(360.0, 36.0)));
    EXPECT_FALSE(find_rotation_parts(sectors(90.0, 0.0)));
    EXPECT_FALSE(find_rotation_parts(sectors(90.0, 2.0))) << "the sensor itself turns";
    EXPECT_FALSE(find_rotation_parts(sectors(36.0, 36.0, 3))) << "too few";
}

}  // namespace rotation_parts_test
}  // namespace dynamic_filter::io
