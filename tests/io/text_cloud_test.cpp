// SPDX-License-Identifier: MIT
#include "dynamic_filter/io/cloud.hpp"
#include "io/support.hpp"

namespace dynamic_filter::io {
namespace {

class TextCloud : public testing::Test {
protected:
    Cloud read(const std::string& text) { return read_cloud(folder_.put("a.xyz", text)); }
    std::string error(const std::string& text) {
        return error_of([&] { read(text); });
    }
    TemporaryFolder folder_;
};

TEST_F(TextCloud, ColumnsWithoutNames) {
    const Points points = {{1, 2, 3}, {4, 5, 6}};
    for (const char* text :
         {"1 2 3\n4 5 6", "# a\n\n//X,Y,Z\n1,2,3\n\n4,5,6\n", "1; 2; 3\r\n4;5;6"}) {
        EXPECT_EQ(positions(read(text)), points) << text;
    }
    const Cloud cloud = read("691234.567 2 3 0.5 7\n");
    EXPECT_EQ(column(cloud, "x").at(0), 691234.567);
    EXPECT_EQ(column(cloud, "intensity").at(0), 0.5);
    EXPECT_EQ(column(cloud, "c4").at(0), 7);
}

TEST_F(TextCloud, ColumnsWithNames) {
    const Cloud cloud = read("Time,X,Y,Z\n9,1,2,3\n");
    EXPECT_EQ(positions(cloud), (Points{{1, 2, 3}}));
    EXPECT_EQ(column(cloud, "time").at(0), 9);
    EXPECT_HAS(error("a,b,c\n1,2,3\n"), "'x'");
}

TEST_F(TextCloud, FaultsAreNamed) {
    EXPECT_HAS(error(""), "no point");
    EXPECT_HAS(error("x y z\n"), "no point");
    EXPECT_HAS(error("1 2\n"), "2 columns");
    EXPECT_HAS(error("# a\n1 2 3\n4 5\n"), "line 3");
    EXPECT_HAS(error("1 2 3\n4 5 six\n"), "'six'");
    EXPECT_HAS(error(",,,\n;\n"), "no point");
}

}  // namespace
}  // namespace dynamic_filter::io
