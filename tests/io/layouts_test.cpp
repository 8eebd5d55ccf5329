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
    std::filesystem::remove(data / "c.odom");
    put_pcd("a.PCD", 0, 0);  // two scans, one pose
    EXPECT_EQ(open().T_world_sensor.size(), 2U);
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

TEST_F(Layouts, MulransFolderMayBeThatOfTheScansOrOneAbove) {
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

std::string entry(const std::string& token, const std::string& rest) {
    return R"({"token": ")" + token + "\", " + rest + "}";
}

std::string pose_entry(const std::string& token, const std::string& x, const std::string& q) {
    return entry(token, "\"translation\": [" + x + ", 0, 0], \"rotation\": [" + q + "]");
}

std::string sweep(const std::string& file, const std::string& time, const std::string& sample,
                  const std::string& ego) {
    return entry(file, R"("filename": ")" + file + R"(", "timestamp": )" + time +
                           R"(, "sample_token": ")" + sample + R"(", "ego_pose_token": ")" + ego +
                           R"(", "calibrated_sensor_token": "top")");
}

class Nuscenes : public Recording {
protected:
    void SetUp() override {
        table("scene", entry("s1", R"("name": "scene-0001")") + "," +
                           entry("s2", R"("name": "scene-0002")"));
        table("sample",
              entry("k1", R"("scene_token": "s1")") + "," + entry("k2", R"("scene_token": "s2")"));
        table("sample_data", sweep("sweeps/LIDAR_TOP/a__2.pcd.bin", "1500000", "k1", "e2") + "," +
                                 sweep("samples/LIDAR_TOP/b__1.pcd.bin", "1000000", "k1", "e1") +
                                 "," + sweep("samples/CAM_FRONT/c.jpg", "1000000", "k1", "e1") +
                                 "," + sweep("samples/LIDAR_TOP/d.pcd.bin", "1000000", "k2", "e1"));
        table("ego_pose", pose_entry("e1", "1", "1, 0, 0, 0") + "," +
                              pose_entry("e2", "2", "0, 0, 0, 1") + "," +
                              pose_entry("unused", "2", "0, 0, 0, 0"));
        table("calibrated_sensor", pose_entry("top", "0.5", "1, 0, 0, 0"));
        data.put("samples/LIDAR_TOP/b__1.pcd.bin", floats({1, 2, 3, 4, 5}));
        data.put("sweeps/LIDAR_TOP/a__2.pcd.bin", floats({1, 2, 3, 4, 5, 6}));
    }
    void table(const std::string& name, const std::string& entries) const {
        data.put("v1.0-mini/" + name + ".json", "[" + entries + "]");
    }
    [[nodiscard]] std::string scene_error() const {
        return error_of([&] { (void)open_sequence(data / "scene-0001"); });
    }
};

TEST_F(Nuscenes, OneScene) {
    const Sequence sequence = open_sequence(data / "scene-0001");
    ASSERT_EQ(sequence.size(), 2U);
    EXPECT_EQ(sequence.stamps, (std::vector<double>{1.0, 1.5}));
    EXPECT_DOUBLE_EQ(sequence.T_world_sensor[0].translation().x(), 1.5);
    EXPECT_DOUBLE_EQ(sequence.T_world_sensor[1].translation().x(), 1.5);  // half a turn about z
    const Frame frame = read_frame(sequence, 0);
    EXPECT_EQ(frame.points, (Points{{1, 2, 3}}));
    EXPECT_EQ(column(frame.cloud, "ring"), std::vector<double>{5});
    EXPECT_HAS(error_of([&] { (void)read_frame(sequence, 1); }), "multiple of 20");
}

TEST_F(Nuscenes, Faults) {
    EXPECT_HAS(open_error(), "scene-0001, scene-0002");
    EXPECT_HAS(error_of([&] { (void)open_sequence(data / "scene-9"); }),
               "has no scene-9; choose a scene");
    for (const char* given : {"v1.0-mini", "samples", "samples/LIDAR_TOP", "sweeps/LIDAR_TOP/"}) {
        EXPECT_HAS(error_of([&] { (void)open_sequence(data / given); }),
                   (data / "scene-0061").string() + "; there are: scene-0001, scene-0002");
    }
    table("ego_pose", pose_entry("e1", "1", "1, 0, 0, 0"));
    EXPECT_HAS(scene_error(), "1 of the 2");
    table("ego_pose", pose_entry("e1", "1", "9, 0, 0, 0"));
    EXPECT_HAS(scene_error(), "length 9");
    table("ego_pose", entry("e1", R"("translation": "none")"));
    EXPECT_HAS(scene_error(), "no table");
    for (const char* file : {"../x/LIDAR_TOP/a.pcd.bin", "/x/LIDAR_TOP/a.pcd.bin"}) {
        table("sample_data", sweep(file, "1", "k1", "e1"));
        EXPECT_HAS(scene_error(), "elsewhere");
    }
    table("sample_data", "");
    EXPECT_HAS(scene_error(), "no scan");
    data.put("v1.0-mini/sample.json", "{");
    EXPECT_HAS(scene_error(), "sample.json");
    data.put("v1.0-test/sample_data.json", "[]");
    EXPECT_HAS(scene_error(), "v1.0-test");
}

}  // namespace
}  // namespace dynamic_filter::io
