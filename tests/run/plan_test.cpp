// SPDX-License-Identifier: MIT
#include "run/plan.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "dynamic_filter/error.hpp"
#include "dynamic_filter/writers.hpp"
#include "support/temporary_folder.hpp"

namespace dynamic_filter::app {
namespace plan_test {

namespace fs = std::filesystem;

/// A drive along x whose scans show walls on both sides, as KITTI's layout has it.
void write_drive(const fs::path& folder, std::size_t scans, double step, std::size_t jump) {
    fs::create_directories(folder / "velodyne");
    std::vector<Pose> poses;
    std::vector<double> stamps;
    for (std::size_t i = 0; i < scans; ++i) {
        Points points;
        for (float x = -30.0F; x < 30.0F; x += 0.1F) {
            for (const float y : {-6.0F, 6.0F}) points.emplace_back(x, y, 1.0F);
        }
        const std::vector<float> intensity(points.size());
        const std::string name = "00000" + std::to_string(i);
        io::write_bin(folder / "velodyne" / (name.substr(name.size() - 6) + ".bin"), points,
                      intensity);
        Pose pose = Pose::Identity();
        pose.translation().x() = step * static_cast<double>(i) + (i >= jump ? 500.0 : 0.0);
        poses.push_back(pose);
        stamps.push_back(0.1 * static_cast<double>(i));
    }
    io::write_poses_kitti(folder / "poses.txt", poses);
    io::write_times(folder / "times.txt", stamps);
}

struct Planned {
    test::TemporaryFolder folder;
    Config config = preset("default");
    std::vector<Drive> drives;
    Plan plan;

