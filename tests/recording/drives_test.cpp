// SPDX-License-Identifier: MIT
#include "recording/drives.hpp"

#include <gtest/gtest.h>

#include "dynamic_filter/error.hpp"
#include "support/temporary_folder.hpp"

namespace dynamic_filter::app {
namespace drives_test {

namespace fs = std::filesystem;

TEST(Drives, AListStandsForItsRecordings) {
    const test::TemporaryFolder folder;
    fs::create_directories(folder / "day 1");
    fs::create_directories(folder / "day2");
    // The first bytes are a byte order mark, as some editors leave it.
    test::spill(folder / "drives.txt", "\xEF\xBB\xBF# the north\nday 1\tposes/1.tum\n\n day2 \r\n");
    const auto sources = expand({folder / "drives.txt", "other"});
    ASSERT_EQ(sources.size(), 3U);
    EXPECT_EQ(sources[0].recording, folder / "day 1");
    EXPECT_EQ(sources[0].poses, folder / "poses/1.tum");
    EXPECT_EQ(sources[1].recording, folder / "day2");
    EXPECT_FALSE(sources[1].poses);
    EXPECT_EQ(sources[2].recording, "other");
}

TEST(Drives, ASceneOfADataSetNeedNotBeAFolder) {
    const test::TemporaryFolder folder;
    fs::create_directories(folder / "v1.0-mini");
    test::spill(folder / "v1.0-mini/sample_data.json", "[]");
    test::spill(folder / "drives.txt", "scene-0001\n");
    const auto sources = expand({folder / "drives.txt"});
    ASSERT_EQ(sources.size(), 1U);
    EXPECT_EQ(sources[0].recording, folder / "scene-0001");
    EXPECT_THROW(open_drives(sources, {}), InputError);  // of the tables, which lack that scene
    fs::remove_all(folder / "v1.0-mini");
    EXPECT_THROW(open_drives(sources, {}), ConfigError);
}

TEST(Drives, AListNamesTheLineThatIsWrong) {
    const test::TemporaryFolder folder;
    test::spill(folder / "drives.txt", "\nmissing\n");
    try {
        expand({folder / "drives.txt"});
        FAIL() << "expected an InputError";
    } catch (const InputError& error) {
        const std::string text = error.what();
        EXPECT_NE(text.find("line 2"), std::string::npos) << text;
        EXPECT_NE(text.find("missing does not exist"), std::string::npos) << text;
    }
    test::spill(folder / "empty.txt", "# nothing\n");
    EXPECT_THROW(expand({folder / "empty.txt"}), InputError);
}

TEST(Drives, NamesAreTheEndsOfThePathsAndNeverTheSame) {
    using Names = std::vector<std::string>;
    EXPECT_EQ(names_of({{.recording = "/a/x"}, {.recording = "/a/y.mcap"}}), (Names{"x", "y"}));
    EXPECT_EQ(names_of({{.recording = "/a/x"}, {.recording = "/b/x/"}}), (Names{"a_x", "b_x"}));
    EXPECT_EQ(names_of({{.recording = "/1/a/x"}, {.recording = "/2/a/x"}}),
              (Names{"a_x", "a_x_2"}));
}

TEST(Drives, OnePoseFileIsNotForSeveralRecordings) {
    const test::TemporaryFolder folder;
    const auto a = folder / "a", b = folder / "b";
    fs::create_directories(a);
    const auto said = [](const std::vector<DriveSource>& sources, const DataOptions& how) {
        try {
            open_drives(sources, how);
        } catch (const ConfigError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    DataOptions how;
    how.poses = "poses.txt";
    EXPECT_NE(said({{.recording = a}, {.recording = b}}, {}).find("-o names"), std::string::npos);
    fs::create_directories(b);
    EXPECT_NE(said({{.recording = a}, {.recording = b}}, how).find("--poses"), std::string::npos);
    fs::create_symlink(a, folder / "c");
    for (const char* again : {"./a", "c"}) {
        const auto said_twice = said({{.recording = a}, {.recording = folder / again}}, {});
        EXPECT_NE(said_twice.find("given twice"), std::string::npos) << again;
    }
}

TEST(Drives, AGivenPoseFileGoesBeforeThatOfAList) {
    DataOptions how;
    const std::vector<DriveSource> listed{{.recording = "a", .poses = "listed.txt"}};
    EXPECT_EQ(options_of(listed, how)[0].data, "a");
    EXPECT_EQ(options_of(listed, how)[0].poses, "listed.txt");
    how.poses = "given.txt";
    EXPECT_EQ(options_of(listed, how)[0].poses, "given.txt");
    how.poses = "none";
    const auto each = options_of({listed[0], {.recording = "b"}}, how);
    ASSERT_EQ(each.size(), 2U);
    for (const DataOptions& one : each) EXPECT_EQ(one.poses, "none");
}

}  // namespace drives_test
}  // namespace dynamic_filter::app
