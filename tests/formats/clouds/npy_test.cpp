// SPDX-License-Identifier: MIT
#include "dynamic_filter/cloud.hpp"
#include "dynamic_filter/writers.hpp"
#include "support/bytes.hpp"

namespace dynamic_filter::io {
namespace npy_test {

std::string npy(const std::string& dictionary, const std::string& body, char version = 1) {
    const auto length = static_cast<std::uint32_t>(dictionary.size());
    return "\x93NUMPY" + std::string{version, '\0'} +
           (version == 1 ? bytes_of(static_cast<std::uint16_t>(length)) : bytes_of(length)) +
           dictionary + body;
}

std::string dictionary(const std::string& type, const std::string& shape,
                       const std::string& fortran = "False") {
    return "{'descr': " + type + ", 'fortran_order': " + fortran + ", 'shape': " + shape + ", }\n";
}

class Npy : public testing::Test {
protected:
    Cloud read(const std::string& bytes) { return read_cloud(folder_.put("a.npy", bytes)); }
    std::string error(const std::string& bytes) {
        return error_of([&] { read(bytes); });
    }
    TemporaryFolder folder_;
};

TEST_F(Npy, TypesAndVersions) {
    const Points points = {{1, 2, 3}, {4, 5, 6}};
    const std::string little = floats({1, 2, 3, 4, 5, 6});
    for (const char version : {'\1', '\2', '\3'}) {
        const Cloud cloud = read(npy(dictionary("'<f4'", "(2, 3)"), little, version));
        EXPECT_EQ(positions(cloud), points);
        EXPECT_EQ(cloud.fields.size(), 3U);
    }
    EXPECT_EQ(positions(read(npy(dictionary("'>f4'", "(2, 3)"), floats({1, 2, 3, 4, 5, 6}, true)))),
              points);
    for (const bool big : {false, true}) {
        std::string wide;
        for (const double v : {1.0, 2.0, 3.0, 0.1, 9.0}) wide += bytes_of(v, big);
        const Cloud cloud = read(npy(dictionary(big ? "\">f8\"" : "\"<f8\"", "(1,5)"), wide));
        EXPECT_EQ(cloud.find("x")->type, FieldType::f64);
        EXPECT_EQ(column(cloud, "intensity").at(0), 0.1);
        EXPECT_EQ(column(cloud, "c4").at(0), 9.0);
    }
    EXPECT_EQ(read(npy(dictionary("'<f4'", "(0, 3)"), "")).size(), 0U);
}

TEST_F(Npy, FortranOrderAndRowsInPlaceOfColumns) {
    const Points points = {{1, 2, 3}, {4, 5, 6}};
    const std::string all_x_first = floats({1, 4, 2, 5, 3, 6});
    EXPECT_EQ(positions(read(npy(dictionary("'<f4'", "(2, 3)", "True"), all_x_first))), points);
    std::vector<float> rows(4 * 40), columns(4 * 40);
    for (std::size_t i = 0; i < 40; ++i) {
        for (std::size_t k = 0; k < 4; ++k)
            rows[k * 40 + i] = columns[i * 4 + k] = static_cast<float>(100 * k + i);
    }
    const auto bytes = [](const std::vector<float>& values) {
        std::string text;
        for (const float value : values) text += bytes_of(value);
        return text;
    };
    for (const Cloud& cloud : {read(npy(dictionary("'<f4'", "(4, 40)"), bytes(rows))),
                               read(npy(dictionary("'<f4'", "(4, 40)", "True"), bytes(columns)))}) {
        ASSERT_EQ(cloud.size(), 40U);
        EXPECT_EQ(positions(cloud)[7], Point(7, 107, 207));
        EXPECT_EQ(column(cloud, "intensity").at(7), 307.0);
    }
    EXPECT_HAS(error(npy(dictionary("'<f4'", "(2, 3)", "True"), floats({1, 4, 2, 5}))), "1 of 2");
}

TEST_F(Npy, StructuredArrays) {
    const std::string type =
        "[('X', '<f4'), ('y', '<f8'), ('z', '<i2'), ('', '|V2'), (\"t\", '<u4'), ('ring', '|u1')]";
    const auto record = [](float x, double y, std::int16_t z, std::uint32_t t) {
        return bytes_of(x) + bytes_of(y) + bytes_of(z) + "??" + bytes_of(t) + "\x07";
    };
    const std::string body = record(1, 2, 3, 70000) + record(4, 5, -6, 80000);
    for (const char* shape : {"(2,)", "(2, 1)", "(1, 2)"}) {
        const Cloud cloud = read(npy(dictionary(type, shape), body));
        EXPECT_EQ(positions(cloud), (Points{{1, 2, 3}, {4, 5, -6}})) << shape;
        EXPECT_EQ(column(cloud, "t"), (std::vector<double>{70000, 80000}));
        EXPECT_EQ(column(cloud, "ring").at(1), 7.0);
        EXPECT_EQ(cloud.find("z")->type, FieldType::f64);
    }
    const std::string big = bytes_of(1.0F, true) + bytes_of(2.0F, true) + bytes_of(3.0F, true);
    EXPECT_EQ(
        positions(read(npy(dictionary("[('x','>f4'),('y','>f4'),('z','>f4')]", "(1,)"), big))),
        (Points{{1, 2, 3}}));
    EXPECT_HAS(error(npy(dictionary(type, "(2,)"), body.substr(0, 30))), "1 of 2");
    for (const auto& [fields, what] : std::vector<std::pair<std::string, std::string>>{
             {"[('x', '<f4')]", "no field 'y'"},
             {"[]", "no fields"},
             {"[('x' '<f4')]", "cut off"},
             {"[('x', '<f4'), 7]", "cut off"},
             {"[(7, '<f4')]", "in quotes"},
             {"[('x', '<c8')]", "'<c8'"},
             {"[('x', '')]", "''"},
             {"[('x', '<f4', (3,))]", "itself an array"},
             {"[('x', '<f4'), ('y', '>f4')]", "both byte orders"},
             {"[('', '|V99999999')]", "padding"}}) {
        EXPECT_HAS(error(npy(dictionary(fields, "(1,)"), std::string(64, '\0'))), what);
    }
    EXPECT_HAS(error(npy(dictionary(type, "(4294967296, 4294967296)"), body)), "overflows");
}

TEST_F(Npy, Refusals) {
    EXPECT_HAS(error("PK\x03\x04 and more"), "does not begin");
    EXPECT_HAS(error(npy(dictionary("'<f4'", "(2, 3)"), "", '\4')), "version 4");
    EXPECT_HAS(error(npy(dictionary("'<i4'", "(2, 3)"), "")), "'<i4'");
    for (const char* shape : {"(6,)", "()", "(2, 2)", "(1, 2, 3)", "(2, 3", "3", "(-2, 3)",
                              "(0, 9223372036854775808)", "(1e3, 3)", "(0, 4294967295)"}) {
        EXPECT_HAS(error(npy(dictionary("'<f4'", shape), floats({1, 2, 3, 4, 5, 6}))), "shap");
    }
    EXPECT_HAS(error(npy("{'descr': '<f4', 'shape': (1, 3)}", floats({1, 2, 3}))), "fortran_order");
    EXPECT_HAS(error(npy("{'descr': '<f", "")), "descr");
    EXPECT_HAS(error(npy("{'descr'", "")), "descr");
    for (const char* rows : {"4294967295", "9223372036854775808", "18446744073709551615"}) {
        const std::string shape = std::string("(") + rows + ", 3)";
        EXPECT_HAS(error(npy(dictionary("'<f4'", shape), floats({1, 2, 3}))),
                   "1 of " + std::string(rows));
    }
}

TEST_F(Npy, TruncatedAnywhere) {
    const std::string bytes = npy(dictionary("'<f4'", "(2, 3)"), floats({1, 2, 3, 4, 5, 6}));
    for (std::size_t n = 0; n < bytes.size(); ++n) {
        EXPECT_THROW(read(bytes.substr(0, n)), InputError) << n;
    }
}

Cloud sample(FieldType extra) {
    Cloud cloud;
    add_field(cloud, "ring", extra);
    for (const char* name : {"x", "y", "z"}) add_field(cloud, name, FieldType::f32);
    for (std::uint8_t i = 0; i < 3; ++i) {
        std::string record(size_of(extra), '\0');
        record[0] = static_cast<char>(i);
        const auto n = static_cast<float>(i);
        record += floats({n, 0.5F * n, 0.1F});
        const auto raw = std::as_bytes(std::span(record));
        cloud.data.insert(cloud.data.end(), raw.begin(), raw.end());
    }
    return cloud;
}

TEST_F(Npy, RoundTrip) {
    for (const FieldType type : {FieldType::u16, FieldType::u64}) {
        const Cloud cloud = sample(type);
        EXPECT_HAS(write_npy(folder_ / "w.npy", cloud), "ring is column 4");
        EXPECT_EQ(slurp(folder_ / "w.npy").find('\n') % 64, 63U);
        const Cloud back = read_npy(folder_ / "w.npy");
        EXPECT_EQ(back.find("x")->type, type == FieldType::u16 ? FieldType::f32 : FieldType::f64);
        for (const char* name : {"x", "y", "z"}) EXPECT_EQ(column(back, name), column(cloud, name));
        EXPECT_EQ(column(back, "intensity"), std::vector<double>(3, 0.0));
        EXPECT_EQ(column(back, "c4"), column(cloud, "ring"));
    }
    Cloud plain;
    for (const char* name : {"x", "y", "z"}) add_field(plain, name, FieldType::f32);
    EXPECT_EQ(write_npy(folder_ / "w.npy", plain), "");
    EXPECT_EQ(read_npy(folder_ / "w.npy").fields.size(), 3U);
}

}  // namespace npy_test
}  // namespace dynamic_filter::io
