// SPDX-License-Identifier: MIT
#include "recording/layouts/layouts.hpp"
#include "support/recording.hpp"

namespace dynamic_filter::io {
namespace below_test {

using Below = RecordingFiles;

TEST_F(Below, TheOnlyFolderWithScansIsTaken) {
    put_bins("sensors/front", 3);
    data.put(".cache/old/000000.bin", floats({1, 2, 3, 4}));
    data.put("out/run.log", "");
    data.put("out/config.toml", "");
    put_pcd("out/static_map.pcd", 0, 0);
    const Recording recording = open();
    EXPECT_EQ(recording.size(), 3U);
    EXPECT_FALSE(recording.info().has_poses);
    EXPECT_TRUE(has_note(recording, "itself, but in " + (data / "sensors/front").string()));
    data.put("poses.txt", kitti_rows(3));
    EXPECT_EQ(open().info().T_world_sensor[2].translation().x(), 2.0);
    EXPECT_EQ(open().info().pose_source, data / "poses.txt");
    data.put("sensors/times.txt", "1\n2\n3.5\n");
    EXPECT_EQ(open().info().stamps[2], 3.5);
}

TEST_F(Below, ARecordingBelowIsOpenedAsOne) {
    put_bins("00/velodyne", 2);
    data.put("00/poses.txt", kitti_rows(2));
    EXPECT_EQ(open().info().layout, "kitti");
    EXPECT_TRUE(open().info().has_poses);
    std::filesystem::create_directories(data / "more/dataset");
    std::filesystem::rename(data / "00",
                            data / "more/dataset/00");  // its scans are four levels down
    EXPECT_EQ(open().info().layout, "kitti");
    EXPECT_TRUE(open().info().has_poses);
    put_bins("more/dataset/01/velodyne", 2);
    EXPECT_HAS(open_error(), "more/dataset/00 (2 files), more/dataset/01 (2 files)");
    EXPECT_HAS(open_error(), "such as " + (data / "more/dataset/00").string());
    std::filesystem::remove_all(data / "more/dataset/01");
    std::filesystem::create_directories(data / "one/two");
    std::filesystem::rename(data / "more", data / "one/two/more");
    EXPECT_HAS(open_error(), "holds no scans");
}

TEST_F(Below, SeveralFoldersAreNamed) {
    put_bins("lidar/front", 3);
    put_pcd("maps/map.pcd", 0, 0);
    const std::string error = open_error();
    EXPECT_HAS(error, "lidar/front (3 files), maps (1 files)");
    EXPECT_HAS(error, "such as " + (data / "lidar/front").string());
    for (std::size_t i = 0; i < 10; ++i) put_bins("more" + std::to_string(i), 1);
    EXPECT_HAS(open_error(), "and 2 more");
}

TEST_F(Below, ARecordingCountsOnceAndItsScanFolderIsRefused) {
    for (const char* name : {"00", "05"}) {
        put_pcd(std::string(name) + "/pcd/000000.pcd", 2, 0);
    }
    EXPECT_HAS(open_error(), "00 (1 files), 05 (1 files); give one of them");
    EXPECT_HAS(error_of([&] { (void)open_recording(data / "00/pcd"); }),
               "give the folder above it");
    std::filesystem::remove_all(data / "05");
    EXPECT_EQ(open().info().layout, "benchmark");
    put_pcd("00/pcd/000000.pcd", 0, 0);  // without poses in the files, it may be any folder
    EXPECT_EQ(open_recording(data / "00/pcd").size(), 1U);
    put_pcd("00/gt_cloud.pcd", 0, 0);
    EXPECT_HAS(error_of([&] { (void)open_recording(data / "00/pcd"); }),
               "give the folder above it");
}

TEST_F(Below, PoseFilesUnderOtherNamesAreOffered) {
    put_bins("velodyne", 3);
    put_labels(0);
    data.put("times.txt", "1\n2\n3\n");
    data.put("ground_truth.csv",
             "t,x,y,z,qx,qy,qz,qw\n1,0,0,0,0,0,0,1\n2,0,0,0,0,0,0,1\n"
             "3,0,0,0,0,0,0,1\n");
    data.put("traj.txt", tum_rows(2));  // a usual name, whatever its length
    data.put("longer.tum", tum_rows(5));
    const Recording recording = open();
    EXPECT_FALSE(recording.info().has_poses);
    EXPECT_TRUE(has_note(recording, "; try --poses " + (data / "ground_truth.csv").string() +
                                        " or --poses " + (data / "traj.txt").string()));
    EXPECT_FALSE(has_note(recording, "longer.tum"));
    EXPECT_EQ(recording.info().stamps[2], 3.0);
}

TEST_F(Below, WithoutPosesNamesThatAreTimesAreStamps) {
    for (const char* name : {"1500000000.5", "1500000000.6", "1500000000.8"}) {
        data.put("scans/" + std::string(name) + ".bin", floats({1, 2, 3, 4}));
    }
    EXPECT_NEAR(open().info().stamps[2] - open().info().stamps[0], 0.3, 1e-6);
    data.put("scans/1500000000.55.bin", floats({1, 2, 3, 4}));
    EXPECT_NEAR(open().info().stamps[1] - open().info().stamps[0], 0.05, 1e-6);
    data.put("scans/1500000000.7.8.bin", floats({1, 2, 3, 4}));  // no number
    EXPECT_FALSE(open().info().measured_stamps);
}

}  // namespace below_test
}  // namespace dynamic_filter::io
