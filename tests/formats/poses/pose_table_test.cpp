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

TEST(PoseTable, TitlesWithBlanksBetweenThem) {
    const PoseFile file = read("time [ms] x y z qw qx qy qz\n5 1 2 3 0 0 0 1\n");
    EXPECT_EQ(file.stamps.at(0), 0.005);
    EXPECT_EQ(file.poses.at(0).linear()(0, 0), -1.0);
    EXPECT_EQ(read("timestamp x y z qx qy qz qw\n5 1 2 3 0 0 1 0\n").stamps.at(0), 5.0);
    EXPECT_EQ(read("x y z qw qx qy qz\n1 2 3 0 0 0 1\n").poses.at(0).linear()(0, 0), -1.0);
    // A comment tells the order, too, if it names every column.
    EXPECT_EQ(read("# t tx ty tz qw qx qy qz\n5 1 2 3 0 0 0 1\n").poses.at(0).linear()(0, 0), -1.0);
    EXPECT_EQ(read("# t tx ty tz\n5 1 2 3 0 0 1 0\n").poses.at(0).linear()(0, 0), -1.0);
    EXPECT_EQ(read("t r00 r01 r02 tx r10 r11 r12 ty r20 r21 r22 tz\n"
                   "5.5 1 0 0 7 0 1 0 8 0 0 1 9\n")
                  .poses.at(0)
                  .translation(),
              Eigen::Vector3d(7, 8, 9));
}

TEST(PoseTable, TitlesOfRostopicAndOthers) {
    const PoseFile file = read(
        "%time,field.header.seq,field.header.stamp,field.header.frame_id,"
        "field.pose.pose.position.x,field.pose.pose.position.y,field.pose.pose.position.z,"
        "field.pose.pose.orientation.x,field.pose.pose.orientation.y,"
        "field.pose.pose.orientation.z,field.pose.pose.orientation.w,field.twist.twist.linear.x\n"
        "9500000000,7,1500000000,odom,1,2,3,0,0,1,0,4\n");
    EXPECT_DOUBLE_EQ(file.stamps.at(0), 1.5);
    EXPECT_EQ(file.poses.at(0).translation(), Eigen::Vector3d(1, 2, 3));
    EXPECT_EQ(file.poses.at(0).linear()(0, 0), -1.0);
    EXPECT_EQ(read("Time,header.stamp.secs,header.stamp.nsecs,pose.position.x,pose.position.y,"
                   "pose.position.z,pose.orientation.x,pose.orientation.y,pose.orientation.z,"
                   "pose.orientation.w\n8,3,250000000,1,2,3,0,0,1,0\n")
                  .stamps.at(0),
              3.25);
    EXPECT_EQ(read("timestamp_s,px,py,pz,rx,ry,rz,rw\n4,1,2,3,0,0,1,0\n").stamps.at(0), 4.0);
    EXPECT_EQ(read("pos_x (m),pos_y (m),pos_z (m),q_x,q_y,q_z,q_w\n1,2,3,0,0,1,0\n")
                  .poses.at(0)
                  .translation(),
              Eigen::Vector3d(1, 2, 3));
    EXPECT_HAS(error_of([] { read("t,px,py,pz,rx,ry,rz\n4,1,2,3,0,0,1\n"); }), "angles");
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
    EXPECT_HAS(error("1,2,3,4,5,6,7,8\n"), "length");
    EXPECT_HAS(error("1,2,0,0,7,0,1,0,8,0,0,1,9\n"), "orthogonal");
    EXPECT_HAS(error("1,a,0,0,7,0,1,0,8,0,0,1,9\n"), "'a'");
    EXPECT_HAS(error("time,x,y,z,qx,qy,qz\n"), "'qw'");
    EXPECT_HAS(error("time,x,tx,y,z,qx,qy,qz,qw\n"), "two columns");
    EXPECT_HAS(error("time [h],x,y,z,qx,qy,qz,qw\n"), "unit");
    EXPECT_HAS(error(euroc), "no pose");
    EXPECT_HAS(error(euroc + "0,1,2,3,1,0,0\n"), "7 columns");
    EXPECT_HAS(error(euroc + "0,1,2,3,1,0,0,a\n"), "'a'");
    EXPECT_HAS(error(euroc + "0,1,2,3,0.5,0,0,0\n"), "line 2");
    EXPECT_EQ(read(euroc + "2,1,2,3,1,0,0,0\n1,1,2,3,1,0,0,0\n").notes.size(), 1U);
}

}  // namespace pose_table_test
}  // namespace dynamic_filter::io
