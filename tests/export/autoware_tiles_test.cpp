// SPDX-License-Identifier: MIT
#include "export/autoware_tiles.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "dynamic_filter/cloud.hpp"
#include "support/sample_map.hpp"
#include "support/temporary_folder.hpp"

namespace dynamic_filter::app {
namespace autoware_tiles_test {

using Row = std::array<double, 6>;

std::vector<Row> rows_of(const io::Cloud& cloud) {
    std::vector<Row> rows(cloud.size());
    const char* const names[] = {"x", "y", "z", "probability", "scans", "sessions"};
    for (std::size_t column = 0; column < 6; ++column) {
        const auto values = io::values(cloud, *cloud.find(names[column]));
        for (std::size_t i = 0; i < rows.size(); ++i) rows[i][column] = values[i];
    }
    return rows;
}

TEST(AutowareTiles, HoldEveryVoxelOnceInItsSquare) {
    const test::TemporaryFolder folder;
    const MapIndex index = write_sample_map(folder.path());
    const std::size_t squares = write_autoware_tiles(index, folder / "map", folder / "out");
    const std::string metadata = test::slurp(folder / "out/pointcloud_map_metadata.yaml");
    EXPECT_EQ(metadata.find("x_resolution: 20.0\ny_resolution: 20.0\n"), 0U);
    std::vector<Row> found, expected;
    std::size_t files = 0;
    for (const auto& entry :
         std::filesystem::directory_iterator(folder / "out/pointcloud_map.pcd")) {
        ++files;
        const std::string name = entry.path().filename();
        double x = 0.0, y = 0.0;
        ASSERT_EQ(std::sscanf(name.c_str(), "%lf_%lf.pcd", &x, &y), 2);
        EXPECT_NE(metadata.find("\n" + name + ": ["), std::string::npos) << name;
        for (const Row& row : rows_of(io::read_cloud(entry.path()))) {
            EXPECT_TRUE(row[0] >= x && row[0] < x + 20 && row[1] >= y && row[1] < y + 20) << name;
            found.push_back(row);
        }
    }
    for (const MapTile& tile : index.tiles) {
        for (Row row : rows_of(io::read_cloud(folder / "map" / tile.file))) {
            for (std::size_t axis = 0; axis < 3; ++axis) row[axis] = static_cast<float>(row[axis]);
            expected.push_back(row);
        }
    }
    std::sort(found.begin(), found.end());
    std::sort(expected.begin(), expected.end());
    EXPECT_EQ(files, squares);
    EXPECT_EQ(found, expected);
}

TEST(AutowareTiles, CornersAreRoundedDown) {
    EXPECT_EQ(autoware_corner(0.0), 0);
    EXPECT_EQ(autoware_corner(-0.1), -20);
    EXPECT_EQ(autoware_corner(39.9), 20);
    EXPECT_EQ(autoware_name({-20, 40}), "-20_40.pcd");
}

}  // namespace autoware_tiles_test
}  // namespace dynamic_filter::app
