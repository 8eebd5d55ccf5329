// SPDX-License-Identifier: MIT
#include "check/motion_look.hpp"

#include "support/street_recording.hpp"

namespace dynamic_filter::io {
namespace motion_look_test {

using MotionLooks = StreetRecording;

TEST_F(MotionLooks, GiveWhatIsMeasuredWithoutThem) {
    put(street(true), street(true).truth);
    MotionLook look(open(), {}, "auto");
    const TimesChoice times = choose_times(open(), {}, false);
    EXPECT_GT(times.blur.undone, 0.0);
    EXPECT_EQ(look.times().blur.undone, times.blur.undone);
    EXPECT_EQ(look.times().sweep.has_value(), times.sweep.has_value());
    const MotionQuality quality = measure_motion(with_times(open(), times.sweep), {});
    EXPECT_EQ(look.quality().given.undone, quality.given.undone);
    EXPECT_EQ(look.quality().given.as_measured, quality.given.as_measured);
    EXPECT_GT(look.quality().given.as_measured, 0.0);
}

TEST_F(MotionLooks, LeaveTheMotionInScansIfAsked) {
    put(street(true), street(true).truth);
    MotionLook look(open(), {}, "off");
    EXPECT_FALSE(look.times().sweep);
    EXPECT_EQ(look.quality().given.undone, 0.0);
    EXPECT_GT(look.quality().given.as_measured, 0.0);
}

TEST_F(MotionLooks, MeasureOnce) {
    put(street(false), street(false).truth);
    MotionLook look(open(), {}, "auto");
    const double blur = look.quality().given.as_measured;
    std::filesystem::remove_all(data / "velodyne");
    EXPECT_EQ(look.quality().given.as_measured, blur);
    EXPECT_EQ(find_pose_mistake(look), "");  // no scan is left to show one
}

}  // namespace motion_look_test
}  // namespace dynamic_filter::io
