// SPDX-License-Identifier: MIT
#include "io/layouts/layouts.hpp"

#include "io/recording.hpp"

namespace dynamic_filter::io {
namespace {

using Layouts = Recording;

std::string odom(double x) {
    return "1 0 0 " + std::to_string(x) + "\n0 1 0 0\n0 0 1 0\n0 0 0 1\n";
}

TEST_F(Layouts, Pairs) {
    put_pcd("1500000000_900000000.pcd", 0, 0);
    put_pcd("1500000001_000000000.pcd", 0, 0);
    data.put("1500000000_900000000.odom", odom(3));
    data.put("1500000001_000000000.odom", odom(4));
    const Sequence sequence = open();
    ASSERT_EQ(sequence.size(), 2U);
    EXPECT_TRUE(has_note(sequence, ".odom"));
    EXPECT_EQ(sequence.T_world_sensor[1].translation().x(), 4.0);
    EXPECT_NEAR(sequence.stamps[1] - sequence.stamps[0], 0.1, 1e-6);
    EXPECT_TRUE(sequence.measured_stamps);
    EXPECT_EQ(read_frame(sequence, 0).points.size(), 2U);
    OpenOptions options;
    options.poses = data.put("p.txt", kitti_rows(2));
    EXPECT_EQ(open(options).T_world_sensor[1].translation().x(), 1.0);
}

TEST_F(Layouts, PairsWithFaults) {
    put_pcd("a.pcd", 0, 0);
    const auto with = [&](const std::string& text) {
        data.put("a.odom", text);
        return open_error();
    };
    EXPECT_HAS(with("1 0 0 0\n0 1 0 0\n0 0 1 0\n"), "3 rows");
    EXPECT_HAS(with("1 0 0 0\n0 1 0\n"), "line 2");
    EXPECT_HAS(with(odom(0) + "1 2 3 4\n"), "more than");
    EXPECT_HAS(with("1 0 0 a\n"), "'a'");
    EXPECT_HAS(with("2 0 0 0\n0 2 0 0\n0 0 2 0\n0 0 0 1\n"), "scaled");
    EXPECT_HAS(with("1 0 0 0\n0 1 0 0\n0 0 1 0\n1 1 1 1\n"), "last row");
    data.put("a.odom", odom(0));
    EXPECT_TRUE(has_note(open(), "10 Hz"));
    put_pcd("b.pcd", 0, 0);
    EXPECT_HAS(open_error(), "no b.odom");
    std::filesystem::remove(data / "b.pcd");
    data.put("c.odom", odom(0));
    EXPECT_HAS(open_error(), "no c.pcd");
}

TEST_F(Layouts, Glim) {
    const auto submap = [](const std::string& x) {
        return "id: 0\nT_world_origin: \n1 0 0 " + x +
               "\n0 1 0 0\n0 0 1 0\n0 0 0 1\nnum_frames: 3\nframe_0\nstamp: " + x +
               "\nstamp: " + x + ".5\nstamp: " + x + ".75\n";
    };
    data.put("traj_lidar.txt", tum_rows(9));
    data.put("000000/data.txt", submap("1"));
    data.put("000000/points_compact.bin", floats({1, 2, 3, 4, 5, 6}));
    data.put("000001/data.txt", submap("2"));
    data.put("000001/points_compact.bin", floats({1, 2, 3}));
    data.put("000001/intensities_compact.bin", floats({0.5F}));
    const Sequence sequence = open();
    ASSERT_EQ(sequence.size(), 2U);
    EXPECT_EQ(stem(sequence, 1), "000001");
    EXPECT_EQ(sequence.T_world_sensor[1].translation().x(), 2.0);
    EXPECT_EQ(sequence.stamps, (std::vector<double>{1.5, 2.5}));
    EXPECT_EQ(read_frame(sequence, 0).points, (Points{{1, 2, 3}, {4, 5, 6}}));
    EXPECT_EQ(column(read_frame(sequence, 1).cloud, "intensity"), std::vector<double>{0.5});
    data.put("000001/intensities_compact.bin", floats({0.5F, 1}));
    EXPECT_HAS(error_of([&] { (void)read_frame(sequence, 1); }), "8 bytes");
    data.put("000000/points_compact.bin", "truncated");
    EXPECT_HAS(error_of([&] { (void)read_frame(sequence, 0); }), "multiple of 12");
    data.put("000000/data.txt", "id: 0\nT_world_origin: \n1 0 0 0\n");
    EXPECT_HAS(open_error(), "1 rows");
    data.put("000000/data.txt", "id: 0\nstamp: 1\n");
    EXPECT_HAS(open_error(), "no T_world_origin");
    data.put("000000/data.txt", "stamp: soon\n");
    EXPECT_HAS(open_error(), "no stamp");
}

TEST_F(Layouts, ScansAndOptimizedPoses) {
    for (std::size_t i = 0; i < 3; ++i) put_pcd("Scans/" + number(i) + ".pcd", 0, 0);
    data.put("optimized_poses.txt", kitti_rows(3));
    data.put("times.txt", "10.0\n10.5\n11.5\n");
    const Sequence sequence = open();
    EXPECT_EQ(sequence.T_world_sensor[2].translation().x(), 2.0);  // the LiDAR's: no calibration
    EXPECT_EQ(sequence.stamps[2], 11.5);
}

TEST_F(Layouts, HelimosAsksForTheSensor) {
    for (const char* sensor : {"Velodyne", "Avia"}) {
        put_bins(std::string(sensor) + "/velodyne", 2);
        data.put(std::string(sensor) + "/poses.txt", kitti_rows(2));
        data.put(std::string(sensor) + "/calib.txt", "Tr: 1 0 0 0 0 1 0 0 0 0 1 0\n");
    }
    EXPECT_HAS(open_error(), "Avia, Velodyne");
    const Sequence sequence = open_sequence(data / "Avia");
    EXPECT_TRUE(sequence.T_world_sensor[1].isApprox(Pose(Eigen::Translation3d(1, 0, 0)), 1e-12));
}

TEST_F(Layouts, Mulran) {
    for (const char* name : {"1500000000000000000", "1500000000500000000", "1500000009000000000"}) {
        data.put("sensor_data/Ouster/" + std::string(name) + ".bin", floats({1, 2, 3, 4}));
    }
    EXPECT_HAS(open_error(), "holds no scans");
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
    EXPECT_THROW((void)read_frame(sequence, 2), InputError);
}

TEST_F(Layouts, MulranWithFaults) {
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

}  // namespace
}  // namespace dynamic_filter::io
