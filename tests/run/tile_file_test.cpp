// SPDX-License-Identifier: MIT
#include "run/tile_file.hpp"

#include <gtest/gtest.h>

#include <array>

#include "dynamic_filter/error.hpp"
#include "support/random.hpp"
#include "support/temporary_folder.hpp"

namespace dynamic_filter::app {
namespace tile_file_test {

PointVerdicts some_verdicts(std::size_t count, std::uint64_t seed) {
    test::Random random(seed);
    const auto label = [&] {
        return std::array{Label::unknown, Label::static_, Label::dynamic}[random.below(3)];
    };
    PointVerdicts verdicts;
    for (std::size_t i = 0; i < count; ++i) {
        const Label final = label(), instant = label();
        verdicts.push_back({final, instant, random.below(2) == 1});
    }
    return verdicts;
}

bool same(const PointVerdicts& a, const PointVerdicts& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& p, const auto& q) {
        return p.final == q.final && p.instant == q.instant && p.stays == q.stays;
    });
}

TileSummary some_summary() {
    DriveCounts counts{.drive = 3, .final = {}, .instant = {}};
    counts.final.voxel["excluded"] = {
        .static_total = 9, .static_kept = 8, .dynamic_total = 4, .dynamic_kept = 1};
    counts.final.cover = {.still = 5, .dynamic = 6, .covered_still = 4, .covered_dynamic = 2};
    counts.final.confusion = {.true_positive = 1, .false_positive = 2, .false_negative = 3};
    counts.final.voxels = 13;
    counts.final.dynamic_voxels = 4;
    return {.tile = {.level = 2, .x = -1, .y = 5},
            .voxels = 100,
            .still = 90,
            .keyframes = 7,
            .low = {-0.1, 2.5, -3.0},
            .high = {1e6 + 0.1, 1.0 / 3.0, 0.0},
            .drives = {counts},
            .map_mark = {}};
}

TEST(TileFile, GivesBackWhatWasWritten) {
    const test::TemporaryFolder folder;
    TileWriter writer(folder / "a.tile", "run");
    writer.add({0, 4}, some_verdicts(1000, 1));
    writer.add({0, 5}, {});
    writer.add({2, 0}, some_verdicts(3, 2));
    writer.commit(some_summary());
    ASSERT_TRUE(is_done(folder / "a.tile", "run"));
    const TileReader reader(folder / "a.tile", "run");
    EXPECT_TRUE(same(reader.read({0, 4}), some_verdicts(1000, 1)));
    EXPECT_TRUE(reader.read({0, 5}).empty());
    EXPECT_TRUE(same(reader.read({2, 0}), some_verdicts(3, 2)));
    EXPECT_TRUE(reader.read({1, 0}).empty());
    const TileSummary &s = reader.summary(), expected = some_summary();
    EXPECT_EQ(s.tile, expected.tile);
    EXPECT_EQ(s.voxels, 100U);
    EXPECT_EQ(s.still, 90U);
    EXPECT_EQ(s.keyframes, 7U);
    EXPECT_EQ(s.low, expected.low);
    EXPECT_EQ(s.high, expected.high);
    ASSERT_EQ(s.drives.size(), 1U);
    EXPECT_EQ(s.drives[0].drive, 3U);
    const eval::Scores scores = s.drives[0].final.scores();
    EXPECT_DOUBLE_EQ(*scores.voxel.at("excluded").pr, 8.0 / 9.0);
    EXPECT_DOUBLE_EQ(*scores.voxel.at("excluded").rr, 0.75);
    EXPECT_DOUBLE_EQ(*scores.point.iou, 1.0 / 6.0);
    EXPECT_DOUBLE_EQ(scores.dynamic_share, 4.0 / 13.0);
}

TEST(TileFile, WithoutCommitThereIsNoFile) {
    const test::TemporaryFolder folder;
    {
        TileWriter writer(folder / "a.tile", "run");
        writer.add({0, 0}, some_verdicts(10, 1));
    }
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
    EXPECT_FALSE(is_done(folder / "a.tile", "run"));
}

/// True if a run would take the tile for its own.
bool is_taken(const std::filesystem::path& file) {
    try {
        return is_done(file, "run");
    } catch (const ConfigError&) {
        return false;
    }
}

TEST(TileFile, AnyByteThatDiffersIsNoticed) {
    const test::TemporaryFolder folder;
    const auto file = folder / "a.tile";
    {
        TileWriter writer(file, "run");
        writer.add({0, 0}, some_verdicts(40, 1));
        writer.commit(some_summary());
    }
    const std::string whole = test::slurp(file);
    for (std::size_t i = 0; i < whole.size(); ++i) {
        std::string spoilt = whole;
        spoilt[i] = static_cast<char>(spoilt[i] ^ 4);
        test::spill(file, spoilt);
        EXPECT_THROW((void)TileReader(file, "run").read({0, 0}), Error) << "byte " << i;
        EXPECT_FALSE(is_taken(file)) << "byte " << i;
    }
    for (const std::size_t length : {std::size_t{0}, std::size_t{10}, whole.size() - 1}) {
        test::spill(file, whole.substr(0, length));
        EXPECT_FALSE(is_done(file, "run")) << length;
        EXPECT_THROW(TileReader(file, "run"), InputError) << length;
    }
}

TEST(TileFile, IsNotDoneWithoutItsVoxels) {
    const test::TemporaryFolder folder;
    TileSummary summary = some_summary();
    const auto file = folder / tile_file(summary.tile), map = folder / tile_map_file(summary.tile);
    test::spill(map, "voxels");
    summary.map_mark = file_mark_of(map);
    TileWriter writer(file, "run");
    writer.commit(summary);
    EXPECT_TRUE(is_done(file, "run"));
    test::spill(map, "vOxels");
    EXPECT_FALSE(is_done(file, "run"));
    test::spill(map, "voxel");
    EXPECT_FALSE(is_done(file, "run"));
    std::filesystem::remove(map);
    EXPECT_FALSE(is_done(file, "run"));
}

TEST(TileFile, OfAnotherRunIsRefused) {
    const test::TemporaryFolder folder;
    TileWriter writer(folder / "a.tile", "run");
    writer.commit(some_summary());
    EXPECT_THROW(TileReader(folder / "a.tile", "another"), ConfigError);
}

}  // namespace tile_file_test
}  // namespace dynamic_filter::app
