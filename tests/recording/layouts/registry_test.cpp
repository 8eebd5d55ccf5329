// SPDX-License-Identifier: MIT
#include "recording/layouts/registry.hpp"

#include <set>

#include "dynamic_filter/file.hpp"
#include "support/recording.hpp"

namespace dynamic_filter::io {
namespace layout_registry_test {

using LayoutRegistry = RecordingFiles;

OpenOptions named(const std::string& layout) {
    OpenOptions options;
    options.layout = layout;
    return options;
}

TEST_F(LayoutRegistry, EachNameIsThereOnceAndSaysWhatItIs) {
    std::set<std::string> names;
    for (const LayoutName& layout : layouts()) {
        EXPECT_TRUE(names.insert(layout.name).second) << layout.name;
        EXPECT_FALSE(layout.what.empty() || layout.files.empty()) << layout.name;
        EXPECT_EQ(layout_row(layout.name).name.name, layout.name);
        EXPECT_EQ(layout.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-"),
                  std::string::npos)
            << layout.name << " is a word on the command line";
    }
    EXPECT_TRUE(names.contains("kitti-360"));
}

TEST_F(LayoutRegistry, ThePageOfFormatsHasARowForEachName) {
    const std::string page = read_file(FORMATS_PAGE);
    for (const LayoutName& layout : layouts()) EXPECT_HAS(page, "| `" + layout.name + "` |");
}

TEST_F(LayoutRegistry, AnUnknownNameIsAnsweredWithAllNames) {
    const std::string error = error_of<ConfigError>([&] { (void)open(named("kity")); });
    EXPECT_HAS(error, "'kity'");
    for (const LayoutName& layout : layouts()) EXPECT_HAS(error, layout.name);
}

TEST_F(LayoutRegistry, AFolderOfAnotherLayoutIsRefusedWithWhatWasLookedFor) {
    put_bins("scans", 2);
    data.put("poses.txt", kitti_rows(2));
    EXPECT_EQ(open().info().layout, "folder");
    EXPECT_EQ(open(named("folder")).info().layout, "folder");
    for (const LayoutRow& row : layout_rows()) {
        if (row.name.name == "folder" || row.turn == Turn::bag) continue;
        const std::string error = open_error(named(row.name.name));
        EXPECT_HAS(error, data.path().string());
        if (row.turn == Turn::usual) continue;  // they name the folder in which scans should be
        EXPECT_HAS(error, "is not " + row.name.what + " (--format " + row.name.name + ")");
        EXPECT_HAS(error, "looked for " + row.name.files);
    }
    EXPECT_HAS(open_error(named("kitti")), "velodyne: no *.bin");
    EXPECT_HAS(open_error(named("benchmark")), "pcd: no *.pcd");
    EXPECT_HAS(open_error(named("bag")), data.path().string());
}

TEST_F(LayoutRegistry, ANameChoosesAmongLayoutsThatFit) {
    put_bins("velodyne", 2);
    put_bins("velodyne_points/data", 3);
    put_pcd("pcd/0.pcd", 1, 0);
    EXPECT_EQ(open().info().layout, "kitti-raw");
    EXPECT_EQ(open(named("kitti-raw")).size(), 3U);
    EXPECT_EQ(open(named("kitti")).size(), 2U);
    EXPECT_EQ(open(named("kitti")).info().layout, "kitti");
    EXPECT_EQ(open(named("benchmark")).size(), 1U);
    EXPECT_TRUE(open(named("benchmark")).info().points_in_world);
}

TEST_F(LayoutRegistry, ANamedLayoutGetsTheGivenPosesInPlaceOfItsOwn) {
    put_pcd("1500000000_900000000.pcd", 0, 0);
    put_pcd("1500000001_000000000.pcd", 0, 0);
    const std::string identity = "1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n";
    data.put("1500000000_900000000.odom", identity);
    data.put("1500000001_000000000.odom", identity);
    EXPECT_EQ(open().info().layout, "pairs");
    OpenOptions options;
    options.poses = data.put("p.txt", kitti_rows(2));
    EXPECT_EQ(open(options).info().layout, "folder");
    options.layout = "pairs";
    const Recording recording = open(options);
    EXPECT_EQ(recording.info().layout, "pairs");
    EXPECT_EQ(recording.info().T_world_sensor[1].translation().x(), 1.0);
    EXPECT_NEAR(recording.info().stamps[1] - recording.info().stamps[0], 0.1, 1e-6);
}

}  // namespace layout_registry_test
}  // namespace dynamic_filter::io
