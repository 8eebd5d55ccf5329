// SPDX-License-Identifier: MIT
#include <cmath>
#include <numbers>

#include "recording/layouts/layouts.hpp"
#include "support/recording.hpp"

namespace dynamic_filter::io {
namespace kitti_raw_test {

constexpr double degree = std::numbers::pi / 180.0;

/// A drive of three scans, heading north-east, 1e-5 degrees of latitude and longitude a scan.
class KittiRaw : public RecordingFiles {
protected:
    static std::string scan_name(std::size_t i) { return "000000000" + std::to_string(i); }
    void SetUp() override {
        for (std::size_t i = 0; i < 3; ++i) {
            data.put("day/drive/velodyne_points/data/" + scan_name(i) + ".bin",
                     floats({1, 2, 3, 4}));
        }
        put_timestamps(
            "2011-09-26 13:02:25.951199337\n2011-09-26 13:02:26.051199337\n"
            "2011-09-26 13:02:26.151199337\n");
        for (std::size_t i = 0; i < 3; ++i) {
            const std::string step = std::to_string(i);
            put_oxts(i, "49.0000" + step + " 8.0000" + step + " 11" + step +
                            " 0.1 -0.2 0.7 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 4 10 4 4 0\n");
        }
    }
    void put_timestamps(const std::string& text) const {
        data.put("day/drive/velodyne_points/timestamps.txt", text);
    }
    void put_oxts(std::size_t i, const std::string& text) const {
        data.put("day/drive/oxts/data/" + scan_name(i) + ".txt", text);
    }
    void put_calibration() const {  // a quarter turn, so that the order of the rows shows
        data.put("day/calib_imu_to_velo.txt",
                 "calib_time: 25-May-2012 16:47:16\nR: 0 -1 0 1 0 0 0 0 1\nT: 0.5 0.25 -1\n");
    }
    [[nodiscard]] Recording drive(const OpenOptions& options = {}) const {
        return open_recording(data / "day/drive", options);
    }
    [[nodiscard]] std::string drive_error() const {
        return error_of([&] { (void)drive(); });
    }
};

/// Written out by hand: Z(0.7) Y(-0.2) X(0.1).
Eigen::Matrix3d turned() {
    const double cr = std::cos(0.1), sr = std::sin(0.1), cp = std::cos(-0.2), sp = std::sin(-0.2),
                 cy = std::cos(0.7), sy = std::sin(0.7);
    Eigen::Matrix3d R;
    R << cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr,  //
        sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr,   //
        -sp, cp * sr, cp * cr;
    return R;
}

/// From the first scan to the one `i` steps on, by the textbook's form of the projection.
Eigen::Vector3d way_to(int i) {
    const double scale = std::cos(49.0 * degree), radius = 6378137.0;
    const auto north = [&](double latitude) {
        return scale * radius * std::log(std::tan((90.0 + latitude) * degree / 2.0));
    };
    return {scale * radius * 1e-5 * i * degree, north(49.0 + 1e-5 * i) - north(49.0), 1.0 * i};
}

TEST_F(KittiRaw, PosesAreThoseOfTheDevelopmentKit) {
    put_calibration();
    const Recording recording = drive();
    ASSERT_EQ(recording.size(), 3U);
    EXPECT_TRUE(recording.info().has_poses);
    EXPECT_EQ(stem(recording, 2), scan_name(2));
    // T_velo_imu = [R | T], so T_imu_velo = [R^T | -R^T T].
    Eigen::Matrix3d R_imu_velo;
    R_imu_velo << 0, 1, 0, -1, 0, 0, 0, 0, 1;
    for (int i = 0; i < 3; ++i) {
        const Pose& pose = recording.info().T_world_sensor[static_cast<std::size_t>(i)];
        EXPECT_TRUE(pose.linear().isApprox(turned() * R_imu_velo, 1e-12));
        EXPECT_LT((pose.translation() - way_to(i)).norm(), 1e-6) << i;
    }
    EXPECT_NEAR(recording.info().stamps[0], 1317042145.951199337, 1e-6);
    EXPECT_NEAR(recording.info().stamps[2] - recording.info().stamps[0], 0.2, 1e-6);
    EXPECT_TRUE(has_note(recording, "calib_imu_to_velo.txt"));
    EXPECT_TRUE(has_note(recording, "oxts"));
    EXPECT_EQ(recording.info().pose_source, data / "day/drive/oxts/data");
    EXPECT_EQ(recording.read(1).points, (Points{{1, 2, 3}}));
}

TEST_F(KittiRaw, WithoutCalibrationTheUsualPlaceIsTakenAndSaid) {
    // The vehicle turns on the spot by a quarter, so what differs is the lever arm.
    put_oxts(0, "49 8 110 0 0 0\n");
    put_oxts(1, "49 8 110 0 0 1.5707963267948966\n");
    const Recording recording = drive();
    EXPECT_TRUE(has_note(recording, "0.81 m in front of"));
    const Eigen::Vector3d expected(0.32 - 0.81, 0.81 + 0.32, 0.0);
    EXPECT_LT((recording.info().T_world_sensor[1].translation() - expected).norm(), 1e-9);
}

TEST_F(KittiRaw, TheFolderOfTheScansMayBeGivenAndOtherPoses) {
    EXPECT_EQ(open_recording(data / "day/drive/velodyne_points").info().T_world_sensor.size(), 3U);
    EXPECT_EQ(open_recording(data / "day/drive/velodyne_points/data/").info().T_world_sensor.size(),
              3U);
    EXPECT_EQ(open_recording(data / "day").info().T_world_sensor.size(), 3U);  // the only drive
    OpenOptions options;
    options.poses = data.put("other.txt", kitti_rows(3));
    EXPECT_EQ(drive(options).info().T_world_sensor[2].translation().x(), 2.0);
    EXPECT_NEAR(drive(options).info().stamps[1] - drive(options).info().stamps[0], 0.1, 1e-6);
    options.poses.reset();
    options.without_poses = true;
    EXPECT_FALSE(drive(options).info().has_poses);
    EXPECT_TRUE(drive(options).info().measured_stamps);
}

TEST_F(KittiRaw, WithoutOxtsThereAreNoPosesAndTheNoteOffersWhatMayBeSome) {
    std::filesystem::remove_all(data / "day/drive/oxts");
    data.put("day/drive/mine.txt", tum_rows(3));
    data.put("day/drive/longer.txt", tum_rows(4));
    const Recording recording = drive();
    EXPECT_FALSE(recording.info().has_poses);
    EXPECT_TRUE(has_note(recording, "no poses found"));
    EXPECT_TRUE(has_note(recording, "--poses " + (data / "day/drive/mine.txt").string()));
    EXPECT_FALSE(has_note(recording, "longer.txt"));
    EXPECT_TRUE(recording.info().measured_stamps);
}

TEST_F(KittiRaw, WhatIsMissingInBetweenIsMatchedByItsNumber) {
    std::filesystem::remove(data / "day/drive/velodyne_points/data/0000000001.bin");
    const Recording recording = drive();
    ASSERT_EQ(recording.size(), 2U);
    EXPECT_LT((recording.info().T_world_sensor[1].translation() - way_to(2)).norm(), 1e-6);
    EXPECT_NEAR(recording.info().stamps[1] - recording.info().stamps[0], 0.2, 1e-6);
    std::filesystem::remove(data / "day/drive/oxts/data/0000000002.txt");
    EXPECT_TRUE(has_note(drive(), "1 of 2 scans have no pose"));
    EXPECT_FALSE(drive().info().T_world_sensor[1].matrix().allFinite());
    std::filesystem::remove(data / "day/drive/oxts/data/0000000000.txt");
    EXPECT_HAS(drive_error(), "no file of the name of any scan");
}

TEST_F(KittiRaw, FaultsAreNamedWithFileAndLine) {
    put_oxts(1, "49 8 110 0 0\n");
    EXPECT_HAS(drive_error(), "0000000001.txt (line 1): 5 numbers");
    put_oxts(1, "49 8 110 0 0 north\n");
    EXPECT_HAS(drive_error(), "'north'");
    put_oxts(1, "90 8 110 0 0 0\n");
    EXPECT_HAS(drive_error(), "no place on Earth");
    put_oxts(1, "49 8 110 0 0 0\n");
    data.put("day/calib_imu_to_velo.txt", "R: 1 0 0 0 1 0 0 0 1\n");
    EXPECT_HAS(drive_error(), "'R:' and 'T:'");
    data.put("day/calib_imu_to_velo.txt", "R: 1 0 0 0 1 0 0 0\nT: 0 0 0\n");
    EXPECT_HAS(drive_error(), "(line 1): 8 numbers behind R:");
    data.put("day/calib_imu_to_velo.txt", "R: 2 0 0 0 2 0 0 0 2\nT: 0 0 0\n");
    EXPECT_HAS(drive_error(), "scaled");
    put_timestamps("2011-09-26 13:02:25.9\n2011-09-26\n2011-09-26 13:02:26.1\n");
    EXPECT_HAS(drive_error(), "timestamps.txt (line 2): '2011-09-26' is no time");
    put_timestamps("2011-09-26 13:02:25.9\n\n2011-09-26 13:02:26.1\n");
    EXPECT_HAS(drive_error(), "(line 2): is blank");
    put_timestamps("2011-09-26 13:02:25.9\n2011-02-30 13:02:26.0\n2011-09-26 13:02:26.1\n");
    EXPECT_HAS(drive_error(), "(line 2)");
    put_timestamps("2011-09-26 13:02:25.9\n2011-09-26 13:02:26.0\n");
    EXPECT_HAS(drive_error(), "2 timestamps but 3 scans");
    std::filesystem::remove_all(data / "day/drive/velodyne_points/data");
    std::filesystem::create_directories(data / "day/drive/velodyne_points/data");
    EXPECT_HAS(drive_error(), "no *.bin");
}

TEST_F(KittiRaw, SeveralDrivesAreNamed) {
    data.put("day/later/velodyne_points/data/0000000000.bin", floats({1, 2, 3, 4}));
    const std::string error = error_of([&] { (void)open_recording(data / "day"); });
    EXPECT_HAS(error, "drive (3 files), later (1 files)");
}

}  // namespace kitti_raw_test
}  // namespace dynamic_filter::io
