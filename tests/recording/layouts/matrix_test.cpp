// SPDX-License-Identifier: MIT
#include "recording/layouts/matrix.hpp"

#include "support/bytes.hpp"

namespace dynamic_filter::io {
namespace matrix_test {

TEST(Matrix, ReadsFourRowsAndLeavesTheRest) {
    const std::string text = "\n1 0 0 5\n0 0 -1 6\n\n0 1 0 7\n0 0 0 1\nnext\n";
    Lines lines(text, "m.txt");
    const Pose pose = read_matrix(lines);
    EXPECT_EQ(pose.translation(), Eigen::Vector3d(5, 6, 7));
    EXPECT_EQ(pose.linear() * Eigen::Vector3d::UnitY(), Eigen::Vector3d(0, 0, 1));
    ASSERT_TRUE(lines.next());
    EXPECT_EQ(lines.line(), "next");
}

TEST(Matrix, NumbersThatAreNotFiniteAreALostPose) {
    const std::string text = "1 0 0 nan\n0 1 0 0\n0 0 1 0\n0 0 0 1\n";
    Lines lines(text, "m.txt");
    EXPECT_FALSE(read_matrix(lines).matrix().allFinite());
}

TEST(Matrix, FaultsAreNamedWithFileAndLine) {
    const auto error = [](const std::string& text) {
        return error_of([&] {
            Lines lines(text, "m.txt");
            (void)read_matrix(lines);
        });
    };
    EXPECT_HAS(error("1 0 0 0\n0 1 0\n"), "m.txt (line 2)");
    EXPECT_HAS(error("1 0 0 0\n0 1 0\n"), "3 numbers; expected 4");
    EXPECT_HAS(error("1 0 0 a\n"), "'a' is no number");
    EXPECT_HAS(error("1 0 0 0\n"), "1 rows; expected a 4x4 matrix");
    EXPECT_HAS(error("1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 1 1\n"), "the last row is not 0 0 0 1");
}

}  // namespace matrix_test
}  // namespace dynamic_filter::io
