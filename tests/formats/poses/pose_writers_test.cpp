// SPDX-License-Identifier: MIT
#include "dynamic_filter/writers.hpp"
#include "support/bytes.hpp"

namespace dynamic_filter::io {
namespace pose_writers_test {

/// At (1, 2.5, -3), upside down: half a turn about x.
std::vector<Pose> turned() {
    Pose pose = Pose::Identity();
    pose.translation() = Eigen::Vector3d(1.0, 2.5, -3.0);
    pose.linear() << 1, 0, 0, 0, -1, 0, 0, 0, -1;
    return {pose};
}
const std::vector<double> stamps{1600000000.25};

TEST(PoseWriters, RowsAreAsTheirFormatsWant) {
    const TemporaryFolder folder;
    const auto file = folder / "p.txt";
    write_poses_kitti(file, turned());
    EXPECT_EQ(slurp(file), "1 0 0 1 0 -1 0 2.5 0 0 -1 -3\n");
    write_poses_tum(file, stamps, turned());
    EXPECT_EQ(slurp(file),
              "# timestamp tx ty tz qx qy qz qw\n1600000000.250000000 1 2.5 -3 1 0 0 0\n");
    write_poses_csv(file, stamps, turned());
    const std::string csv = slurp(file);
    EXPECT_EQ(csv.substr(csv.find('\n') + 1), "1600000000250000000,1,2.5,-3,0,1,0,0\n");
    write_poses_g2o(file, turned());
    EXPECT_EQ(slurp(file), "VERTEX_SE3:QUAT 0 1 2.5 -3 1 0 0 0\n");
}

TEST(PoseWriters, RefuseAnotherNumberOfStampsAndLeaveNothing) {
    const TemporaryFolder folder;
    const auto file = folder / "p.txt";
    EXPECT_HAS(error_of<OutputError>([&] { write_poses_tum(file, {}, turned()); }),
               "0 stamps but 1 poses");
    EXPECT_HAS(error_of<OutputError>([&] { write_poses_csv(file, stamps, {}); }),
               "1 stamps but 0 poses");
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace pose_writers_test
}  // namespace dynamic_filter::io
