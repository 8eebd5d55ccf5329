// SPDX-License-Identifier: MIT
#include "formats/clouds/pcd_header.hpp"

#include "support/bytes.hpp"

namespace dynamic_filter::io {
namespace pcd_header_test {

/// A good header in which one line is replaced (or dropped, if `with` is empty).
std::string header_with(const std::string& key, const std::string& with) {
    std::string text;
    for (const std::string line :
         {"VERSION .7", "FIELDS x y z", "SIZE 4 4 4", "TYPE F F F", "COUNT 1 1 1", "WIDTH 2",
          "HEIGHT 3", "VIEWPOINT 0 0 0 1 0 0 0", "POINTS 6", "DATA ascii"}) {
        const bool replaced = line.starts_with(key + " ");
        if (!replaced) text += line + "\n";
        if (replaced && !with.empty()) text += with + "\n";
    }
    return text;
}

PcdHeader parse(const std::string& text) {
    Lines lines(text, "f.pcd");
    return parse_pcd_header(lines);
}

std::string error_with(const std::string& key, const std::string& with) {
    return error_of([&] { parse(header_with(key, with)); });
}

TEST(PcdHeader, DefaultsOfMissingLines) {
    EXPECT_EQ(parse(header_with("COUNT", "")).points, 6U);
    EXPECT_EQ(parse(header_with("POINTS", "")).points, 6U);
    EXPECT_EQ(parse(header_with("VERSION", "")).columns.size(), 3U);
    EXPECT_FALSE(parse(header_with("VIEWPOINT", "")).viewpoint);
}

TEST(PcdHeader, Viewpoint) {
    const auto pose = parse(header_with("VIEWPOINT", "VIEWPOINT 1 2 3 0.7 0 0 0.714")).viewpoint;
    ASSERT_TRUE(pose);
    EXPECT_EQ(pose->translation(), Eigen::Vector3d(1, 2, 3));
    EXPECT_NEAR(pose->linear().determinant(), 1.0, 1e-12);
    EXPECT_GT(pose->linear()(1, 0), 0.9);  // about z, a quarter turn
    EXPECT_HAS(error_with("VIEWPOINT", "VIEWPOINT 1 2 3 0 0 0 0"), "wxyz");
    EXPECT_HAS(error_with("VIEWPOINT", "VIEWPOINT 1 2 3 0.9 0 0 0"), "wxyz");
    EXPECT_HAS(error_with("VIEWPOINT", "VIEWPOINT 1 2 3 nan 0 0 0"), "wxyz");
    EXPECT_HAS(error_with("VIEWPOINT", "VIEWPOINT 1 2 3"), "7 numbers");
}

TEST(PcdHeader, GarbageIsNamed) {
    const std::vector<std::array<std::string, 3>> cases = {
        {"VERSION", "NONSENSE 1", "'NONSENSE'"},
        {"FIELDS", "", "no FIELDS"},
        {"FIELDS", "FIELDS x y", "disagree"},
        {"FIELDS", "FIELDS x y z\nFIELDS x y z", "second"},
        {"SIZE", "SIZE 4 4", "disagree"},
        {"SIZE", "SIZE 4 4 -4", "'-4'"},
        {"SIZE", "SIZE 4 4 3", "'3'"},
        {"TYPE", "TYPE F F X", "'X'"},
        {"TYPE", "", "disagree"},
        {"COUNT", "COUNT 1 1 0", "COUNT of 0"},
        {"COUNT", "COUNT 1 1 1000000000", "plausible"},
        {"COUNT", "COUNT", "disagree"},
        {"WIDTH", "WIDTH -1", "line 6"},
        {"WIDTH", "WIDTH 1e9", "'1e9'"},
        {"WIDTH", "WIDTH +2", "'+2'"},
        {"WIDTH", "WIDTH 02", "'02'"},
        {"WIDTH", "WIDTH 2 2", "exactly one"},
        {"WIDTH", "WIDTH 9223372036854775808", "overflows"},
        {"POINTS", "POINTS 7", "POINTS is 7"},
        {"DATA", "DATA zip", "'zip'"},
        {"DATA", "DATA", "''"},
        {"DATA", "", "truncated"}};
    for (const auto& [key, with, part] : cases) EXPECT_HAS(error_with(key, with), part);
    for (const std::string& text : {std::string(), std::string("#"), std::string("# .PCD v0.7\n"),
                                    std::string(1000, '\0'), std::string(1000, '\xff')}) {
        error_of([&] { parse(text); });
    }
}

TEST(PcdHeader, WrittenCountsHaveRoom) {
    const std::vector<Field> fields = {{"x", FieldType::f32, 1, 0},
                                       {"y", FieldType::f32, 1, 4},
                                       {"z", FieldType::f64, 1, 8},
                                       {"n", FieldType::u16, 3, 16}};
    const PcdHeaderText written = pcd_header_text(fields, 42, Pose::Identity());
    EXPECT_EQ(written.text.substr(written.width_at, pcd_count_width), pcd_count(42));
    EXPECT_EQ(written.text.substr(written.points_at, pcd_count_width), pcd_count(42));
    const PcdHeader header = parse(written.text);
    EXPECT_EQ(header.points, 42U);
    EXPECT_EQ(record_bytes(header.columns), 22U);
    EXPECT_EQ(header.data, PcdData::binary);
}

}  // namespace pcd_header_test
}  // namespace dynamic_filter::io
