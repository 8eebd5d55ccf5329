// SPDX-License-Identifier: MIT
#include "base/output_folder.hpp"

#include <gtest/gtest.h>

#include "dynamic_filter/error.hpp"
#include "support/temporary_folder.hpp"

namespace fs = std::filesystem;

namespace dynamic_filter::app {
namespace output_folder_test {

using test::slurp;
using test::spill;
using test::TemporaryFolder;

const FolderFiles kResult{
    .files = {"static_map.pcd", "metrics.json", "run.log", kRunState},
    .folders = {{"labels", ".label"}, {"map", ".pcd"}, {"tiles", ".tile"}, {"report", ".html"}},
    .is_of_use_in_part = true,
    .is_result = true};
const FolderFiles kRecording{.files = {"poses.txt", "times.txt"},
                             .folders = {{"labels", ".label"}, {"velodyne", ".bin"}}};
const FolderFiles kTiles{.files = {"pointcloud_map_metadata.yaml"},
                         .folders = {{"pointcloud_map", ".pcd"}}};

TEST(OutputFolder, IsCreatedAndLeavesNoLockBehind) {
    const TemporaryFolder temporary;
    {
        const OutputFolder folder(temporary / "a/b", kResult, Existing::refuse);
        spill(temporary / "a/b/run.log", "half");
    }
    EXPECT_EQ(slurp(temporary / "a/b/run.log"), "half");
    EXPECT_FALSE(fs::exists(temporary / "a/b/.lock"));
}

TEST(OutputFolder, IsGoneIfNothingWasWritten) {
    const TemporaryFolder temporary;
    { const OutputFolder folder(temporary / "new", kResult, Existing::refuse); }
    EXPECT_FALSE(fs::exists(temporary / "new"));
    fs::create_directory(temporary / "mine");
    { const OutputFolder folder(temporary / "mine", kResult, Existing::refuse); }
    EXPECT_TRUE(fs::exists(temporary / "mine"));
}

TEST(OutputFolder, ASecondUserIsRefused) {
    const TemporaryFolder temporary;
    const OutputFolder first(temporary / "out", kResult, Existing::refuse);
    EXPECT_THROW(OutputFolder(temporary / "out", kResult, Existing::replace), ConfigError);
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
    EXPECT_THROW(OutputFolder(temporary.path(), kResult, Existing::refuse), ConfigError);
    EXPECT_THROW(OutputFolder(temporary.path(), kResult, Existing::refuse), ConfigError)
        << "the lock was not given back";
    EXPECT_TRUE(fs::exists(temporary / "static_map.pcd"));
    {
        const OutputFolder given_up(temporary.path(), kResult, Existing::replace);
        spill(given_up.path() / "static_map.pcd", "half of it");
    }
    EXPECT_EQ(slurp(temporary / "static_map.pcd"), "old");
    OutputFolder folder(temporary.path(), kResult, Existing::replace);
    EXPECT_EQ(folder.name(), temporary.path());
    spill(folder.path() / "run.log", "new");
    spill(folder.subfolder("labels") / "000001.label", "5678");
    EXPECT_TRUE(fs::exists(temporary / "labels/000000.label"));
    folder.commit();
    EXPECT_EQ(slurp(temporary / "run.log"), "new");
    EXPECT_EQ(slurp(temporary / "labels/000001.label"), "5678");
    EXPECT_EQ(folder.path(), temporary.path());
    EXPECT_FALSE(fs::exists(temporary / ".new"));
    EXPECT_FALSE(fs::exists(temporary / "static_map.pcd"));
    EXPECT_FALSE(fs::exists(temporary / "labels/000000.label"));
    EXPECT_TRUE(fs::exists(temporary / "labels/mine.txt"));
    EXPECT_TRUE(fs::exists(temporary / "thesis.tex"));
    EXPECT_TRUE(fs::exists(temporary / "poses.txt")) << "a run does not write poses";
    EXPECT_FALSE(fs::exists(temporary / ".run.log.tmp.1.0"));
}

TEST(OutputFolder, HalfARecordingIsNothing) {
    const TemporaryFolder temporary;
    {
        const OutputFolder given_up(temporary / "new", kRecording, Existing::refuse);
        spill(given_up.subfolder("velodyne") / "000000.bin", "half of it");
        EXPECT_FALSE(fs::exists(temporary / "new/velodyne"));
    }
    EXPECT_FALSE(fs::exists(temporary / "new"));
    fs::create_directory(temporary / "mine");
    { const OutputFolder given_up(temporary / "mine", kTiles, Existing::refuse); }
    EXPECT_TRUE(fs::is_empty(temporary / "mine"));
    OutputFolder folder(temporary / "new", kRecording, Existing::refuse);
    spill(folder.subfolder("velodyne") / "000000.bin", "all of it");
    folder.commit();
    EXPECT_EQ(slurp(temporary / "new/velodyne/000000.bin"), "all of it");
    EXPECT_FALSE(fs::exists(temporary / "new/.new"));
}

TEST(OutputFolder, OnlyARunOverwritesTheResultOfARun) {
    const TemporaryFolder temporary;
    spill(temporary / kRunState, "state");
    spill(temporary / "metrics.json", "{}");
    for (const FolderFiles* other : {&kRecording, &kTiles}) {
        EXPECT_THROW(OutputFolder(temporary.path(), *other, Existing::replace), ConfigError);
    }
    EXPECT_TRUE(fs::exists(temporary / "metrics.json"));
    EXPECT_NO_THROW(OutputFolder(temporary.path(), kResult, Existing::replace));
}

TEST(OutputFolder, GoesOnBesideWhatAKilledProcessWasReplacing) {
    const TemporaryFolder temporary;
    spill(temporary / "run.log", "old");
    fs::create_directory(temporary / ".new");
    spill(temporary / ".new/run.log", "new");
    spill(temporary / ".new/.run.log.tmp.1.0", "half");
    OutputFolder folder(temporary.path(), kResult, Existing::resume);
    EXPECT_EQ(slurp(folder.path() / "run.log"), "new");
    EXPECT_FALSE(fs::exists(folder.path() / ".run.log.tmp.1.0"));
    EXPECT_EQ(slurp(temporary / "run.log"), "old");
    folder.commit();
    EXPECT_EQ(slurp(temporary / "run.log"), "new");
}

TEST(OutputFolder, AFileInItsPlaceIsAClearError) {
    const TemporaryFolder temporary;
    spill(temporary / "out", "a file");
    EXPECT_THROW(OutputFolder(temporary / "out", kResult, Existing::replace), ConfigError);
    EXPECT_THROW(OutputFolder(temporary / "out/below", kResult, Existing::replace), OutputError);
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

}  // namespace output_folder_test
}  // namespace dynamic_filter::app
