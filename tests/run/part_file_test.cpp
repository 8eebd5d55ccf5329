// SPDX-License-Identifier: MIT
#include "run/part_file.hpp"

#include <gtest/gtest.h>

#include "dynamic_filter/error.hpp"
#include "support/temporary_folder.hpp"

namespace dynamic_filter::app {
namespace part_file_test {

TEST(PartFile, NumbersAreCountedFromOne) {
    EXPECT_EQ(part_number_of("2/8").part, 2U);
    EXPECT_EQ(part_number_of("2/8").parts, 8U);
    for (const char* wrong : {"", "2", "0/8", "9/8", "2/", "/8", "2/8x", "-1/8", "1.5/8", "a/b"}) {
        EXPECT_THROW(part_number_of(wrong), ConfigError) << wrong;
    }
}

TEST(PartFile, GivesBackHowTheRecordingsAreRead) {
    const test::TemporaryFolder folder;
    Part part{.number = {.part = 3, .parts = 4},
              .sources = {{.recording = "/data/a"}, {.recording = "/data/b", .poses = "/p.txt"}},
              .run = {}};
    part.run.data.format = "folder";
    part.run.data.deskew = "off";
    part.run.data.first = 5;
    part.run.data.last = 90;
    part.run.data.topic = "/points";
    part.run.tile_voxels = 12345;
    part.run.maps = false;
    write_part(folder.path(), part);
    const Part read = read_part(folder.path());
    EXPECT_EQ(read.number.part, 3U);
    EXPECT_EQ(read.number.parts, 4U);
    ASSERT_EQ(read.sources.size(), 2U);
    EXPECT_EQ(read.sources[1].recording, "/data/b");
    EXPECT_EQ(read.sources[1].poses, "/p.txt");
    EXPECT_FALSE(read.sources[0].poses);
    EXPECT_EQ(read.run.data.format, "folder");
    EXPECT_EQ(read.run.data.deskew, "off");
    EXPECT_EQ(read.run.data.first, 5U);
    EXPECT_EQ(read.run.data.last, 90U);
    EXPECT_EQ(read.run.data.topic, "/points");
    EXPECT_EQ(read.run.tile_voxels, 12345U);
    EXPECT_FALSE(read.run.maps);
    EXPECT_TRUE(read.run.report);
}

TEST(PartFile, AFolderWithoutAPartIsNamed) {
    const test::TemporaryFolder folder;
    EXPECT_THROW(read_part(folder.path()), InputError);
    test::spill(folder / kPartFile, "{\"version\": 1");
    EXPECT_THROW(read_part(folder.path()), InputError);
    test::spill(folder / kPartFile, "{\"version\": 2}");
    EXPECT_THROW(read_part(folder.path()), InputError);
}

}  // namespace part_file_test
}  // namespace dynamic_filter::app
