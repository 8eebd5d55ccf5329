// SPDX-License-Identifier: MIT
#include "recording/bag_poses.hpp"

#include "support/bag_recording.hpp"
#include "support/pillars.hpp"

namespace dynamic_filter::io {
namespace bag_poses_test {

constexpr std::size_t kScans = 24;

class BagPosesTest : public BagFiles {
protected:
    /// Scans of pillars along a curve, ten a second.
    void drive_among_pillars(const std::string& frame, bool in_world = false) {
        for (std::size_t i = 0; i < kScans; ++i) {
            put(pillars_seen_from(on_a_curve(double(i)), in_world), frame, "/points", stamp(i));
        }
    }
    /// Calls `publish` with the stamp and the place on the curve, every 50 ms.
    template <class Publish>
    void along(const Publish& publish) {
        for (double scan = 0.0; scan < double(kScans); scan += 0.5) {
            publish(kStart + 0.1 * scan, scan);
        }
    }
    void expect_the_curve(const Recording& recording) {
        ASSERT_EQ(recording.size(), kScans);
        for (const std::size_t i : {3U, 20U}) {
            const Pose& pose = recording.read(i).T_world_sensor;
            EXPECT_TRUE(pose.isApprox(on_a_curve(double(i)), 1e-6)) << i;
        }
    }
};

TEST_F(BagPosesTest, OfTwoParentsTheOneThatFitsTheScansIsTaken) {
    drive_among_pillars("lidar");
    along([&](double at, double scan) {
        transform("odom", "lidar", on_a_curve(0.7 * scan), at);
        transform("map", "lidar", on_a_curve(scan), at);
    });
    const Recording recording = opened();
    expect_the_curve(recording);
    EXPECT_TRUE(has_note(recording, ": 'lidar' in 'map' is used"));
}

TEST_F(BagPosesTest, OfTwoAuthorsTheOneThatFitsTheScansIsTaken) {
    drive_among_pillars("lidar");
    along([&](double at, double scan) {
        transform("odom", "lidar", moved(0.1 * scan, 2.0) * on_a_curve(scan), at - 0.004);
        transform("odom", "lidar", on_a_curve(scan), at);
    });
    const Recording recording = opened();
    EXPECT_TRUE(has_note(recording, ": 'lidar' in 'odom' by its second author is used"));
    expect_the_curve(recording);
}

TEST_F(BagPosesTest, OdometryGoesBeforeAGoal) {
    drive_among_pillars("lidar");
    along([&](double at, double scan) { odometry("odom", "lidar", on_a_curve(scan), at); });
    for (const double at : {0.3, 1.0}) {
        write("/goal", "geometry_msgs/PoseStamped", kStart + at,
              pose_message("map", moved(9), kStart + at, MessageEncoding::cdr));
    }
    const Recording recording = opened();
    expect_the_curve(recording);
    EXPECT_TRUE(has_note(recording, "poses from /odom (of /goal, /odom; choose with"));
}

TEST_F(BagPosesTest, ManyPosesGoBeforeAFewOfOdometryAndOfFrames) {
    drive_among_pillars("lidar");
    along([&](double at, double scan) {
        write("/slam", "geometry_msgs/PoseStamped", at,
              pose_message("map", on_a_curve(scan), at, MessageEncoding::cdr));
    });
    for (const double at : {0.3, 1.0}) {
        odometry("odom", "lidar", moved(9 * at), kStart + at);
        transform("odom", "lidar", moved(9 * at), kStart + at);
    }
    const Recording recording = opened();
    expect_the_curve(recording);
}

TEST_F(BagPosesTest, OfTwoOdometriesTheOneThatFitsTheScansIsTaken) {
    drive_among_pillars("lidar");
    along([&](double at, double scan) {
        odometry("odom", "lidar", on_a_curve(0.7 * scan), at, "/a");
        odometry("map", "lidar", on_a_curve(scan), at, "/b");
    });
    const Recording recording = opened();
    expect_the_curve(recording);
    EXPECT_TRUE(has_note(recording, ": /b is used"));
}

TEST_F(BagPosesTest, OdometryThatNamesNoFrameIsTheVehicles) {
    const Pose mount = moved(1.0, 0.3) * Eigen::AngleAxisd(1.57, Eigen::Vector3d::UnitZ());
    drive_among_pillars("lidar");
    transform("base_link", "lidar", mount, kStart, "/tf_static");
    along([&](double at, double scan) {
        odometry("odom", "", on_a_curve(scan) * mount.inverse(), at);
    });
    const Recording recording = opened();
    expect_the_curve(recording);
    EXPECT_TRUE(has_note(recording, "taken for those of 'base_link'"));
}

TEST_F(BagPosesTest, OdometryThatNamesNoFrameMayBeTheSensors) {
    drive_among_pillars("lidar");
    transform("base_link", "lidar", moved(1.0, 3.0), kStart, "/tf_static");
    along([&](double at, double scan) { odometry("odom", "", on_a_curve(scan), at); });
    const Recording recording = opened();
    expect_the_curve(recording);
    EXPECT_TRUE(has_note(recording, "taken for those of the sensor, 'lidar'"));
}

TEST_F(BagPosesTest, CloudsInAFrameOfTheWorldAreSeenFromTheLidarThatMovesInIt) {
    drive_among_pillars("map", true);
    transform("base", "lidar", moved(0), kStart, "/tf_static");
    transform("base", "camera", moved(1), kStart, "/tf_static");
    along([&](double at, double scan) { transform("map", "base", on_a_curve(scan), at); });
    const Recording recording = opened();
    EXPECT_TRUE(recording.info().points_in_world);
    EXPECT_TRUE(has_note(recording, "frame 'lidar' in 'map', which is also the frame of the"));
    expect_the_curve(recording);
}

TEST_F(BagPosesTest, CloudsThatOnlyBearTheNameOfTheWorldStayInTheSensorFrame) {
    drive_among_pillars("map");
    along([&](double at, double scan) { transform("map", "lidar", on_a_curve(scan), at); });
    const Recording recording = opened();
    EXPECT_FALSE(recording.info().points_in_world);
    EXPECT_TRUE(has_note(recording, "as the scans show, the points are in the sensor frame"));
    expect_the_curve(recording);
}

TEST_F(BagPosesTest, WheelsThatTurnAreNoSensors) {
    drive_among_pillars("chassis");
    along([&](double at, double scan) {
        transform("chassis", "wheel", moved(1) * Eigen::AngleAxisd(scan, Eigen::Vector3d::UnitY()),
                  at);
    });
    const Recording recording = opened();
    EXPECT_FALSE(recording.info().points_in_world);
    EXPECT_FALSE(recording.info().has_poses);
}

TEST_F(BagPosesTest, AMountThatIsSentAgainAndAgainIsNoMotion) {
    drive_among_pillars("lidar");
    for (double at = -0.7; at < 2.4; at += 1.02) {
        transform("base_link", "lidar", moved(0, 0, 1), kStart + at);
    }
    along([&](double at, double scan) {
        odometry("odom", "base_link", on_a_curve(scan) * moved(0, 0, -1), at);
    });
    expect_the_curve(opened());
}

TEST_F(BagPosesTest, ASensorThatNeverMovesInTheWorldHasPoses) {
    drive_among_pillars("lidar");
    for (double at = -0.1; at < 2.4; at += 0.1) {
        transform("map", "lidar", moved(3), kStart + at);
    }
    const Recording recording = opened();
    EXPECT_TRUE(has_note(recording, "where it never moves"));
    EXPECT_NEAR(recording.read(7).T_world_sensor.translation().x(), 3.0, 1e-9);
}

}  // namespace bag_poses_test
}  // namespace dynamic_filter::io
