// SPDX-License-Identifier: MIT
#include "check/advice.hpp"

#include <gtest/gtest.h>

namespace dynamic_filter::app {
namespace advice_test {

DataOptions with_fix(const std::string& fix) {
    DataOptions options;
    options.data = "drive";
    options.pose_fix = fix;
    return options;
}

TEST(Advice, TheNextCommandRepeatsWhatWasTyped) {
    DataOptions options = with_fix("none");
    EXPECT_EQ(next_command(options, ""), "dynamicfilter run drive");
    EXPECT_EQ(next_command(options, "--deskew on"), "dynamicfilter run drive --deskew on");
    options.data = "my drive";
    options.format = "folder";
    options.poses = "p.tum";
    options.points_in_world = true;
    options.time_unit = "ms";
    EXPECT_EQ(next_command(options, "--pose-fix wxyz"),
              "dynamicfilter run 'my drive' --poses p.tum --format folder --points-in-world "
              "--time-unit ms --pose-fix wxyz");
    EXPECT_EQ(next_command(options, "--time-unit ns"),
              "dynamicfilter run 'my drive' --poses p.tum --format folder --points-in-world "
              "--time-unit ns");
    DataOptions bag = with_fix("mm");
    bag.topic = "/points";
    bag.pose_topic = "/odom";
    EXPECT_EQ(next_command(bag, "--pose-fix camera"),
              "dynamicfilter run drive --topic /points --pose-topic /odom --pose-fix camera");
    EXPECT_EQ(next_command(bag, ""),
              "dynamicfilter run drive --topic /points --pose-topic /odom --pose-fix mm");
}

TEST(Advice, AnOptionIsAppliedAsItIsTyped) {
    const auto fixed = with_option(with_fix("none"), "--pose-fix cm");
    ASSERT_TRUE(fixed);
    EXPECT_EQ(fixed->pose_fix, "cm");
    EXPECT_EQ(with_option(with_fix("none"), "--poses none")->poses, std::filesystem::path("none"));
    EXPECT_TRUE(with_option(with_fix("none"), "--points-in-world")->points_in_world);
    EXPECT_FALSE(with_option(with_fix("none"), "--refine on"));  // of a run, not of reading
    EXPECT_FALSE(with_option(with_fix("none"), "give other poses"));
}

TEST(Advice, TheNextCommandNamesAllRecordings) {
    EXPECT_EQ(next_command({"monday", "my drive"}, with_fix("mm"), ""),
              "dynamicfilter run monday 'my drive' --pose-fix mm");
}

TEST(Advice, ANeedlessCorrectionIsNamedAsTheMistake) {
    const io::Finding inverse{"the poses are inverse: scans overlay by 62 %", "--pose-fix inverse"};
    const io::Finding blamed = blame_needless_fix(inverse, with_fix("inverse"));
    EXPECT_EQ(blamed.what, "the poses are right without --pose-fix inverse: scans overlay by 62 %");
    EXPECT_EQ(blamed.advice, "leave out --pose-fix");
    EXPECT_EQ(blame_needless_fix(inverse, with_fix("none")).what, inverse.what);
    EXPECT_EQ(blame_needless_fix(inverse, with_fix("mm")).advice, inverse.advice);
    EXPECT_EQ(blame_needless_fix({"x: y", "--pose-fix lidar"}, with_fix("camera")).advice,
              "leave out --pose-fix");
    EXPECT_EQ(blame_needless_fix({"x: y", "--pose-fix wxyz"}, with_fix("xyzw")).advice,
              "leave out --pose-fix");
    EXPECT_EQ(blame_needless_fix({"x: y", "--deskew on"}, with_fix("inverse")).advice,
              "--deskew on");
}

TEST(Advice, AWarningSaysWhatIsWrongAndWhatToTry) {
    EXPECT_EQ(
        warning_of({"the poses are in millimetres", "--pose-fix mm"}, with_fix("none")),
        "the poses are in millimetres; try --pose-fix mm (`dynamicfilter check` looks closer)");
    EXPECT_EQ(warning_of({"a: b", "--pose-fix lidar"}, with_fix("camera")),
              "the poses are right without --pose-fix camera: b; leave out --pose-fix "
              "(`dynamicfilter check` looks closer)");
}

}  // namespace advice_test
}  // namespace dynamic_filter::app
