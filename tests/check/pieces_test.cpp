// SPDX-License-Identifier: MIT
#include "check/pieces.hpp"

#include <gtest/gtest.h>

#include "support/recording.hpp"

namespace dynamic_filter::io {
namespace pieces_test {

using Pieces = RecordingFiles;

TEST_F(Pieces, AreInARowAndCoverHalfAtMost) {
    put_bins("velodyne", 100);
    data.put("poses.txt", kitti_rows(100));
    const std::vector<Piece> pieces = read_pieces(open(), 5, 10);
    ASSERT_EQ(pieces.size(), 5U);
    for (const Piece& piece : pieces) {
        ASSERT_EQ(piece.size(), 10U);
        EXPECT_EQ(piece.back().index - piece.front().index, 9U);
    }
    EXPECT_EQ(read_pieces(open(), 5, 30).size(), 1U);
}

TEST_F(Pieces, LeaveOutScansThatCannotBeRead) {
    put_bins("velodyne", 10);
    data.put("poses.txt", kitti_rows(10));
    data.put("velodyne/" + number(4) + ".bin", "");
    const std::vector<Piece> pieces = read_pieces(open(), 1, 20);
    ASSERT_EQ(pieces.size(), 1U);
    EXPECT_EQ(pieces.front().size(), 9U);
}

}  // namespace pieces_test
}  // namespace dynamic_filter::io
