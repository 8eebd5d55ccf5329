// SPDX-License-Identifier: MIT
#include "formats/clouds/ply_header.hpp"

#include "support/bytes.hpp"

namespace dynamic_filter::io {
namespace ply_header_test {

PlyHeader parse(const std::string& text) {
    Lines lines(text, "f.ply");
    return parse_ply_header(lines);
}

TEST(PlyHeader, ManyPropertiesOfBothNames) {
    std::string text = "ply\nformat ascii 1.0\nelement vertex 1\n";
    for (int i = 0; i < 1000; ++i) text += "property int16 p" + std::to_string(i) + "\n";
    const PlyHeader header = parse(text + "property short q\nend_header\n");
    EXPECT_EQ(header.columns.size(), 1001U);
    EXPECT_EQ(header.columns.back().type, FieldType::i16);
}

TEST(PlyHeader, GarbageIsNamed) {
    const std::string start = "ply\nformat ascii 1.0\n";
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"", "byte 0"},
        {"plx\n", "'ply'"},
        {"ply\n", "end_header"},
        {"ply\nend_header\n", "no format"},
        {"ply\nformat zip 1.0\n", "'zip'"},
        {"ply\nformat\n", "''"},
        {start + "end_header\n", "no element 'vertex'"},
        {start + "property int x\n", "before the first element"},
        {start + "element vertex\n", "NAME COUNT"},
        {start + "element vertex -1\n", "'-1'"},
        {start + "element vertex 1e9\n", "'1e9'"},
        {start + "element vertex 1\nproperty word x\n", "'word'"},
        {start + "element vertex 1\nproperty int\n", "property TYPE NAME"},
        {start + "element vertex 1\nproperty list float int x\n", "integer"},
        {start + "element vertex 1\nproperty list uchar int x\nend_header\n", "is a list"},
        {start + "nonsense\n", "'nonsense'"}};
    for (const auto& [text, part] : cases) {
        EXPECT_HAS(error_of([&, &bytes = text] { parse(bytes); }), part);
    }
}

}  // namespace ply_header_test
}  // namespace dynamic_filter::io
