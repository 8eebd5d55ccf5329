// SPDX-License-Identifier: MIT
#include "recording/layouts/layouts.hpp"
#include "support/recording.hpp"

namespace dynamic_filter::io {
namespace bin_points_test {

/// Files with 5, 6, 7... points of so many floats each.
class BinPoints : public RecordingFiles {
protected:
    void put_points(const std::string& folder, std::size_t floats_per_point, int files) const {
        for (int i = 0; i < files; ++i) {
            const auto points = static_cast<std::size_t>(5 + i);
            data.put(folder + "/" + std::to_string(100 + i) + ".bin",
                     std::string(4 * floats_per_point * points, '\0'));
        }
    }
};

TEST_F(BinPoints, OtherThanFourFloatsAreNamedBeforeAnythingIsRead) {
    for (const char* folder : {"velodyne", "lidar"}) {
        put_points(folder, 6, 8);  // as in Boreas; every second size is a multiple of 16, too
        EXPECT_HAS(open_error(), "24 bytes a point");
        std::filesystem::remove_all(data / folder);
        put_points(folder, 3, 8);
        EXPECT_HAS(open_error(), "12 bytes a point");
        std::filesystem::remove_all(data / folder);
        put_points(folder, 5, 8);
        EXPECT_HAS(open_error(), "20 bytes a point");
        EXPECT_HAS(open_error(), "name them *.pcd.bin");
        std::filesystem::remove_all(data / folder);
        put_points(folder, 4, 8);
        EXPECT_EQ(open().size(), 8U);
        std::filesystem::remove_all(data / folder);
    }
}

TEST_F(BinPoints, ATruncatedFileAmongOthersIsLeftToTheReader) {
    put_points("velodyne", 4, 8);
    data.put("velodyne/103.bin", std::string(5 * 16 + 5, '\0'));
    const Recording recording = open();
    EXPECT_EQ(recording.size(), 8U);
    EXPECT_HAS(error_of([&] { (void)recording.read(3); }), "truncated after point 5");
}

TEST_F(BinPoints, SizesOfVeryFewFilesProveNothing) {
    put_points("velodyne", 6, 3);
    EXPECT_EQ(open().size(), 3U);
}

}  // namespace bin_points_test
}  // namespace dynamic_filter::io
