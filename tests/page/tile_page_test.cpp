// SPDX-License-Identifier: MIT
#include "page/tile_page.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "support/sample_map.hpp"
#include "support/temporary_folder.hpp"

namespace dynamic_filter::app {
namespace tile_page_test {

template <class T>
std::vector<T> values(const PageRun& run, const std::string& name) {
    for (const PageArray& array : run.arrays) {
        if (array.name != name) continue;
        EXPECT_EQ(array.type, page_type<T>());
        std::vector<T> result(array.bytes.size() / sizeof(T));
        std::memcpy(result.data(), array.bytes.data(), array.bytes.size());
        return result;
    }
    ADD_FAILURE() << name << " is missing";
    return {};
}

class TilePage : public testing::Test {
protected:
    void SetUp() override { index_ = write_sample_map(folder_.path()); }
    [[nodiscard]] const MapTile& tile(const std::string& name) const {
        return *std::find_if(index_.tiles.begin(), index_.tiles.end(),
                             [&](const MapTile& t) { return t.name == name; });
    }
    [[nodiscard]] TilePoints points(const std::string& name) const {
        return read_tile(folder_ / "map", index_, tile(name));
    }
    test::TemporaryFolder folder_;
    MapIndex index_;
};

TEST_F(TilePage, ShowsEveryVoxelWhereItIs) {
    const TilePoints all = points("1_-2_0");
    const PageRun run = view_of_tile(index_, tile("1_-2_0"), all, 1'000'000);
    const auto steps = values<std::uint16_t>(run, "map-position");
    ASSERT_EQ(steps.size(), 3 * all.size());
    const auto sorted = [](std::vector<std::array<long, 3>> cells) {
        std::sort(cells.begin(), cells.end());
        return cells;
    };
    std::vector<std::array<long, 3>> shown, expected;
    for (std::size_t i = 0; i < all.size(); ++i) {
        std::array<long, 3> at{}, is{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double place = run.info["origin"][axis].get<double>() +
                                 run.info["low"][axis].get<double>() +
                                 run.info["step"].get<double>() * steps[3 * i + axis];
            at[axis] = std::lround(1000.0 * place);
            is[axis] = std::lround(1000.0 * all.positions[i][static_cast<int>(axis)]);
        }
        shown.push_back(at);
        expected.push_back(is);
    }
    EXPECT_EQ(sorted(shown), sorted(expected));
    EXPECT_EQ(run.info["spacing"], 0.0);
    EXPECT_EQ(values<std::uint8_t>(run, "map-drives").size(), all.size());
    EXPECT_EQ(values<std::uint8_t>(run, "map-drives")[0], 170) << "two of three drives";
}

TEST_F(TilePage, TellsWhichDrivesSawEachVoxel) {
    const TilePoints all = points("1_-2_0");
    const PageRun run = view_of_tile(index_, tile("1_-2_0"), all, 1'000'000);
    const auto names = run.info["groups"]["names"].get<std::vector<std::string>>();
    EXPECT_EQ(run.info["groups"]["kind"], "drive");
    const std::vector<std::uint64_t> voxels = voxels_by_drive(all, index_.drives.size());
    std::vector<std::uint64_t> shown(names.size(), 0), expected;
    for (const std::uint32_t bits : values<std::uint32_t>(run, "map-groups")) {
        for (std::size_t k = 0; k < names.size(); ++k) shown[k] += bits >> k & 1U;
    }
    for (const std::uint64_t count : voxels) {
        if (count > 0) expected.push_back(count);
    }
    EXPECT_EQ(shown, expected);
}

TEST_F(TilePage, TheEarliestOfMoreThan32DrivesShareABit) {
    constexpr std::size_t kDrives = 40;
    MapIndex index = index_;
    index.drives.resize(kDrives);
    for (std::size_t d = 0; d < kDrives; ++d) index.drives[d].name = "day_" + std::to_string(d);
    TilePoints all;
    all.words = drive_words(kDrives);
    for (std::size_t d = 0; d < kDrives; ++d) {  // a voxel of each drive
        all.positions.emplace_back(static_cast<double>(d), 0.0, 0.0);
        all.probability.push_back(1.0F);
        all.scans.push_back(1);
        all.drives.resize(all.drives.size() + all.words);
        all.drives[d * all.words + d / 32] = std::uint32_t{1} << (d % 32);
    }
    const PageRun run = view_of_tile(index, index.tiles.front(), all, 1000);
    const auto names = run.info["groups"]["names"].get<std::vector<std::string>>();
    ASSERT_EQ(names.size(), 32U);
    EXPECT_EQ(names.front(), "day_8 and earlier");
    EXPECT_EQ(names.back(), "day_39");
    std::vector<std::uint32_t> groups = values<std::uint32_t>(run, "map-groups");
    EXPECT_EQ(std::count(groups.begin(), groups.end(), 1U), 9);
    for (std::size_t k = 1; k < 32; ++k) {
        EXPECT_EQ(std::count(groups.begin(), groups.end(), std::uint32_t{1} << k), 1) << k;
    }
}

TEST_F(TilePage, TooManyVoxelsAreThinned) {
    const TilePoints all = points("1_-2_0");
    const PageRun run = view_of_tile(index_, tile("1_-2_0"), all, 1000);
    EXPECT_EQ(run.info["points_total"], all.size());
    EXPECT_LE(run.info["points_shown"].get<std::size_t>(), 1000U);
    EXPECT_GT(run.info["points_shown"].get<std::size_t>(), 300U);
    EXPECT_GT(run.info["spacing"].get<double>(), kSampleVoxel);
    EXPECT_EQ(run.info["tile"]["voxels"], all.size());
}

TEST_F(TilePage, NamesTheTilesAroundItOfAllSizes) {
    const auto around = [&](const std::string& name) {
        std::map<std::string, std::string> found;
        const PageRun run = view_of_tile(index_, tile(name), points(name), 1000);
        for (const auto& other : run.info["tile"]["neighbours"])
            found[other["name"]] = other["where"];
        return found;
    };
    using Found = std::map<std::string, std::string>;
    EXPECT_EQ(around("1_-2_-2"), (Found{{"1_-1_-2", "east"}, {"1_-2_-1", "north"}}));
    EXPECT_EQ(
        around("0_2_2"),
        (Found{{"1_1_0", "south"}, {"1_0_1", "west"}, {"0_3_2", "east"}, {"0_2_3", "north"}}));
    EXPECT_EQ(
        around("1_0_1"),
        (Found{{"1_-1_1", "west"}, {"1_0_0", "south"}, {"0_2_2", "east"}, {"0_2_3", "east"}}));
}

TEST_F(TilePage, CountsTheVoxelsOfEachDrive) {
    const TilePoints all = points("1_0_0");
    const std::vector<std::uint64_t> voxels = voxels_by_drive(all, 3);
    EXPECT_EQ(voxels[0] + voxels[1] + voxels[2], 2 * all.size()) << "the sample has two at each";
    const PageRun run = view_of_tile(index_, tile("1_0_0"), all, 1000);
    EXPECT_EQ(run.info["tile"]["drives"][0]["voxels"], voxels[0]);
}

}  // namespace tile_page_test
}  // namespace dynamic_filter::app
