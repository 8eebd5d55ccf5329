// SPDX-License-Identifier: MIT
#include "objects/pieces.hpp"

#include <gtest/gtest.h>

#include "support/random.hpp"

namespace dynamic_filter::app {
namespace pieces_test {

TEST(Pieces, PointsThatTouchAsSeenFromAbove) {
    const std::vector<Eigen::Vector3d> places = {{0.1, 0.1, 0}, {5.0, 5.0, 0}, {0.4, 0.4, 2},
                                                 {0.7, 0.4, 0}, {5.1, 4.6, 9}, {1.4, 0.4, 0}};
    const std::vector<Piece> pieces = pieces_of(places, 0.3);
    ASSERT_EQ(pieces.size(), 3U);
    EXPECT_EQ(pieces[0].points, (std::vector<std::uint32_t>{0, 2, 3}));
    EXPECT_EQ(pieces[1].points, (std::vector<std::uint32_t>{1, 4}));
    EXPECT_EQ(pieces[2].points, (std::vector<std::uint32_t>{5}));
    EXPECT_EQ(pieces[0].box.max(), Eigen::Vector3d(0.7, 0.4, 2.0));
    EXPECT_TRUE(pieces_of({}, 0.3).empty());
}

/// Against the definition: places are of one piece if a chain of cells that touch leads from one to
/// the other.
TEST(Pieces, AgreeWithBruteForce) {
    test::Random random(4);
    std::vector<Eigen::Vector3d> places;
    for (const Point& p : random.points(250, 8.0)) places.push_back(p.cast<double>());
    std::vector<std::size_t> group(places.size());
    for (std::size_t i = 0; i < group.size(); ++i) group[i] = i;
    const auto cell = [&](std::size_t i) { return (places[i] / 0.5).array().floor().eval(); };
    for (bool changed = true; changed;) {
        changed = false;
        for (std::size_t i = 0; i < places.size(); ++i) {
            for (std::size_t k = 0; k < places.size(); ++k) {
                if ((cell(i) - cell(k)).head<2>().abs().maxCoeff() > 1.0 || group[k] >= group[i]) {
                    continue;
                }
                group[i] = group[k];
                changed = true;
            }
        }
    }
    std::size_t points = 0;
    for (const Piece& piece : pieces_of(places, 0.5)) {
        points += piece.points.size();
        for (const std::uint32_t i : piece.points) EXPECT_EQ(group[i], piece.points.front());
        EXPECT_EQ(
            static_cast<std::size_t>(std::count(group.begin(), group.end(), piece.points.front())),
            piece.points.size());
    }
    EXPECT_EQ(points, places.size());
}

}  // namespace pieces_test
}  // namespace dynamic_filter::app
