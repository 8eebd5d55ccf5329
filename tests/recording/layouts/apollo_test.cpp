// SPDX-License-Identifier: MIT
#include "recording/layouts/layouts.hpp"
#include "support/recording.hpp"

namespace dynamic_filter::io {
namespace apollo_test {

/// Scans 1 to 11, in the order 1, 10, 11, 2... of the alphabet; a row for each, in another order.
class Apollo : public RecordingFiles {
protected:
    void SetUp() override {
        for (std::size_t i = 1; i <= 11; ++i) put_pcd("pcds/" + std::to_string(i) + ".pcd", 0, 0);
        std::string rows;
        for (std::size_t i = 11; i >= 1; --i) rows += row(i);
        data.put("poses.txt", rows);
    }
    /// Half a turn about z, 2 m a scan along y.
    static std::string row(std::size_t i) {
        return std::to_string(i) + " " +
               std::to_string(1500000000.0 + 0.1 * static_cast<double>(i)) + " 5 " +
               std::to_string(2 * i) + " 7 0 0 1 0\n";
    }
};

TEST_F(Apollo, PosesAndStampsAreThoseOfTheScansNumber) {
    const Recording recording = open();
    ASSERT_EQ(recording.size(), 11U);
    EXPECT_EQ(stem(recording, 9), "10");
    const Pose& pose = recording.info().T_world_sensor[9];
    EXPECT_EQ(pose.translation(), Eigen::Vector3d(5, 20, 7));
    EXPECT_TRUE(
        pose.linear().isApprox(Eigen::Vector3d(-1, -1, 1).asDiagonal().toDenseMatrix(), 1e-12));
    EXPECT_NEAR(recording.info().stamps[9], 1500000001.0, 1e-6);
    EXPECT_TRUE(recording.info().measured_stamps);
    EXPECT_TRUE(has_note(recording, "by the scans' numbers"));
    EXPECT_EQ(recording.read(0).points.size(), 2U);
    OpenOptions options;
    options.without_poses = true;
    EXPECT_FALSE(open(options).info().has_poses);
    EXPECT_TRUE(open(options).info().measured_stamps);
    options.without_poses = false;
    options.poses = data.put("other.txt", kitti_rows(11));
    options.layout = "folder";
    EXPECT_EQ(open(options).info().T_world_sensor[1].translation().x(), 1.0);
}

TEST_F(Apollo, RowsThatAreMissingAreLostPoses) {
    data.put("poses.txt", row(2) + row(1));
    const Recording recording = open();
    EXPECT_TRUE(has_note(recording, "9 of 11 scans have no pose"));
    EXPECT_TRUE(has_note(recording, "3.pcd has no row there"));
    EXPECT_FALSE(recording.info().measured_stamps);
    EXPECT_EQ(recording.info().T_world_sensor[1].translation().y(), 4.0);
    std::filesystem::rename(data / "poses.txt", data / "elsewhere.txt");
    OpenOptions options;
    options.poses = data / "elsewhere.txt";
    EXPECT_EQ(open(options).info().T_world_sensor[1].translation().y(), 4.0);
}

TEST_F(Apollo, FaultsAreNamedWithFileAndLine) {
    data.put("poses.txt", row(1) + "2 1500000000 0 0 0 0 0 1\n");
    EXPECT_HAS(open_error(), "poses.txt (line 2): 8 columns");
    data.put("poses.txt", row(1) + row(1));
    EXPECT_HAS(open_error(), "(line 2): two rows are of scan 1");
    data.put("poses.txt", row(1) + "2 1500000000 0 0 0 0 0 0 2\n");
    EXPECT_HAS(open_error(), "(line 2): the quaternion has length 2");
    data.put("poses.txt", row(1) + "2 nan 0 0 0 0 0 0 1\n");
    EXPECT_HAS(open_error(), "(line 2): the stamp");
    data.put("poses.txt", row(1) + "b 1500000000 0 0 0 0 0 0 1\n");
    EXPECT_HAS(open_error(), "'b' is no number of a scan");
    data.put("poses.txt", "# index stamp x y z qx qy qz qw\n" + row(77));
    EXPECT_HAS(open_error(), "no row of any scan");
}

}  // namespace apollo_test
}  // namespace dynamic_filter::io
