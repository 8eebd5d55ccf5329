// SPDX-License-Identifier: MIT
#include "recording/viewpoints.hpp"

#include "support/pillars.hpp"
#include "support/recording.hpp"

namespace dynamic_filter::io {
namespace viewpoints_test {

class ViewpointsTest : public RecordingFiles {
protected:
    void put_scans(bool in_world, bool moves = true) const {
        for (std::size_t i = 0; i < 24; ++i) {
            const Pose pose = on_a_curve(static_cast<double>(i));
            Cloud cloud = pillars_seen_from(pose, in_world);
            if (moves) cloud.viewpoint = pose;
            write_pcd(data / (number(i) + ".pcd"), cloud);
        }
    }
    static void expect_the_curve(const Recording& recording, bool in_world) {
        EXPECT_EQ(recording.info().layout, "folder");
        ASSERT_TRUE(recording.info().has_poses);
        EXPECT_EQ(recording.info().points_in_world, in_world);
        const FullScan scan = recording.read(7);
        EXPECT_TRUE(scan.T_world_sensor.isApprox(on_a_curve(7), 1e-4));
        const Cloud seen = pillars_seen_from(on_a_curve(7));
        EXPECT_TRUE(scan.points[5].isApprox(positions(seen)[5], 1e-3F));
    }
};

TEST_F(ViewpointsTest, PointsInTheWorldAreMovedIntoTheSensor) {
    put_scans(true);
    const Recording recording = open();
    expect_the_curve(recording, true);
    EXPECT_TRUE(has_note(recording, "taken to be in the world's frame"));
}

TEST_F(ViewpointsTest, PointsOfTheSensorStayThere) {
    put_scans(false);
    const Recording recording = open();
    expect_the_curve(recording, false);
    EXPECT_TRUE(has_note(recording, "taken to be in the sensor's frame"));
}

TEST_F(ViewpointsTest, TimesAndOtherPosesBesideTheScansCount) {
    put_scans(false);
    std::string times;
    for (int i = 0; i < 24; ++i) times += std::to_string(100.0 + 0.5 * i) + "\n";
    data.put("times.txt", times);
    EXPECT_NEAR(open().info().stamps[2], 101.0, 1e-6);
    OpenOptions every_second;
    every_second.stride = 2;
    EXPECT_NEAR(open(every_second).read(3).T_world_sensor.translation().x(),
                on_a_curve(6).translation().x(), 1e-4);
    data.put("poses.txt", kitti_rows(24));
    EXPECT_NEAR(open().read(7).T_world_sensor.translation().x(), 7.0, 1e-6);
}

TEST_F(ViewpointsTest, OneThatNeverChangesIsNoPose) {
    put_scans(false, false);
    EXPECT_FALSE(open().info().has_poses);
    OpenOptions options;
    options.without_poses = true;
    put_scans(false);
    EXPECT_FALSE(open(options).info().has_poses);
}

}  // namespace viewpoints_test
}  // namespace dynamic_filter::io
