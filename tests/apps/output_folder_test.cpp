// SPDX-License-Identifier: MIT
#include "output_folder.hpp"

#include <gtest/gtest.h>

#include "dynamic_filter/error.hpp"
#include "support/temporary_folder.hpp"

namespace fs = std::filesystem;

namespace dynamic_filter::app {
namespace {

using test::spill;
using test::TemporaryFolder;

TEST(OutputFolder, IsCreatedAndLeavesNoLockBehind) {
    const TemporaryFolder temporary;
    { const OutputFolder folder(temporary / "a/b", Contents::result, false); }
    EXPECT_TRUE(fs::is_empty(temporary / "a/b"));
}

TEST(OutputFolder, ASecondUserIsRefused) {
    const TemporaryFolder temporary;
    const OutputFolder first(temporary / "out", Contents::result, false);
    EXPECT_THROW(OutputFolder(temporary / "out", Contents::result, true), ConfigError);
}

TEST(OutputFolder, WhatIsThereIsKeptUnlessOverwritten) {
    const TemporaryFolder temporary;
    fs::create_directories(temporary / "labels");
    spill(temporary / "labels/000000.label", "1234");
    spill(temporary / "labels/mine.txt", "keep");
    spill(temporary / "static_map.pcd", "old");
    spill(temporary / "thesis.tex", "keep");
    spill(temporary / "poses.txt", "a recording's");
    spill(temporary / ".run.log.tmp.1.0", "left by a process that was killed");
    EXPECT_THROW(OutputFolder(temporary.path(), Contents::result, false), ConfigError);
    EXPECT_THROW(OutputFolder(temporary.path(), Contents::result, false), ConfigError)
        << "the lock was not given back";
    EXPECT_TRUE(fs::exists(temporary / "static_map.pcd"));
    const OutputFolder folder(temporary.path(), Contents::result, true);
    EXPECT_FALSE(fs::exists(temporary / "static_map.pcd"));
    EXPECT_FALSE(fs::exists(temporary / "labels/000000.label"));
    EXPECT_TRUE(fs::exists(temporary / "labels/mine.txt"));
    EXPECT_TRUE(fs::exists(temporary / "thesis.tex"));
    EXPECT_TRUE(fs::exists(temporary / "poses.txt")) << "a run does not write poses";
    EXPECT_FALSE(fs::exists(temporary / ".run.log.tmp.1.0"));
}

TEST(OutputFolder, AFileInItsPlaceIsAClearError) {
    const TemporaryFolder temporary;
    spill(temporary / "out", "a file");
    EXPECT_THROW(OutputFolder(temporary / "out", Contents::result, true), ConfigError);
    EXPECT_THROW(OutputFolder(temporary / "out/below", Contents::result, true), OutputError);
}

TEST(RefuseSameFolder, SeesThroughNames) {
    const TemporaryFolder temporary;
    fs::create_directories(temporary / "data");
    fs::create_symlink("data", temporary / "link");
    EXPECT_THROW(refuse_same_folder(temporary / "data", temporary / "link"), ConfigError);
    EXPECT_NO_THROW(refuse_same_folder(temporary / "data", temporary / "out"));
}

TEST(LinkLatest, PointsToTheNewest) {
    const TemporaryFolder temporary;
    for (const char* name : {"one", "two"}) {
        fs::create_directories(temporary / name);
        EXPECT_TRUE(link_latest(temporary / name));
        EXPECT_EQ(fs::read_symlink(temporary / "latest"), name);
    }
}

}  // namespace
}  // namespace dynamic_filter::app
