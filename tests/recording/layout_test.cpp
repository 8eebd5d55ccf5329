// SPDX-License-Identifier: MIT
#include "recording/layout.hpp"

#include "support/recording.hpp"

namespace dynamic_filter::io {
namespace io_layout_test {

using LayoutTest = RecordingFiles;

TEST_F(LayoutTest, NothingThere) {
    EXPECT_HAS(error_of([&] { (void)open_recording(data / "none"); }), "does not exist");
    EXPECT_HAS(error_of([&] { (void)open_recording(data.put("a.txt", "")); }), "is a file");
    EXPECT_HAS(open_error(), "holds no scans");
    std::filesystem::create_directories(data / "velodyne");
    EXPECT_HAS(open_error(), "no *.bin");
}

TEST_F(LayoutTest, TextsWithTitlesOfPointsAreScans) {
    data.put("scans/frame (Frame 0000).csv", "\"Points:0\",\"Points:1\",\"Points:2\"\n1,2,3\n");
    data.put("scans/frame (Frame 0001).csv", "X,Y,Z\n4,5,6\n");
    data.put("scans/poses.csv", "x,y,z,qx,qy,qz,qw\n0,0,0,0,0,0,1\n0,0,0,0,0,0,1\n");
    data.put("scans/notes.csv", "a,b\n1,2\n");
    const Recording recording = open();
    ASSERT_EQ(recording.size(), 2U);
    EXPECT_TRUE(recording.info().has_poses);
    EXPECT_EQ(recording.read(1).points, (Points{{4, 5, 6}}));
    put_bins("scans", 1);  // other scans go first
    data.put("scans/poses.csv", "x,y,z,qx,qy,qz,qw\n0,0,0,0,0,0,1\n");
    EXPECT_EQ(open().size(), 1U);
}

TEST_F(LayoutTest, CompressedScansAreNamedWithWhatUnpacksThem) {
    data.put("scans/7.laz", "");
    EXPECT_HAS(open_error(), "holds 1 .laz files");
    EXPECT_HAS(open_error(), "pdal translate 7.laz 7.las");
}

TEST_F(LayoutTest, AnArchiveIsToBeUnpacked) {
    for (const char* head : {"PK\x03\x04", "\x1F\x8B"}) {
        const auto file = data.put("recording.zip", std::string(head) + std::string(50, '\0'));
        EXPECT_HAS(error_of([&] { (void)open_recording(file); }), "archive; unpack it");
    }
}

TEST_F(LayoutTest, TheScanFolderByMistake) {
    put_bins("velodyne", 2);
    data.put("poses.txt", kitti_rows(2));
    EXPECT_HAS(error_of([&] { (void)open_recording(data / "velodyne/"); }), "folder above");
    OpenOptions options;
    options.layout = "folder";
    EXPECT_EQ(open_recording(data / "velodyne", options).size(), 2U);
}

TEST_F(LayoutTest, PosesAreLookedForAndNamed) {
    put_bins("scans", 2);
    EXPECT_FALSE(open().info().has_poses);
    EXPECT_TRUE(has_note(open(), "no pose file found; looked for poses.txt, optimized_poses.txt"));
    OpenOptions options;
    options.poses = data.put("elsewhere/p.txt", kitti_rows(2));
    EXPECT_EQ(open(options).size(), 2U);
    options.poses = data / "none.txt";
    EXPECT_HAS(open_error(options), "none.txt");
    data.put("optimized_poses.txt", kitti_rows(2));
    EXPECT_TRUE(has_note(open(), "optimized_poses.txt"));
    EXPECT_EQ(open_recording(data / "scans").size(), 2U);
}

TEST_F(LayoutTest, PosesAboveTheFolderThatWeAreIn) {
    put_bins("scans", 2);
    data.put("traj.txt", tum_rows(2));
    const auto before = std::filesystem::current_path();
    std::filesystem::current_path(data / "scans");
    EXPECT_EQ(open_recording(".").size(), 2U);
    std::filesystem::current_path(before);
}

TEST_F(LayoutTest, OneKindOfScans) {
    put_bins(".", 2);
    data.put("poses.txt", kitti_rows(2));
    data.put(".hidden.pcd", "");
    EXPECT_EQ(open().size(), 2U);
    data.put("map.pcd", "");
    EXPECT_HAS(open_error(), "mixes");
}

TEST_F(LayoutTest, SeveralTumFilesAreAmbiguous) {
    put_bins(".", 1);
    data.put("a.tum", tum_rows(1));
    data.put("b.tum", tum_rows(1));
    EXPECT_HAS(open_error(), "2 .tum files");
}

TEST_F(LayoutTest, LabelsMayBeOfSomeScansOnly) {
    put_bins("velodyne", 3);
    data.put("poses.txt", kitti_rows(3));
    std::filesystem::create_directories(data / "labels");
    EXPECT_FALSE(open().info().has_truth());
    EXPECT_TRUE(has_note(open(), "labels of 0 of 3 scans"));
    put_labels(2);
    EXPECT_TRUE(open().info().has_truth());
    EXPECT_TRUE(open().info().label_files[2].empty());
    EXPECT_TRUE(has_note(open(), "labels of 2 of 3 scans"));
    EXPECT_TRUE(has_note(open(), "not scored, the first is 000002.bin"));
    put_labels(3);
    EXPECT_TRUE(open().info().has_truth());
    EXPECT_FALSE(has_note(open(), "labels of"));
    put_labels(4);
    EXPECT_TRUE(has_note(open(), "labels of 3 of 3 scans, and 1 of no scan"));
    put_bins("velodyne", 9);  // now most have none, so that is no accident
    data.put("poses.txt", kitti_rows(9));
    EXPECT_TRUE(has_note(open(), "labels of 4 of 9 scans"));
    EXPECT_FALSE(has_note(open(), "the first is"));
}

TEST_F(LayoutTest, ScansAndOptimizedPoses) {
    for (std::size_t i = 0; i < 3; ++i) put_pcd("Scans/" + number(i) + ".pcd", 0, 0);
    data.put("optimized_poses.txt", kitti_rows(3));
    data.put("times.txt", "10.0\n10.5\n11.5\n");
    const Recording recording = open();
    EXPECT_EQ(recording.info().T_world_sensor[2].translation().x(),
              2.0);  // the LiDAR's: no calibration
    EXPECT_EQ(recording.info().stamps[2], 11.5);
}

}  // namespace io_layout_test
}  // namespace dynamic_filter::io
