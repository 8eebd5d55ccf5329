// SPDX-License-Identifier: MIT
#include "formats/poses/pose_table.hpp"

#include "support/bytes.hpp"

namespace dynamic_filter::io {
namespace pose_table_test {

PoseFile read(const std::string& text) {
    const TemporaryFolder folder;
    return read_poses(folder.put("p.csv", text));
}

const std::string euroc =
    "#timestamp [ns], p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], "
    "q_RS_z []\n";

TEST(PoseTable, EurocIsNanosecondsAndWxyz) {
    const PoseFile file = read(euroc + "1500000000,1,2,3,0,0,0,1\n");
    EXPECT_DOUBLE_EQ(file.stamps.at(0), 1.5);
    EXPECT_EQ(file.poses.at(0).translation(), Eigen::Vector3d(1, 2, 3));
    EXPECT_EQ(file.poses.at(0).linear()(0, 0), -1.0);  // half a turn about z
}

TEST(PoseTable, CommentsAndBlankLinesArePassedOver) {
    EXPECT_EQ(read(euroc + "\n# here it begins\n1500000000,1,2,3,0,0,0,1\n").poses.size(), 1U);
}

TEST(PoseTable, NamedColumnsInAnyOrder) {
    const PoseFile file = read("idx,QW,qx,qy,qz,tz,ty,tx,time\n7,1,0,0,0,3,2,1,4.5\n");
    EXPECT_EQ(file.stamps.at(0), 4.5);
    EXPECT_EQ(file.poses.at(0).translation(), Eigen::Vector3d(1, 2, 3));
    EXPECT_TRUE(read("x,y,z,qx,qy,qz,qw\n0,0,0,0,0,0,1\n").stamps.empty());
    EXPECT_EQ(read("stamp_ms,x,y,z,qx,qy,qz,qw\n5,0,0,0,0,0,0,1\n").stamps.at(0), 0.005);
    EXPECT_EQ(read("#sec,nsec,x,y,z,qx,qy,qz,qw\n16,500000000,0,0,0,0,0,0,1\n").stamps.at(0), 16.5);
    EXPECT_FALSE(read("x,y,z,qx,qy,qz,qw\nnan,0,0,0,0,0,1\n").poses.at(0).matrix().allFinite());
}

TEST(PoseTable, MatricesWithoutHeader) {
    const PoseFile file = read(
        "1500000000,1,0,0,7,0,1,0,8,0,0,1,9\n1600000000,nan,0,0,7,0,1,0,8,"
        "0,0,1,9\n");
    ASSERT_EQ(file.poses.size(), 2U);
    EXPECT_DOUBLE_EQ(file.stamps[0], 1.5);
    EXPECT_EQ(file.poses[0].translation(), Eigen::Vector3d(7, 8, 9));
    EXPECT_FALSE(file.poses[1].matrix().allFinite());
}

TEST(PoseTable, FaultsAreNamed) {
    const auto error = [](const std::string& text) { return error_of([&] { read(text); }); };
    EXPECT_HAS(error("1,2,3,4,5,6,7,8\n"), "header");
    EXPECT_HAS(error("1,2,0,0,7,0,1,0,8,0,0,1,9\n"), "orthogonal");
    EXPECT_HAS(error("1,a,0,0,7,0,1,0,8,0,0,1,9\n"), "'a'");
    EXPECT_HAS(error("time,x,y,z,qx,qy,qz\n"), "'qw'");
    EXPECT_HAS(error("time,x,tx,y,z,qx,qy,qz,qw\n"), "two columns");
    EXPECT_HAS(error("time [h],x,y,z,qx,qy,qz,qw\n"), "unit");
    EXPECT_HAS(error(euroc), "no pose");
    EXPECT_HAS(error(euroc + "0,1,2,3,1,0,0\n"), "7 columns");
    EXPECT_HAS(error(euroc + "0,1,2,3,1,0,0,a\n"), "'a'");
    EXPECT_HAS(error(euroc + "0,1,2,3,0.5,0,0,0\n"), "line 2");
    EXPECT_HAS(error(euroc + "2,1,2,3,1,0,0,0\n1,1,2,3,1,0,0,0\n"), "line 3");
}

}  // namespace pose_table_test
}  // namespace dynamic_filter::io
