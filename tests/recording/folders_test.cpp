// SPDX-License-Identifier: MIT
#include "recording/folders.hpp"

#include "support/bytes.hpp"

namespace dynamic_filter::io {
namespace folders_test {

std::vector<std::string> names(const Paths& paths) {
    std::vector<std::string> names;
    for (const auto& path : paths) names.push_back(path.filename().string());
    return names;
}

TEST(Folders, FilesAreInNaturalOrderWithoutHiddenOnesAndFolders) {
    const TemporaryFolder folder;
    for (const char* name : {"10.pcd", "9.PCD", "1.bin", ".3.pcd", "notes.txt", "8.pcd/1.pcd"}) {
        folder.put(name, "");
    }
    EXPECT_EQ(names(list_files(folder.path(), {".pcd"})),
              (std::vector<std::string>{"9.PCD", "10.pcd"}));
    EXPECT_EQ(names(list_files(folder.path(), {".pcd", ".bin"})),
              (std::vector<std::string>{"1.bin", "9.PCD", "10.pcd"}));
    EXPECT_EQ(names(list_folders(folder.path())), std::vector<std::string>{"8.pcd"});
}

TEST(Folders, AFolderThatIsMissingIsAnErrorOrEmpty) {
    const TemporaryFolder folder;
    EXPECT_HAS(error_of([&] { (void)list_files(folder / "none", {".pcd"}); }), "cannot be listed");
    std::error_code error;
    EXPECT_TRUE(list_files(folder / "none", {".pcd"}, error).empty());
    EXPECT_TRUE(error);
    EXPECT_TRUE(list_folders(folder / "none").empty());
    EXPECT_FALSE(is_folder(folder / "none"));
    EXPECT_FALSE(present(folder / "none"));
    const auto file = folder.put("a", "");
    EXPECT_TRUE(present(file));
    EXPECT_FALSE(is_folder(file));
}

TEST(Folders, WholePathsHaveANameAndAParent) {
    EXPECT_EQ(whole_path("/a/b/"), "/a/b");
    EXPECT_EQ(whole_path("/a/./c/../b"), "/a/b");
    EXPECT_EQ(whole_path("."), std::filesystem::current_path());
    EXPECT_EQ(extension_of("a/B.TxT"), ".txt");
    EXPECT_EQ(extension_of("a.d/b"), "");
}

}  // namespace folders_test
}  // namespace dynamic_filter::io
