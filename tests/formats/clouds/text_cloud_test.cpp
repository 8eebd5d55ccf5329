// SPDX-License-Identifier: MIT
#include "formats/clouds/text_cloud.hpp"

#include "dynamic_filter/cloud.hpp"
#include "dynamic_filter/writers.hpp"
#include "support/bytes.hpp"

namespace dynamic_filter::io {
namespace text_cloud_test {

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
    const Cloud veloview = read(
        "\"intensity\",\"laser id\",\"Points_m_XYZ:0\",\"Points_m_XYZ:1\",\"Points_m_XYZ:2\"\n"
        "9,7,1,2,3\n");
    EXPECT_EQ(positions(veloview), (Points{{1, 2, 3}}));
    EXPECT_EQ(column(veloview, "laser_id").at(0), 7);
}

TEST_F(TextCloud, TitlesOfPointsAreNoTitlesOfPoses) {
    EXPECT_TRUE(names_points("# scan\nX,Y,Z,I\n"));
    EXPECT_TRUE(names_points("Points:0,Points:1,Points:2\n"));
    EXPECT_FALSE(names_points("t,x,y,z,qx,qy,qz,qw\n"));
    EXPECT_FALSE(names_points("1,2,3\n"));
    EXPECT_FALSE(names_points(""));
}

TEST_F(TextCloud, WhatIsWrittenReadsBackAsItWas) {
    Cloud cloud;
    add_field(cloud, "x", FieldType::f32);
    add_field(cloud, "y", FieldType::f64);
    add_field(cloud, "z", FieldType::f32);
    add_field(cloud, "pair", FieldType::i8, 2);
    add_field(cloud, "dynamic", FieldType::u8);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const float x : {0.1F, -3.4e38F, 1e-42F, nan}) {
        const std::string record = bytes_of(x) + bytes_of(691234.5670000001) + bytes_of(0.3F) +
                                   bytes_of(std::int8_t{-1}) + bytes_of(std::int8_t{7}) +
                                   bytes_of(std::uint8_t{200});
        const auto raw = std::as_bytes(std::span(record));
        cloud.data.insert(cloud.data.end(), raw.begin(), raw.end());
    }
    for (const char* name : {"b.csv", "b.xyz", "b.txt"}) {
        EXPECT_EQ(write_text_cloud(folder_ / name, cloud), "");
        const Cloud back = read_cloud(folder_ / name);
        ASSERT_EQ(back.size(), 4U);
        for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(positions(back)[i], positions(cloud)[i]);
        EXPECT_TRUE(std::isnan(positions(back)[3].x()));
        EXPECT_EQ(column(back, "y"), column(cloud, "y"));
        EXPECT_EQ(column(back, "pair_0"), (std::vector<double>{-1, -1, -1, -1}));
        EXPECT_EQ(column(back, "pair_1"), (std::vector<double>{7, 7, 7, 7}));
        EXPECT_EQ(column(back, "dynamic"), column(cloud, "dynamic"));
    }
    EXPECT_TRUE(slurp(folder_ / "b.csv").starts_with("x,y,z,pair_0,pair_1,dynamic\n0.1,"));
}

TEST_F(TextCloud, DecimalCommasAreNoSeparators) {
    EXPECT_HAS(error("x;y;z\n1,5;2,5;3,5\n"), "line 2");
    EXPECT_HAS(error("x;y;z\n1,5;2,5;3,5\n"), "decimal");
}

TEST_F(TextCloud, FaultsAreNamed) {
    EXPECT_HAS(error(""), "no point");
    EXPECT_HAS(error("x y z\n"), "no point");
    EXPECT_HAS(error("1 2\n"), "2 columns");
    EXPECT_HAS(error("# a\n1 2 3\n4 5\n"), "line 3");
    EXPECT_HAS(error("1 2 3\n4 5 six\n"), "'six'");
    EXPECT_HAS(error(",,,\n;\n"), "no point");
}

}  // namespace text_cloud_test
}  // namespace dynamic_filter::io
