// SPDX-License-Identifier: MIT
#include "formats/clouds/records.hpp"

#include "support/bytes.hpp"

namespace dynamic_filter::io {
namespace records_test {

const std::vector<Column> padded = {
    {"_", FieldType::u8, 2, true},   {"x", FieldType::f32, 1, false},
    {"_", FieldType::u8, 1, true},   {"y", FieldType::f64, 1, false},
    {"z", FieldType::f32, 1, false}, {"_", FieldType::u16, 1, true}};

std::vector<std::byte> to_bytes(const std::string& text) {
    const auto bytes = std::as_bytes(std::span(text));
    return {bytes.begin(), bytes.end()};
}

TEST(Records, RowsLoseTheirPadding) {
    const std::string row = "pp" + floats({1.0F}) + "p" + bytes_of(2.0) + floats({3.0F}) + "pp";
    Cloud cloud = empty_cloud(padded, "f");
    read_rows(cloud, padded, 2, to_bytes("head" + row + row + "tail"), 4);
    EXPECT_EQ(cloud.size(), 2U);
    EXPECT_EQ(column(cloud, "x"), std::vector<double>(2, 1.0));
    EXPECT_EQ(column(cloud, "y"), std::vector<double>(2, 2.0));
    EXPECT_EQ(column(cloud, "z"), std::vector<double>(2, 3.0));
}

TEST(Records, ColumnsBecomeRows) {
    const std::string block =
        "pppp" + floats({1, 10}) + "pp" + bytes_of(2.0) + bytes_of(20.0) + floats({3, 30}) + "pppp";
    Cloud cloud = empty_cloud(padded, "f");
    read_columns(cloud, padded, 2, to_bytes(block));
    EXPECT_EQ(column(cloud, "x"), (std::vector<double>{1, 10}));
    EXPECT_EQ(column(cloud, "y"), (std::vector<double>{2, 20}));
    EXPECT_EQ(column(cloud, "z"), (std::vector<double>{3, 30}));
}

TEST(Records, AsciiChecksEveryValue) {
    const std::vector<Column> columns = {{"x", FieldType::f32, 1, false},
                                         {"y", FieldType::f32, 1, false},
                                         {"z", FieldType::f32, 1, false},
                                         {"i", FieldType::u8, 1, false}};
    const auto read = [&](const std::string& text) {
        Cloud cloud = empty_cloud(columns, "f");
        Lines lines(text, "f");
        read_ascii(cloud, columns, 1, lines);
        return column(cloud, "i").at(0);
    };
    EXPECT_EQ(read("1 nan inf 7"), 7.0);
    EXPECT_EQ(read("\n1 2 3 7.0\r\n"), 7.0);
    EXPECT_HAS(error_of([&] { read("1 2 3 256"); }), "'256'");
    EXPECT_HAS(error_of([&] { read("1 2 3 -1"); }), "line 1");
    EXPECT_HAS(error_of([&] { read("1 2 3 1.5"); }), "'i'");
    EXPECT_HAS(error_of([&] { read("1 abc 3 1"); }), "'abc'");
    EXPECT_HAS(error_of([&] { read("1 1e39 3 1"); }), "'1e39'");
    EXPECT_HAS(error_of([&] { read("1 2 3"); }), "3 values");
    EXPECT_HAS(error_of([&] { read("1 2 3 4 5"); }), "more values");
    EXPECT_HAS(error_of([&] { read("\n\n"); }), "0 of 1 points");
}

TEST(Records, CoordinatesAreRequired) {
    EXPECT_HAS(error_of([] { empty_cloud({{"x", FieldType::f32, 1, false}}, "f"); }), "'y'");
    std::vector<Column> columns = padded;
    columns[1].count = 2;
    EXPECT_HAS(error_of([&] { empty_cloud(columns, "f"); }), "one number");
    columns[1] = columns[3];
    EXPECT_HAS(error_of([&] { empty_cloud(columns, "f"); }), "two fields");
}

}  // namespace records_test
}  // namespace dynamic_filter::io
