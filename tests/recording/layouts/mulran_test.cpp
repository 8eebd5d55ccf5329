// SPDX-License-Identifier: MIT
#include "recording/layouts/layouts.hpp"
#include "support/recording.hpp"

namespace dynamic_filter::io {
namespace mulran_test {

using Mulran = RecordingFiles;

TEST_F(Mulran, PosesAreInterpolatedAndTakenToTheSensor) {
    for (const char* name : {"1500000000000000000", "1500000000500000000", "1500000009000000000"}) {
        data.put("sensor_data/Ouster/" + std::string(name) + ".bin", floats({1, 2, 3, 4}));
    }
    EXPECT_FALSE(open().info().has_poses);
    EXPECT_NEAR(open().info().stamps[1] - open().info().stamps[0], 0.5, 1e-6);  // by the names
    data.put("global_pose.csv",
             "1500000000000000000,1,0,0,10,0,1,0,20,0,0,1,30\n"
             "1500000001000000000,1,0,0,12,0,1,0,20,0,0,1,30\n");
    const Recording recording = open();
    ASSERT_EQ(recording.size(), 3U);
    const Pose middle = recording.info().T_world_sensor[1];
    EXPECT_TRUE(middle.translation().isApprox(Eigen::Vector3d(12.7042, 19.979, 31.8047), 1e-6));
    EXPECT_LT((middle.linear() * Eigen::Vector3d::UnitX()).x(), -0.999);  // it looks backwards
    EXPECT_TRUE(has_note(recording, "1 scans have no pose"));
    EXPECT_EQ(recording.read(0).points.size(), 1U);
    EXPECT_HAS(error_of([&] { (void)recording.read(2); }), "it has no pose");
}

TEST_F(Mulran, TheFolderMayBeThatOfTheScansOrOneAbove) {
    for (const char* name : {"1500000000000000000", "1500000000500000000"}) {
        data.put("KAIST01/Ouster/" + std::string(name) + ".bin", floats({1, 2, 3, 4}));
    }
    const auto poses = data.put("KAIST01/global_pose.csv",
                                "1500000000000000000,1,0,0,10,0,1,0,20,0,0,1,30\n"
                                "1500000001000000000,1,0,0,12,0,1,0,20,0,0,1,30\n");
    for (const char* given : {"", "KAIST01", "KAIST01/Ouster", "KAIST01/Ouster/"}) {
        const Recording recording = open_recording(data / given);
        EXPECT_TRUE(has_note(recording, "MulRan's calibration")) << given;
        EXPECT_NEAR(recording.info().T_world_sensor.at(1).translation().x(), 12.7042, 1e-6);
    }
    // Its own pose file may be named; other poses are those of the sensor.
    OpenOptions options;
    options.poses = poses;
    EXPECT_TRUE(has_note(open_recording(data / "KAIST01/Ouster", options), "MulRan's calibration"));
    options.poses = data.put("other.txt", kitti_rows(2));
    const Recording other = open_recording(data / "KAIST01", options);
    EXPECT_EQ(other.info().T_world_sensor.at(1).translation().x(), 1.0);
}

TEST_F(Mulran, FaultsAreNamed) {
    const auto scan = data.put("Ouster/first.bin", floats({1, 2, 3, 4}));
    data.put("global_pose.csv", "1500000000000000000,1,0,0,10,0,1,0,20,0,0,1,30\n");
    EXPECT_HAS(open_error(), "no time");
    std::filesystem::remove(scan);
    EXPECT_HAS(open_error(), "no *.bin");
    data.put("Ouster/5.bin", floats({1, 2, 3, 4}));
    EXPECT_HAS(open_error(), "any scan");
    data.put("global_pose.csv", "x,y,z,qx,qy,qz,qw\n0,0,0,0,0,0,1\n");
    EXPECT_HAS(open_error(), "no stamps");
}

}  // namespace mulran_test
}  // namespace dynamic_filter::io
