// SPDX-License-Identifier: MIT
#include "dynamic_filter/poses.hpp"

#include "dynamic_filter/writers.hpp"
#include "support/bytes.hpp"

namespace dynamic_filter::io {
namespace poses_test {

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

TEST_F(Poses, KittiRowsAfterAStampOrAnIndex) {
    const std::string row = " 1 0 0 7 0 1 0 8 0 0 1 9\n";
    const PoseFile stamped = read("1700000000.5" + row + "1700000001.25" + row);
    EXPECT_EQ(stamped.stamps, (std::vector<double>{1700000000.5, 1700000001.25}));
    EXPECT_EQ(stamped.poses.at(1).translation(), Eigen::Vector3d(7, 8, 9));
    EXPECT_EQ(read("0.1" + row + "1.1" + row).stamps.size(), 2U);
    for (const std::string first : {"0", "1", "17"}) {
        const PoseFile indexed = read(first + row + std::to_string(std::stoi(first) + 1) + row);
        EXPECT_TRUE(indexed.stamps.empty()) << first;
        EXPECT_EQ(indexed.poses.size(), 2U);
    }
    EXPECT_FALSE(read("1 nan 0 0 7 0 1 0 8 0 0 1 9\n").poses.at(0).matrix().allFinite());
    EXPECT_HAS(error("nan" + row), "not finite");
}

TEST_F(Poses, RowsOfWholeMatrices) {
    const std::string matrix = "1 0 0 7 0 1 0 8 0 0 1 9 0 0 0 1\n";
    const PoseFile file = read(matrix + "nan 0 0 7 0 1 0 8 0 0 1 9 0 0 0 1\n");
    ASSERT_EQ(file.poses.size(), 2U);
    EXPECT_TRUE(file.stamps.empty());
    EXPECT_EQ(file.poses[0].translation(), Eigen::Vector3d(7, 8, 9));
    EXPECT_FALSE(file.poses[1].matrix().allFinite());
    EXPECT_EQ(read("0.5 " + matrix + "0.75 " + matrix).stamps, (std::vector<double>{0.5, 0.75}));
    EXPECT_TRUE(read("0 " + matrix + "1 " + matrix).stamps.empty());
}

TEST_F(Poses, MatricesBelowEachOther) {
    const std::string block = "1 0 0 7\n0 1 0 8\n0 0 1 9\n0 0 0 1\n";
    const PoseFile file = read("# two\n" + block + "\n" + block);
    ASSERT_EQ(file.poses.size(), 2U);
    EXPECT_EQ(file.poses[1].translation(), Eigen::Vector3d(7, 8, 9));
    EXPECT_HAS(error(block + "1 0 0 7\n"), "after 1 of the 4 rows");
    EXPECT_HAS(error("1 0 0 7\n0 1 0 8\n0 0 1 9\n1 0 0 7\n"), "line 4");
}

TEST_F(Poses, CommasInPlaceOfBlanks) {
    const PoseFile tum = read("1.5,1,2,3,0,0,1,0\n2.5, 1, 2, 3, 0, 0, 0, 1,\n");
    EXPECT_EQ(tum.stamps, (std::vector<double>{1.5, 2.5}));
    EXPECT_EQ(tum.poses.at(0).linear()(0, 0), -1.0);
    EXPECT_EQ(read("1,0,0,7,0,1,0,8,0,0,1,9\n").poses.at(0).translation(),
              Eigen::Vector3d(7, 8, 9));
    EXPECT_EQ(read("1.5,1,0,0,7,0,1,0,8,0,0,1,9\n").stamps.at(0), 1.5);
    EXPECT_HAS(error("1700000000000000000,1,2,3,1,0,0,0\n"), "EuRoC");
}

TEST_F(Poses, RowsAreSortedByTime) {
    const PoseFile file = read("1 1 0 0 0 0 0 1\n3 3 0 0 0 0 0 1\n2 2 0 0 0 0 0 1\n");
    EXPECT_EQ(file.stamps, (std::vector<double>{1, 2, 3}));
    EXPECT_EQ(file.poses.at(1).translation().x(), 2.0);
    EXPECT_HAS(file.notes.at(0), "line 3");
    EXPECT_TRUE(read("1 0 0 0 0 0 0 1\n2 0 0 0 0 0 0 1\n").notes.empty());
    const std::string second = "1 50 0 0 0 0 0 1\n2 51 0 0 0 0 0 1\n3 52 0 0 0 0 0 1\n";
    EXPECT_HAS(error("1 0 0 0 0 0 0 1\n2 1 0 0 0 0 0 1\n3 2 0 0 0 0 0 1\n" + second),
               "several trajectories");
}

TEST_F(Poses, MarksOfTheOrderOfBytes) {
    const std::string row = "1.5 1 2 3 0 0 1 0\n";
    EXPECT_EQ(read("\xEF\xBB\xBF" + row).stamps.at(0), 1.5);
    std::string little = "\xFF\xFE", big = "\xFE\xFF";
    for (const char c : row) {
        little += std::string{c, '\0'};
        big += std::string{'\0', c};
    }
    EXPECT_EQ(read(little).stamps.at(0), 1.5);
    EXPECT_EQ(read(big).poses.at(0).translation(), Eigen::Vector3d(1, 2, 3));
    EXPECT_HAS(error(little + std::string("x\0", 2)), "line 2");
}

TEST_F(Poses, BadRowsAreNamed) {
    EXPECT_HAS(error(""), "no pose");
    EXPECT_HAS(error("1 2 3\n"), "3 columns");
    EXPECT_HAS(error("1 2 3 0 0 0 1\n"), "x y z qw qx qy qz");
    EXPECT_HAS(error("1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 2\n"), "0 0 0 2; expected 0 0 0 1");
    EXPECT_HAS(error("1 0 0 0 0 1 0 0 0 0 1 0 7 8 9 1\n"), "transposed");
    EXPECT_HAS(error("1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0\n"), "line 2");
    EXPECT_HAS(error("1 0 0 0 0 1 0 0 0 0 1 zero\n"), "'zero'");
    EXPECT_HAS(error("2 0 0 0 0 2 0 0 0 0 2 0\n"), "scaled by 2");
    EXPECT_HAS(error("0 1 2 3 0 0 0 0\n"), "xyzw");
    EXPECT_HAS(error("0 1 2 3 0 0 0 0.9\n"), "line 1");
    EXPECT_HAS(error("nan 0 0 0 0 0 0 1\n"), "not finite");
    error_of([&] { read_poses(folder_ / "none.txt"); });
}

TEST_F(Poses, OtherKindsOfFilesAndCommasAreNamed) {
    const auto error = [&](const std::string& text) {
        return error_of([&] { (void)read_poses(folder_.put("a.txt", text)); });
    };
    EXPECT_HAS(error("#ROSBAG V2.0\nE"), "is a ROS 1 bag; expected a pose file");
    EXPECT_HAS(error("ply\nformat ascii 1.0\n"), "is a PLY cloud");
    EXPECT_HAS(error(std::string(32, '\0')), "is a binary file");
    EXPECT_HAS(error("# t;x\n0;0;0;0;0;0;0;1\n"), "line 2");
    EXPECT_HAS(error("t;x;y;z;qx;qy;qz;qw\n0;0;0;0;0;0;0;1\n"), "has semicolons");
    EXPECT_HAS(error("0,1 0,0 0,0 0,0 0,0 0,0 0,0 1\n"), "has decimal commas");
    const std::string header = "timestamp, x, y, z, qx, qy, qz, qw\n";
    EXPECT_EQ(read_poses(folder_.put("a.csv", header + "0, 1, 2, 3, 0, 0, 0, 1\n")).poses.size(),
              1U);
}

TEST_F(Poses, G2oInTheOrderOfTheIds) {
    const PoseFile file = read(
        "# graph\nEDGE_SE3:QUAT 2 10 1 1 1 0 0 0 1\nVERTEX_SE3:QUAT 10 1 2 3 0 0 1 0\nFIX 2\n"
        "VERTEX_TRACKXYZ 7 1 1 1\nVERTEX_SE3:QUAT 2 4 5 6 0 0 0 1\n"
        "VERTEX_SE3:QUAT 6989586621679009792 nan 0 0 0 0 0 1\n");
    ASSERT_EQ(file.poses.size(), 3U);
    EXPECT_TRUE(file.stamps.empty());
    EXPECT_EQ(file.poses[0].translation(), Eigen::Vector3d(4, 5, 6));
    EXPECT_EQ(file.poses[1].linear()(0, 0), -1.0);  // half a turn about z
    EXPECT_FALSE(file.poses[2].matrix().allFinite());
    EXPECT_HAS(error("VERTEX_SE2 0 1 2 3\n"), "no pose");
    EXPECT_HAS(error("VERTEX_SE3:QUAT a 0 0 0 0 0 0 1\n"), "'a'");
    EXPECT_HAS(error("VERTEX_SE3:QUAT 0 0 0 0 0 0 0\n"), "6 numbers");
    const std::string vertex = "VERTEX_SE3:QUAT 0 0 0 0 0 0 0 1\n";
    EXPECT_HAS(error(vertex + vertex), "line 2");
}

std::vector<Pose> some_poses() {
    std::vector<Pose> poses(3, Pose::Identity());
    poses[1].linear() =
        Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
    poses[1].translation() = Eigen::Vector3d(123456.789, -0.1, 1e-7);
    poses[2].linear() = Eigen::AngleAxisd(3.1, Eigen::Vector3d::UnitY()).toRotationMatrix();
    return poses;
}

void expect_same(const PoseFile& file, const std::vector<Pose>& poses) {
    ASSERT_EQ(file.poses.size(), poses.size());
    for (std::size_t i = 0; i < poses.size(); ++i) {
        EXPECT_EQ(file.poses[i].translation(), poses[i].translation());
        EXPECT_TRUE(file.poses[i].linear().isApprox(poses[i].linear(), 1e-14));
    }
}

TEST_F(Poses, WrittenAndReadBack) {
    const std::vector<Pose> poses = some_poses();
    const std::vector<double> stamps = {0.0, 0.5, 1403636579.763555};
    write_poses_tum(folder_ / "p.txt", stamps, poses);
    expect_same(read_poses(folder_ / "p.txt"), poses);
    EXPECT_EQ(read_poses(folder_ / "p.txt").stamps, stamps);
    write_poses_csv(folder_ / "p.txt", stamps, poses);
    expect_same(read_poses(folder_ / "p.txt"), poses);
    EXPECT_NEAR(read_poses(folder_ / "p.txt").stamps[2], stamps[2], 5e-7);
    write_poses_g2o(folder_ / "p.txt", poses);
    expect_same(read_poses(folder_ / "p.txt"), poses);
    EXPECT_THROW(write_poses_tum(folder_ / "p.txt", {}, poses), OutputError);
}

TEST_F(Poses, WrittenWithoutTracking) {
    std::vector<Pose> poses = some_poses();
    poses[1].matrix().topRows<3>().setConstant(std::nan(""));
    write_poses_tum(folder_ / "p.txt", std::vector<double>{0, 1, 2}, poses);
    EXPECT_FALSE(read_poses(folder_ / "p.txt").poses.at(1).matrix().allFinite());
    write_poses_g2o(folder_ / "p.txt", poses);
    EXPECT_EQ(read_poses(folder_ / "p.txt").poses.size(), 2U);
}

TEST_F(Poses, CalibTr) {
    const auto calib = [&](const std::string& text) {
        return read_calib_tr(folder_.put("calib.txt", text));
    };
    const Pose Tr = calib("P0: 1 2\nTr: 0 -1 0 7 0 0 -1 8 1 0 0 9\n");
    EXPECT_EQ(Tr.translation(), Eigen::Vector3d(7, 8, 9));
    EXPECT_EQ(Tr * Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(7, 8, 10));
    const std::string other = "0 -1 0 7 0 0 -1 8 1 0 0 9\n";
    EXPECT_EQ(calib("Tr_velo_cam: " + other).matrix(), Tr.matrix());
    const Pose turned = calib("R0_rect: 0 -1 0 1 0 0 0 0 1\nTr_velo_to_cam: " + other);
    EXPECT_EQ(turned.translation(), Eigen::Vector3d(-8, 7, 9));
    EXPECT_HAS(error_of([&] { calib("P0: 1\n"); }), "no line 'Tr:'");
    EXPECT_HAS(error_of([&] { calib("Tr: 1 2 3\n"); }), "12 finite");
    EXPECT_HAS(error_of([&] { calib("R_rect 1 2 3\nTr_velo_cam: " + other); }), "9 numbers");
}

TEST_F(Poses, Times) {
    const std::vector<double> stamps = {0.0, 0.1, 1403636579.763555};
    write_times(folder_ / "t.txt", stamps);
    EXPECT_EQ(read_times(folder_ / "t.txt"), stamps);
    EXPECT_HAS(error_of([&] { read_times(folder_.put("t.txt", "0\n1 2\n")); }), "line 2");
    EXPECT_HAS(error_of([&] { read_times(folder_.put("t.txt", "nan\n")); }), "no time");
}

}  // namespace poses_test
}  // namespace dynamic_filter::io
