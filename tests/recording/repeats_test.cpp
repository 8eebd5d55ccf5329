// SPDX-License-Identifier: MIT
#include "recording/repeats.hpp"

#include "support/recording.hpp"

namespace dynamic_filter::io {
namespace repeats_test {

/// A scan of 1,000 points that differ with `seed`.
std::string scan(float seed) {
    std::string bytes;
    for (int i = 0; i < 1000; ++i) {
        bytes += floats({seed + 0.01F * static_cast<float>(i), 2.0F, 0.1F, 0.0F});
    }
    return bytes;
}

Paths put(const TemporaryFolder& folder, const std::vector<std::string>& contents) {
    Paths files;
    for (std::size_t i = 0; i < contents.size(); ++i) {
        const std::string name = std::to_string(i) + ".bin";
        folder.put(name, contents[i]);
        files.push_back(folder / name);
    }
    return files;
}

using Flags = std::vector<std::uint8_t>;

TEST(Repeats, AreFilesWithTheBytesOfTheFileBefore) {
    const TemporaryFolder folder;
    const Paths files =
        put(folder, {scan(1), scan(2), scan(2), scan(2), scan(1), scan(3), scan(4)});
    EXPECT_EQ(repeats_among(files), (Flags{0, 0, 1, 1, 0, 0, 0}));
}

TEST(Repeats, DifferInNoByte) {
    const TemporaryFolder folder;
    std::string nearly = scan(1);
    nearly.back() = 1;
    EXPECT_EQ(repeats_among(put(folder, {scan(1), nearly, scan(2), scan(3)})), Flags{});
}

TEST(Repeats, AreNoneIfMostFilesAreAlikeOrSmallOrMissing) {
    const TemporaryFolder folder;
    EXPECT_EQ(repeats_among(put(folder, {scan(1), scan(1), scan(1)})), Flags{});
    EXPECT_EQ(repeats_among(put(folder, {"a", "a", "b", "c", "d"})), Flags{});
    EXPECT_EQ(repeats_among({folder / "none", folder / "none"}), Flags{});
    EXPECT_EQ(repeats_among({}), Flags{});
}

using RepeatsInRecordings = RecordingFiles;

TEST_F(RepeatsInRecordings, AreRejectedWhereverARecordingIsCut) {
    for (int i = 0; i < 6; ++i) {
        data.put("velodyne/" + std::to_string(i) + ".bin",
                 scan(i == 3 ? 2.0F : static_cast<float>(i)));
    }
    data.put("poses.txt", kitti_rows(6));
    const Recording whole = open();
    EXPECT_HAS(error_of([&] { (void)whole.read(3); }), "repeats the scan before it");
    EXPECT_HAS(error_of([&] { whole.check(3); }), "repeats the scan before it");
    EXPECT_EQ(whole.read(2).points.size(), 1000U);
    const Recording later = slice(whole, 3);
    EXPECT_HAS(error_of([&] { (void)later.read(0); }), "repeats the scan before it");
    EXPECT_EQ(later.read(1).points.size(), 1000U);
}

}  // namespace repeats_test
}  // namespace dynamic_filter::io