    Planned(std::size_t scans, double step, std::size_t most_voxels, std::size_t jump = 1000) {
        write_drive(folder / "drive", scans, step, jump);
        DataOptions how;
        how.deskew = "off";
        drives = open_drives({{.recording = folder / "drive"}}, how);
        plan = make_plan(drives, config, how, most_voxels, true);
    }
};

TEST(Plan, ATileHasAllScansThatShowOrSeeIt) {
    const Planned p(40, 10.0, 1000);
    ASSERT_GT(p.plan.tiles.size(), 2U);
    for (const TileWork& work : p.plan.tiles) {
        const double side = cells_of(work.tile.level) * p.plan.cell;
        for (std::uint32_t i = 0; i < 40; ++i) {
            const double x = 10.0 * i;
            // The walls reach 30 m from the sensor, on both sides of y = 0.
            const auto reaches = [&](double length) {
                return x + length > work.tile.x * side && x - length < (work.tile.x + 1) * side;
            };
            const bool inside = reaches(30.0), near = reaches(33.0);
            const auto has = [&](const std::vector<ScanOfDrive>& scans) {
                return std::find(scans.begin(), scans.end(), ScanOfDrive{0, i}) != scans.end();
            };
            EXPECT_EQ(has(work.inside), inside) << name_of(work.tile) << " scan " << i;
            EXPECT_EQ(has(work.scans), near) << name_of(work.tile) << " scan " << i;
        }
        EXPECT_TRUE(std::is_sorted(work.scans.begin(), work.scans.end()));
    }
}

TEST(Plan, TheVoxelsAreEstimatedWell) {
    const Planned p(200, 2.0, 1'000'000);
    ASSERT_EQ(p.plan.tiles.size(), 1U);
    // Two walls of (398 + 60) / 0.2 voxels. One in 1024 is counted, so it is a rough estimate.
    const double expected = 2.0 * 458.0 / 0.2;
    EXPECT_NEAR(static_cast<double>(p.plan.tiles[0].voxels), expected, 0.8 * expected);
}

TEST(Plan, AJumpOfThePosesBeginsAnotherPart) {
    const Planned p(20, 1.0, 1'000'000, 10);
    const auto& scans = p.plan.drives[0].scans;
    EXPECT_EQ(scans[9].stretch, 0U);
    EXPECT_EQ(scans[10].stretch, 1U);
    EXPECT_EQ(scans[19].stretch, 1U);
    const auto notes = texts_of(p.plan.drives[0].remarks, RemarkKind::note);
    EXPECT_TRUE(std::any_of(notes.begin(), notes.end(), [](const std::string& note) {
        return note.find("500 m from where the previous poses lead") != std::string::npos;
    }));
}

TEST(Plan, PartsHaveEveryTileOnceAndSimilarWork) {
    Plan plan;
    for (std::size_t i = 1; i <= 50; ++i) {
        TileWork work{.tile = {.level = 0, .x = static_cast<int>(i)}, .scans = {}, .inside = {}};
        work.voxels = 10000 * i;
        work.points = 1000 * (10 + i % 7);
        plan.tiles.push_back(work);
    }
    for (const std::size_t parts : {1U, 2U, 7U, 60U}) {
        std::vector<std::size_t> all;
        std::vector<double> loads;
        for (std::size_t part = 1; part <= parts; ++part) {
            double load = 0.0;
            for (const std::size_t tile : tiles_of_part(plan.tiles, part, parts)) {
                all.push_back(tile);
                load += plan.tiles[tile].cost();
            }
            loads.push_back(load);
        }
        std::sort(all.begin(), all.end());
        std::vector<std::size_t> expected(50);
        std::iota(expected.begin(), expected.end(), std::size_t{0});
        EXPECT_EQ(all, expected) << parts;
        if (parts == 60) continue;
        const auto [least, most] = std::minmax_element(loads.begin(), loads.end());
        EXPECT_LT(*most, 1.3 * *least) << parts;
    }
}

TEST(Plan, IsTheSameWhenReadBack) {
    Planned p(40, 10.0, 4000, 30);
    p.plan.drives[0].remarks.push_back({RemarkKind::warning, "the poses jitter"});
    p.plan.remarks = {{RemarkKind::warning, "the frames differ"}};
    p.plan.drives[0].scans[7].is_used = false;
    cut_into_tiles(p.plan, p.config);
    write_plan(p.folder / "plan", p.plan, "run");
    const Plan read = read_plan(p.folder / "plan", "run", p.config);
    ASSERT_EQ(read.tiles.size(), p.plan.tiles.size());
    for (std::size_t t = 0; t < read.tiles.size(); ++t) {
        EXPECT_EQ(read.tiles[t].tile, p.plan.tiles[t].tile);
        EXPECT_EQ(read.tiles[t].scans, p.plan.tiles[t].scans);
        EXPECT_EQ(read.tiles[t].inside, p.plan.tiles[t].inside);
        EXPECT_EQ(read.tiles[t].voxels, p.plan.tiles[t].voxels);
    }
    EXPECT_EQ(read.drives[0].remarks, p.plan.drives[0].remarks);
    EXPECT_EQ(read.remarks, p.plan.remarks);
    EXPECT_EQ(used_scans(read.drives[0]).size(), 39U);
    EXPECT_EQ(read.drives[0].most_points, p.plan.drives[0].most_points);
    EXPECT_EQ(read.drives[0].scans[31].stretch, 1U);
    EXPECT_EQ(read.drives[0].scans[31].position, p.plan.drives[0].scans[31].position);
    EXPECT_THROW(read_plan(p.folder / "plan", "another run", p.config), ConfigError);
}

TEST(Plan, GoesOnFromThePlanOfTheFirstDrives) {
    const test::TemporaryFolder folder;
    write_drive(folder / "a", 20, 10.0, 1000);
    write_drive(folder / "b", 9, 7.0, 5);
    DataOptions how;
    how.deskew = "off";
    const Config config = preset("default");
    const std::vector<DriveSource> sources{{.recording = folder / "a"},
                                           {.recording = folder / "b"}};
    auto both = open_drives(sources, how), first = open_drives({sources.front()}, how);
    const Plan whole = make_plan(both, config, how, 1000, true);
    write_plan(folder / "plan", make_plan(first, config, how, 1000, true), "run");
    both = open_drives(sources, how);
    fs::remove_all(folder / "a" / "velodyne");  // is not read again
    const Plan found =
        make_plan(both, config, how, 1000, true, read_plan(folder / "plan", "run", config));
    EXPECT_EQ(found.voxels, whole.voxels);
    EXPECT_EQ(found.sampled, whole.sampled);
    ASSERT_EQ(found.tiles.size(), whole.tiles.size());
    for (std::size_t t = 0; t < whole.tiles.size(); ++t) {
        EXPECT_EQ(found.tiles[t].tile, whole.tiles[t].tile);
        EXPECT_EQ(found.tiles[t].scans, whole.tiles[t].scans);
        EXPECT_EQ(found.tiles[t].inside, whole.tiles[t].inside);
    }
}

}  // namespace plan_test
}  // namespace dynamic_filter::app
