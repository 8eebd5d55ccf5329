// SPDX-License-Identifier: MIT
#include "recording/layouts/layouts.hpp"
#include "support/recording.hpp"

namespace dynamic_filter::io {
namespace folder_test {

class FolderTest : public RecordingFiles {
protected:
    void put_parts(const char* first, const char* second) const {
        const std::string bytes = floats({1, 2, 3, 0.5F, 4, 5, 6, 0.5F});
        for (const char* name : {"000000.bin", "000001.bin"}) {
            data.put(std::string(first) + "/" + name, bytes);
        }
        for (const char* name : {"000002.bin", "000003.bin", "000004.bin"}) {
            data.put(std::string(second) + "/" + name, bytes);
        }
    }
};

TEST_F(FolderTest, NumberedFoldersWithPosesBesideThemAreOneDrive) {
    put_parts("0009", "0010");
    EXPECT_HAS(open_error(), "0009 (2 files), 0010 (3 files)");
    data.put("poses.txt", kitti_rows(5));
    const Recording recording = open();
    ASSERT_EQ(recording.size(), 5U);
    EXPECT_TRUE(has_note(recording, "2 folders, 0009 to 0010, are read as one drive"));
    EXPECT_EQ(recording.info().scan_files[2], data / "0010/000002.bin");
    EXPECT_NEAR(recording.read(4).T_world_sensor.translation().x(), 4.0, 1e-9);
    data.put("poses.txt", kitti_rows(4));
    EXPECT_HAS(open_error(), "5 scans in");
}

TEST_F(FolderTest, FoldersWithPosesOfTheirOwnAreSeveralDrives) {
    put_parts("0", "1");
    data.put("poses.txt", kitti_rows(5));
    data.put("1/poses.txt", kitti_rows(3));
    EXPECT_HAS(open_error(), "give one of them");
}

TEST_F(FolderTest, NamesThatBeginAnewInEachFolderAreRefused) {
    put_parts("0", "1");
    data.put("1/000001.bin", floats({1, 2, 3, 0.5F}));
    data.put("poses.txt", kitti_rows(6));
    EXPECT_HAS(open_error(), "0/000001.bin and 1/000001.bin have the same name");
}

}  // namespace folder_test
}  // namespace dynamic_filter::io
