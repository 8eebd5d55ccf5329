// SPDX-License-Identifier: MIT
#include "dynamic_filter/io/poses.hpp"

#include "dynamic_filter/io/writers.hpp"
#include "io/support.hpp"

namespace dynamic_filter::io {
namespace {

class Poses : public testing::Test {
protected:
    PoseFile read(const std::string& text) { return read_poses(folder_.put("p.txt", text)); }
    std::string error(const std::string& text) {
        return error_of([&] { read(text); });
    }
    TemporaryFolder folder_;
};

TEST_F(Poses, KittiRoundTrip) {
    std::vector<Pose> poses(3, Pose::Identity());
    poses[1].linear() = Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    poses[1].translation() = Eigen::Vector3d(123456.789, -0.1, 1e-7);
    poses[2].matrix().topRows<3>().setConstant(std::nan(""));
    write_poses_kitti(folder_ / "p.txt", poses);
    const PoseFile file = read_poses(folder_ / "p.txt");
    ASSERT_EQ(file.poses.size(), 3U);
    EXPECT_TRUE(file.stamps.empty());
    EXPECT_EQ(file.poses[0].matrix(), poses[0].matrix());
    EXPECT_TRUE(file.poses[1].isApprox(poses[1], 1e-15));
    EXPECT_EQ(file.poses[1].translation(), poses[1].translation());
    EXPECT_FALSE(file.poses[2].matrix().allFinite());
}

TEST_F(Poses, TumQuaternionIsXyzw) {
    const PoseFile file =
        read("# timestamp, tx ty tz qx qy qz qw\n\n1.5 1 2 3 0 0 1 0\r\n1.5 1 2 3 0 0 nan 1\n");
    ASSERT_EQ(file.poses.size(), 2U);
    EXPECT_EQ(file.stamps, (std::vector<double>{1.5, 1.5}));
    EXPECT_EQ(file.poses[0].linear()(0, 0), -1.0);  // half a turn about z
    EXPECT_EQ(file.poses[0].linear()(2, 2), 1.0);
    EXPECT_FALSE(file.poses[1].matrix().allFinite());
}

TEST_F(Poses, BadRowsAreNamed) {
    EXPECT_HAS(error(""), "no pose");
    EXPECT_HAS(error("1 2 3\n"), "3 columns");
    EXPECT_HAS(error("1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1\n"), "4x4");
    EXPECT_HAS(error("1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0\n"), "line 2");
    EXPECT_HAS(error("1 0 0 0 0 1 0 0 0 0 1 zero\n"), "'zero'");
    EXPECT_HAS(error("2 0 0 0 0 2 0 0 0 0 2 0\n"), "scaled by 2");
    EXPECT_HAS(error("0 1 2 3 0 0 0 0\n"), "xyzw");
    EXPECT_HAS(error("0 1 2 3 0 0 0 0.9\n"), "line 1");
    EXPECT_HAS(error("2 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n"), "line 2");
    EXPECT_HAS(error("nan 0 0 0 0 0 0 1\n"), "not finite");
    EXPECT_HAS(error("VERTEX_SE3:QUAT 0 0 0 0 0 0 0 1\n"), "VERTEX_SE3");
    error_of([&] { read_poses(folder_ / "none.txt"); });
}

TEST_F(Poses, CalibTr) {
    const auto calib = [&](const std::string& text) {
        return read_calib_tr(folder_.put("calib.txt", text));
    };
    const Pose Tr = calib("P0: 1 2\nTr: 0 -1 0 7 0 0 -1 8 1 0 0 9\n");
    EXPECT_EQ(Tr.translation(), Eigen::Vector3d(7, 8, 9));
    EXPECT_EQ(Tr * Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(7, 8, 10));
    EXPECT_HAS(error_of([&] { calib("P0: 1\n"); }), "no line 'Tr:'");
    EXPECT_HAS(error_of([&] { calib("Tr: 1 2 3\n"); }), "12 finite");
}

TEST_F(Poses, Times) {
    const std::vector<double> stamps = {0.0, 0.1, 1403636579.763555};
    write_times(folder_ / "t.txt", stamps);
    EXPECT_EQ(read_times(folder_ / "t.txt"), stamps);
    EXPECT_HAS(error_of([&] { read_times(folder_.put("t.txt", "0\n1 2\n")); }), "line 2");
    EXPECT_HAS(error_of([&] { read_times(folder_.put("t.txt", "nan\n")); }), "no time");
}

}  // namespace
}  // namespace dynamic_filter::io
