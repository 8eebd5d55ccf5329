// SPDX-License-Identifier: MIT
#include "dynamic_filter/cloud.hpp"
#include "support/bytes.hpp"

namespace dynamic_filter::io {
namespace ply_test {

const std::string vertex =
    "element vertex 2\nproperty float x\nproperty double y\nproperty float32 z\n"
    "property uchar i\n";

std::string head(const std::string& format, const std::string& before = "",
                 const std::string& after = "") {
    return "ply\nformat " + format + " 1.0\ncomment made here\n" + before + vertex + after +
           "end_header\n";
}

std::string points(bool big) {
    return floats({1}, big) + bytes_of(2.0, big) + floats({3}, big) + "a" + floats({4}, big) +
           bytes_of(5.0, big) + floats({6}, big) + "b";
}

class Ply : public testing::Test {
protected:
    Cloud read(const std::string& bytes) { return read_ply(folder_.put("a.ply", bytes)); }
    std::string error(const std::string& bytes) {
        return error_of([&] { read(bytes); });
    }
    void expect_two_points(const Cloud& cloud) {
        EXPECT_EQ(positions(cloud), (Points{{1, 2, 3}, {4, 5, 6}}));
        EXPECT_EQ(column(cloud, "y"), (std::vector<double>{2, 5}));
        EXPECT_EQ(column(cloud, "i"), (std::vector<double>{'a', 'b'}));
    }
    void expect_survives_truncation(const std::string& bytes, std::size_t may_lose) {
        for (std::size_t n = 0; n < bytes.size(); ++n) {
            try {
                const Cloud back = read(bytes.substr(0, n));
                ASSERT_EQ(back.size(), 2U);
                EXPECT_EQ(positions(back), (Points{{1, 2, 3}, {4, 5, 6}}));
                EXPECT_LE(bytes.size() - n, may_lose);
            } catch (const InputError&) {
            }
        }
    }
    TemporaryFolder folder_;
};

TEST_F(Ply, Binary) {
    const std::string little = head("binary_little_endian") + points(false);
    const std::string big = head("binary_big_endian") + points(true);
    expect_two_points(read(little));
    expect_two_points(read(big));
    expect_survives_truncation(little, 0);
    expect_survives_truncation(big, 0);
}

TEST_F(Ply, Ascii) {
    const std::string text = head("ascii") + "1 2 3 97\n4 5 6 98\n";
    expect_two_points(read(text));
    expect_survives_truncation(text, 2);
    std::string dos;
    for (const char c : text) dos += c == '\n' ? "\r\n" : std::string(1, c);
    expect_two_points(read(dos));
    EXPECT_HAS(error(head("ascii") + "1 2 3 97\n4 5 oops 98\n"), "line 11");
    EXPECT_HAS(error(head("ascii") + "1 2 3 97\n"), "1 of 2 points");
}

TEST_F(Ply, ElementsAroundTheVertices) {
    const std::string camera = "element camera 2\nproperty short a\nproperty int b\n";
    const std::string face = "element face 2\nproperty list uchar int v\nproperty uchar f\n";
    for (const bool big : {false, true}) {
        const std::string skipped = std::string(12, 'c') + "\x02" + std::string(8, 'v') + "f" +
                                    std::string("\x00", 1) + "f";
        const std::string format = big ? "binary_big_endian" : "binary_little_endian";
        expect_two_points(read(head(format, camera + face) + skipped + points(big)));
        expect_two_points(read(head(format, "", face) + points(big) + "rest"));
    }
    expect_two_points(
        read(head("ascii", camera + face) + "1 2\n3 4\n1 7 0\n0 0\n1 2 3 97\n4 5 6 98\n"));
}

TEST_F(Ply, ListsOfVerticesArePassedOver) {
    const std::string element =
        "element vertex 2\nproperty list uchar short view\nproperty float x\nproperty float y\n"
        "property list uchar float more\nproperty int Z\nend_header\n";
    for (const bool big : {false, true}) {
        const auto shorts = [&](std::int16_t v) { return bytes_of(v, big); };
        const std::string body = "\x02" + shorts(7) + shorts(8) + floats({1, 2}, big) +
                                 std::string("\x00", 1) + bytes_of(std::int32_t{3}, big) +
                                 std::string("\x00", 1) + floats({4, 5}, big) + "\x01" +
                                 floats({9}, big) + bytes_of(std::int32_t{6}, big);
        const std::string start =
            std::string("ply\nformat binary_") + (big ? "big" : "little") + "_endian 1.0\n";
        EXPECT_EQ(positions(read(start + element + body)), (Points{{1, 2, 3}, {4, 5, 6}}));
        for (std::size_t n = 0; n < body.size(); ++n)
            EXPECT_HAS(error(start + element + body.substr(0, n)), "truncated");
    }
    const std::string ascii = "ply\nformat ascii 1.0\n" + element;
    EXPECT_EQ(positions(read(ascii + "2 7 8 1 2 0 3\n\n0 4 5 1 9 6\n")),
              (Points{{1, 2, 3}, {4, 5, 6}}));
    EXPECT_HAS(error(ascii + "2 7 8 1 2 0 3\n1\n"), "line 11");
    EXPECT_HAS(error(ascii + "2 7 8 1 2 0 3\n-1 4 5 0 6\n"), "no length of the list 'view'");
    EXPECT_HAS(error(ascii + "2 7 8 1 2 0 3\n"), "1 of 2 points");
    EXPECT_HAS(error("ply\nformat binary_little_endian 1.0\nelement vertex 4294967295\n" +
                     element.substr(element.find('\n') + 1) + std::string(20, '\xff')),
               "truncated");
}

TEST_F(Ply, HugeCountsCostNothing) {
    const std::string list = "element face 18446744073709551615\nproperty list int int v\n";
    const std::string flat = "element face 18446744073709551615\nproperty int v\n";
    const std::string none = "element face 18446744073709551615\n";
    EXPECT_HAS(error(head("binary_little_endian", list) + std::string(40, '\0')), "truncated");
    EXPECT_HAS(error(head("binary_little_endian", list) + std::string(40, '\xff')), "truncated");
    EXPECT_HAS(error(head("binary_little_endian", flat) + points(false)), "truncated");
    expect_two_points(read(head("binary_little_endian", none) + points(false)));
    EXPECT_HAS(error(head("ascii", flat) + "1\n2\n"), "truncated");
    const std::string many =
        "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\n"
        "property float x\nproperty float y\nproperty float z\nend_header\n";
    EXPECT_HAS(error(many), "0 of 4000000000");
}

}  // namespace ply_test
}  // namespace dynamic_filter::io
