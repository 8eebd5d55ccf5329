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
    EXPECT_FALSE(open().has_poses);
    EXPECT_NEAR(open().stamps[1] - open().stamps[0], 0.5, 1e-6);  // by the names
    data.put("global_pose.csv",
             "1500000000000000000,1,0,0,10,0,1,0,20,0,0,1,30\n"
             "1500000001000000000,1,0,0,12,0,1,0,20,0,0,1,30\n");
    const Sequence sequence = open();
    ASSERT_EQ(sequence.size(), 3U);
    const Pose middle = sequence.T_world_sensor[1];
    EXPECT_TRUE(middle.translation().isApprox(Eigen::Vector3d(12.7042, 19.979, 31.8047), 1e-6));
    EXPECT_LT((middle.linear() * Eigen::Vector3d::UnitX()).x(), -0.999);  // it looks backwards
    EXPECT_TRUE(has_note(sequence, "1 scans have no pose"));
    EXPECT_EQ(read_frame(sequence, 0).points.size(), 1U);
    EXPECT_HAS(error_of([&] { (void)read_frame(sequence, 2); }), "it has no pose");
}

TEST_F(Mulran, TheFolderMayBeThatOfTheScansOrOneAbove) {
    for (const char* name : {"1500000000000000000", "1500000000500000000"}) {
        data.put("KAIST01/Ouster/" + std::string(name) + ".bin", floats({1, 2, 3, 4}));
    }
    const auto poses = data.put("KAIST01/global_pose.csv",
                                "1500000000000000000,1,0,0,10,0,1,0,20,0,0,1,30\n"
                                "1500000001000000000,1,0,0,12,0,1,0,20,0,0,1,30\n");
    for (const char* given : {"", "KAIST01", "KAIST01/Ouster", "KAIST01/Ouster/"}) {
        const Sequence sequence = open_sequence(data / given);
        EXPECT_TRUE(has_note(sequence, "MulRan's calibration")) << given;
        EXPECT_NEAR(sequence.T_world_sensor.at(1).translation().x(), 12.7042, 1e-6);
    }
    // Its own pose file may be named; other poses are those of the sensor.
    OpenOptions options;
    options.poses = poses;
    EXPECT_TRUE(has_note(open_sequence(data / "KAIST01/Ouster", options), "MulRan's calibration"));
    options.poses = data.put("other.txt", kitti_rows(2));
    const Sequence other = open_sequence(data / "KAIST01", options);
    EXPECT_EQ(other.T_world_sensor.at(1).translation().x(), 1.0);
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
