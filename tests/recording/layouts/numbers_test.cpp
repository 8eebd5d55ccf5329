// SPDX-License-Identifier: MIT
#include "recording/layouts/numbers.hpp"

#include "support/bytes.hpp"

namespace dynamic_filter::io {
namespace numbers_test {

TEST(Numbers, IndicesMayHaveZerosBeforeThem) {
    EXPECT_EQ(index_of("a/0000000012.bin"), 12U);
    EXPECT_EQ(index_of("000.bin"), 0U);
    EXPECT_EQ(index_of("7"), 7U);
    EXPECT_FALSE(index_of("a7.bin"));
}

TEST(Numbers, APoseIsTwelveNumbersRowByRow) {
    const std::string text = "here";
    Lines where(text, "p.txt");
    where.next();
    EXPECT_EQ(read_numbers(" 1 -2.5  3e1 ", where), (std::vector<double>{1, -2.5, 30}));
    EXPECT_TRUE(read_numbers("", where).empty());
    const Pose pose = read_pose_row("0 -1 0 4 1 0 0 5 0 0 1 6", where);
    EXPECT_EQ(pose.translation(), Eigen::Vector3d(4, 5, 6));
    EXPECT_EQ(pose.linear() * Eigen::Vector3d::UnitX(), Eigen::Vector3d(0, 1, 0));
    EXPECT_FALSE(read_pose_row("0 -1 0 inf 1 0 0 5 0 0 1 6", where).matrix().allFinite());
    EXPECT_HAS(error_of([&] { (void)read_pose_row("1 2 3", where); }), "3 numbers; expected 12");
    EXPECT_HAS(error_of([&] { (void)read_numbers("1 two", where); }), "'two' is no number");
    EXPECT_HAS(error_of([&] { (void)read_numbers("1 two", where); }), "p.txt (line 1)");
}

}  // namespace numbers_test
}  // namespace dynamic_filter::io
