// SPDX-License-Identifier: MIT
#include "page/tile_picture.hpp"

#include <gtest/gtest.h>

namespace dynamic_filter::app {
namespace tile_picture_test {

TilePoints points_at(const std::vector<Eigen::Vector3d>& positions) {
    TilePoints points;
    points.positions = positions;
    return points;
}

TEST(TilePicture, NorthIsUpAndEastIsRight) {
    const TileSquare square{-25.6, 51.2, 25.6};
    const auto picture =
        picture_from_above(points_at({{-25.5, 51.3, 0.0}, {-0.1, 51.3, 5.0}, {-25.5, 76.7, 10.0}}),
                           square, 4, {0.0, 10.0});
    EXPECT_EQ(picture, (std::vector<std::uint8_t>{255, 0, 0, 0,  //
                                                  0, 0, 0, 0,    //
                                                  0, 0, 0, 0,    //
                                                  1, 0, 0, 128}));
}

TEST(TilePicture, TheHighestVoxelIsSeen) {
    const auto picture = picture_from_above(points_at({{1, 1, 2}, {1, 1, 8}, {1, 1, 4}}),
                                            TileSquare{0, 0, 25.6}, 1, {0.0, 8.0});
    EXPECT_EQ(picture, std::vector<std::uint8_t>{255});
    const auto beyond =
        picture_from_above(points_at({{1, 1, -99}}), TileSquare{0, 0, 25.6}, 1, {0.0, 8.0});
    EXPECT_EQ(beyond, std::vector<std::uint8_t>{1}) << "it is not taken for nothing";
}

TEST(TilePicture, PixelsAreNoFinerThanVoxels) {
    EXPECT_EQ(picture_edge(TileSquare{0, 0, 25.6}, 0.2, 256), 128);
    EXPECT_EQ(picture_edge(TileSquare{0, 0, 204.8}, 0.2, 256), 256);
    EXPECT_EQ(picture_edge(TileSquare{0, 0, 25.6}, 0.2, 34), 34);
}

}  // namespace tile_picture_test
}  // namespace dynamic_filter::app
