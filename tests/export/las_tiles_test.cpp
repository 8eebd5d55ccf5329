// SPDX-License-Identifier: MIT
#include "export/las_tiles.hpp"

#include <gtest/gtest.h>

#include "dynamic_filter/cloud.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/file.hpp"
#include "support/sample_map.hpp"
#include "support/temporary_folder.hpp"

namespace dynamic_filter::app {
namespace las_tiles_test {

TEST(LasTiles, HoldAllFieldsOfEachTile) {
    const test::TemporaryFolder folder;
    const MapIndex index = write_sample_map(folder.path(), 40);
    EXPECT_EQ(write_las_tiles(index, folder / "map", folder / "out"),
              "coordinates are rounded to 1 mm");
    for (const MapTile& tile : index.tiles) {
        const io::Cloud from = io::read_cloud(folder / "map" / tile.file);
        const io::Cloud las = io::read_cloud(folder / ("out/las/" + tile.name + ".las"));
        ASSERT_EQ(las.size(), from.size());
        for (const char* name : {"probability", "scans"})
            EXPECT_EQ(io::values(las, *las.find(name)), io::values(from, *from.find(name)));
        EXPECT_EQ(io::values(las, *las.find("sessions_0")),
                  io::values(from, *from.find("sessions")));
        ASSERT_NE(las.find("sessions_1"), nullptr);
        const auto at = io::values(las, *las.find("x")), is = io::values(from, *from.find("x"));
        for (std::size_t i = 0; i < at.size(); ++i) EXPECT_NEAR(at[i], is[i], 0.0005 + 1e-9);
    }
}

TEST(LasTiles, TheIndexNamesTheFiles) {
    const test::TemporaryFolder folder;
    const MapIndex index = write_sample_map(folder.path());
    write_las_tiles(index, folder / "map", folder / "out");
    const std::string text = io::read_file(folder / "out/index.json");
    for (const MapTile& tile : index.tiles)
        EXPECT_NE(text.find("\"file\":\"las/" + tile.name + ".las\""), std::string::npos);
    EXPECT_THROW(write_las_tiles({}, folder / "map", folder / "none"), InputError);
}

}  // namespace las_tiles_test
}  // namespace dynamic_filter::app
