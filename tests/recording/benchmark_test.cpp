// SPDX-License-Identifier: MIT
#include "recording/benchmark.hpp"

#include "support/recording.hpp"

namespace dynamic_filter::io {
namespace benchmark_test {

using BenchmarkTest = RecordingFiles;

TEST_F(BenchmarkTest, PosesAndTruthAreInTheFiles) {
    put_pcd("pcd/000000.pcd", 0.0, 1.0F);
    put_pcd("pcd/000001.pcd", 2.0, 0.0F);
    const Recording recording = open();
    EXPECT_EQ(recording.info().layout, "benchmark");
    EXPECT_TRUE(recording.info().T_world_sensor.empty());
    EXPECT_TRUE(recording.info().intensity_is_truth);
    const FullScan scan = recording.read(1);
    EXPECT_EQ(scan.T_world_sensor.translation().x(), 2.0);
    EXPECT_EQ(scan.points, (Points{{8, 0, 0}, {-2, 5, 0}}));
    EXPECT_EQ(positions(scan.cloud)[0].x(), 10.0F);
    EXPECT_EQ(recording.read(0).truth, (Labels{Label::dynamic, Label::static_}));
}

TEST_F(BenchmarkTest, IntensityThatIsAMeasurement) {
    put_pcd("pcd/000000.pcd", 1.0, 0.0F);
    EXPECT_FALSE(open().info().has_truth());  // all 0: nothing says that it is truth
    put_pcd("pcd/000000.pcd", 1.0, 0.5F);
    EXPECT_FALSE(open().info().has_truth());
    put_pcd("gt_cloud.pcd", 0.0, 1.0F);  // where the truth is then, alone
    EXPECT_FALSE(open().info().has_truth());
    put_pcd("pcd/000000.pcd", 1.0, 0.0F);  // a scan in which nothing moves
    EXPECT_TRUE(open().info().has_truth());
    EXPECT_EQ(open().read(0).truth[0], Label::static_);
}

TEST_F(BenchmarkTest, AScanThatCannotBeReadDecidesNothing) {
    data.put("pcd/000000.pcd", "no PCD");
    put_pcd("pcd/000001.pcd", 2.0, 1.0F);
    const Recording recording = open();
    EXPECT_TRUE(recording.info().intensity_is_truth);
    EXPECT_HAS(error_of([&] { (void)recording.read(0); }), "'no'");
    EXPECT_EQ(recording.read(1).T_world_sensor.translation().x(), 2.0);
}

TEST_F(BenchmarkTest, NoPoses) {
    put_pcd("pcd/000000.pcd", 0.0, 1.0F);
    EXPECT_TRUE(has_note(open(), "identity"));
    put_pcd("pcd/000001.pcd", 0.0, 1.0F);
    EXPECT_EQ(open().info().layout, "folder");
    EXPECT_FALSE(open().info().has_poses);
    OpenOptions options;
    options.layout = "benchmark";
    EXPECT_HAS(open_error(options), "VIEWPOINT of every scan is the identity");
    options.poses = data.put("p.txt", kitti_rows(2));
    EXPECT_EQ(open(options).read(1).points[0].x(), 9.0F);
    data.put("poses.txt", kitti_rows(2));
    EXPECT_EQ(open().read(1).T_world_sensor.translation().x(), 1.0);
    EXPECT_EQ(open().read(1).points[0].x(), 10.0F);
}

}  // namespace benchmark_test
}  // namespace dynamic_filter::io
