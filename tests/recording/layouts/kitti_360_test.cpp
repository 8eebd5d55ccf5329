// SPDX-License-Identifier: MIT
#include "recording/layouts/layouts.hpp"
#include "support/recording.hpp"

namespace dynamic_filter::io {
namespace kitti_360_test {

/// Scans 0 to 39 at 10 Hz; the vehicle goes 1 m a scan along x. Poses of scans 2, 6, 16 and 30.
class Kitti360 : public RecordingFiles {
protected:
    void SetUp() override {
        std::string timestamps;
        for (std::size_t i = 0; i < 40; ++i) {
            data.put(scans + "0000" + number(i) + ".bin", floats({1, 2, 3, 4}));
            timestamps += "2013-05-28 08:46:0" + std::to_string(i / 10) + "." +
                          std::to_string(i % 10) + "00000000\n";
        }
        data.put("data_3d_raw/drive/velodyne_points/timestamps.txt", timestamps);
        put_poses(row(2) + row(6) + row(16) + row(30));
        // The camera looks along the vehicle's x, 1.5 m before its origin.
        data.put("calibration/calib_cam_to_pose.txt",
                 "image_01: 1 0 0 9 0 1 0 9 0 0 1 9\n"
                 "image_00: 0 0 1 1.5 1 0 0 0 0 1 0 0.25\n");
        data.put("calibration/calib_cam_to_velo.txt", "0 0 1 0.5 -1 0 0 0 0 -1 0 -0.125\n");
    }
    static std::string row(std::size_t i) {
        return std::to_string(i) + " 1 0 0 " + std::to_string(i) + " 0 1 0 0 0 0 1 0\n";
    }
    void put_poses(const std::string& text) const { data.put("data_poses/drive/poses.txt", text); }
    [[nodiscard]] Recording drive(const OpenOptions& options = {}) const {
        return open_recording(data / "data_3d_raw/drive", options);
    }
    [[nodiscard]] std::string drive_error() const {
        return error_of([&] { (void)drive(); });
    }
    const std::string scans = "data_3d_raw/drive/velodyne_points/data/";
};

TEST_F(Kitti360, PosesAreInterpolatedAndTakenToTheSensor) {
    const Recording recording = drive();
    ASSERT_EQ(recording.size(), 40U);
    // velo = A cam + a, pose = B cam + b: pose = B A^T (velo - a) + b, by hand.
    Eigen::Matrix3d A, B;
    A << 0, 0, 1, -1, 0, 0, 0, -1, 0;
    B << 0, 0, 1, 1, 0, 0, 0, 1, 0;
    const Eigen::Vector3d a(0.5, 0, -0.125), b(1.5, 0, 0.25);
    const Eigen::Vector3d lever = b - B * A.transpose() * a;
    for (const std::size_t i : {2U, 3U, 6U, 7U, 16U, 30U}) {
        const Pose& pose = recording.info().T_world_sensor[i];
        EXPECT_TRUE(pose.linear().isApprox(B * A.transpose(), 1e-12));
        const Eigen::Vector3d expected = Eigen::Vector3d(static_cast<double>(i), 0, 0) + lever;
        EXPECT_LT((pose.translation() - expected).norm(), 1e-9) << i;
    }
    for (const std::size_t i : {0U, 1U, 17U, 29U, 31U}) {  // before, in a gap of 1.4 s, behind
        EXPECT_FALSE(recording.info().T_world_sensor[i].matrix().allFinite()) << i;
    }
    EXPECT_TRUE(has_note(recording, "24 of 40 scans have no pose"));
    EXPECT_NEAR(recording.info().stamps[39] - recording.info().stamps[0], 3.9, 1e-6);
    EXPECT_EQ(recording.info().pose_source.filename(), "poses.txt");
}

TEST_F(Kitti360, AnyFolderOfItMayBeGiven) {
    const std::size_t inner = open_recording(data / "data_3d_raw/drive/velodyne_points/").size();
    EXPECT_EQ(inner, 40U);
    EXPECT_TRUE(open_recording(data / "data_3d_raw").info().has_poses);
    EXPECT_TRUE(open().info().has_poses);
    data.put("data_3d_raw/other/velodyne_points/data/0000000000.bin", floats({1, 2, 3, 4}));
    EXPECT_HAS(open_error(), "drive, other");
    EXPECT_TRUE(drive().info().has_poses);
}

TEST_F(Kitti360, WithoutCalibrationOrPosesThereAreNone) {
    OpenOptions options;
    options.poses = data.put("own.txt", kitti_rows(40));
    EXPECT_EQ(drive(options).info().T_world_sensor[39].translation().x(), 39.0);
    std::filesystem::remove(data / "calibration/calib_cam_to_velo.txt");
    EXPECT_FALSE(drive().info().has_poses);
    EXPECT_TRUE(has_note(drive(), "calib_cam_to_velo.txt the place of the sensor on it"));
    std::filesystem::remove_all(data / "data_poses");
    EXPECT_FALSE(drive().info().has_poses);
    EXPECT_TRUE(has_note(drive(), "looked for"));
    EXPECT_TRUE(drive().info().measured_stamps);
}

TEST_F(Kitti360, FaultsAreNamedWithFileAndLine) {
    put_poses(row(2) + "3 1 0 0\n");
    EXPECT_HAS(drive_error(), "poses.txt (line 2): 3 numbers");
    put_poses(row(2) + "x 1 0 0 0 0 1 0 0 0 0 1 0\n");
    EXPECT_HAS(drive_error(), "'x' is no number of a scan");
    put_poses(row(6) + row(2));
    EXPECT_HAS(drive_error(), "(line 2): scan 2 comes after scan 6");
    put_poses(row(100));
    EXPECT_HAS(drive_error(), "no pose of any scan");
    put_poses("\n");
    EXPECT_HAS(drive_error(), "holds no pose");
    put_poses(row(2));
    data.put("calibration/calib_cam_to_pose.txt", "image_01: 1 0 0 9 0 1 0 9 0 0 1 9\n");
    EXPECT_HAS(drive_error(), "no line 'image_00:'");
    data.put("calibration/calib_cam_to_velo.txt", "");
    EXPECT_HAS(drive_error(), "holds no matrix");
    data.put("calibration/calib_cam_to_velo.txt", "1 0 0 nan 0 1 0 0 0 0 1 0\n");
    EXPECT_HAS(drive_error(), "(line 1): has numbers");
    data.put("calibration/calib_cam_to_velo.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n");
    data.put("calibration/calib_cam_to_pose.txt", "image_00: 1 0 0 0 0 1 0 0 0 0 1 0\n");
    data.put(scans + "odd.bin", floats({1, 2, 3, 4}));
    std::filesystem::remove(data / "data_3d_raw/drive/velodyne_points/timestamps.txt");
    EXPECT_HAS(drive_error(), "odd.bin: its name is no number");
}

}  // namespace kitti_360_test
}  // namespace dynamic_filter::io
