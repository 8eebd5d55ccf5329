// SPDX-License-Identifier: MIT
#include "upkeep/unseen.hpp"

#include <gtest/gtest.h>

#include "formats/voxel_map/tile_points.hpp"
#include "support/sample_map.hpp"
#include "support/temporary_folder.hpp"

namespace dynamic_filter::app {
namespace unseen_test {

TEST(SeenVoxels, AreThoseOfEachDateAndTheirNeighbours) {
    const test::TemporaryFolder folder;
    const MapIndex index = write_sample_map(folder / "out", 3, 1, 4.0);
    std::vector<Eigen::Vector3d> places;
    std::vector<int> dates;  // 1: the first drive saw it, 2: a later one
    for (const MapTile& tile : index.tiles) {
        const TilePoints points = read_tile(folder / "out/map", index, tile);
        for (std::size_t i = 0; i < points.size(); ++i) {
            places.push_back(points.positions[i]);
            dates.push_back((points.saw(0, i) ? 1 : 0) |
                            (points.saw(1, i) || points.saw(2, i) ? 2 : 0));
        }
    }
    std::array<std::size_t, 4> expected{};
    for (std::size_t i = 0; i < places.size(); ++i) {
        int date = 0;
        for (std::size_t k = 0; k < places.size(); ++k) {
            const double apart = (places[k] - places[i]).cwiseAbs().maxCoeff();
            if (apart < 1.5 * index.voxel_size) date |= dates[k];
        }
        ++expected[static_cast<std::size_t>(date)];
    }
    const SeenVoxels seen = seen_voxels(folder / "out/map", 1);
    EXPECT_EQ(seen.old_only, expected[1]);
    EXPECT_EQ(seen.new_only, expected[2]);
    EXPECT_EQ(seen.at_both, expected[3]);
    EXPECT_GT(expected[1] + expected[2], 0U) << "else the sample tells nothing";
    ASSERT_EQ(seen.unseen.size(), expected[1] + expected[2]);
    std::size_t old_only = 0;
    for (const double date : io::values(seen.unseen, *seen.unseen.find("seen"))) {
        old_only += date == 1.0 ? 1 : 0;
    }
    EXPECT_EQ(old_only, expected[1]);
}

}  // namespace unseen_test
}  // namespace dynamic_filter::app
