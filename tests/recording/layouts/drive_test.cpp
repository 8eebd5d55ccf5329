// SPDX-License-Identifier: MIT
#include "recording/layouts/drive.hpp"

#include "recording/folders.hpp"
#include "support/recording.hpp"

namespace dynamic_filter::io {
namespace drive_test {

class Drive : public RecordingFiles {
protected:
    void SetUp() override { put_bins("d/velodyne_points/data", 3); }
};

TEST_F(Drive, IsFoundFromItsFolders) {
    const auto drive = data / "d";
    EXPECT_TRUE(is_drive(drive));
    EXPECT_FALSE(is_drive(data.path()));
    for (const char* given :
         {"d", "d/velodyne_points", "d/velodyne_points/data", "d/velodyne_points/data/"}) {
        ASSERT_TRUE(drive_of(data / given)) << given;
        EXPECT_EQ(whole_path(*drive_of(data / given)), whole_path(drive));
    }
    std::filesystem::create_directories(data / "other/data");
    EXPECT_FALSE(drive_of(data / "other/data"));
    EXPECT_FALSE(drive_of(data.path()));
}

TEST_F(Drive, AStampIsInTheRowWithTheNumberOfTheScan) {
    const auto row = [](int second) {
        return "2011-09-26 13:02:0" + std::to_string(second) + ".500000000\n";
    };
    const auto file = data.put("d/velodyne_points/timestamps.txt", row(1) + row(2) + row(4));
    Layout layout = scans_of_drive(data / "d");
    ASSERT_EQ(layout.stamps.size(), 3U);
    EXPECT_DOUBLE_EQ(layout.stamps[2] - layout.stamps[0], 3.0);
    std::filesystem::remove(data / "d/velodyne_points/data/000001.bin");
    layout = scans_of_drive(data / "d");
    ASSERT_EQ(layout.stamps.size(), 2U);
    EXPECT_DOUBLE_EQ(layout.stamps[1] - layout.stamps[0], 3.0);
    data.put("d/velodyne_points/timestamps.txt", row(1));
    EXPECT_HAS(error_of([&] { (void)scans_of_drive(data / "d"); }),
               "1 timestamps but 2 scans in " + (data / "d/velodyne_points/data").string());
    std::filesystem::remove(file);
    EXPECT_TRUE(scans_of_drive(data / "d").stamps.empty());
}

TEST_F(Drive, WithoutScansThereIsNone) {
    std::filesystem::create_directories(data / "e/velodyne_points/data");
    EXPECT_HAS(error_of([&] { (void)scans_of_drive(data / "e"); }), "no *.bin found");
}

TEST_F(Drive, PosesOfTheUserComeFirst) {
    Layout layout;
    OpenOptions options;
    EXPECT_FALSE(needs_no_poses(layout, options));
    options.without_poses = true;
    EXPECT_TRUE(needs_no_poses(layout, options));
    EXPECT_FALSE(layout.poses);
    options = {};
    options.poses = "p.txt";
    EXPECT_TRUE(needs_no_poses(layout, options));
    EXPECT_EQ(layout.poses, "p.txt");
}

}  // namespace drive_test
}  // namespace dynamic_filter::io
