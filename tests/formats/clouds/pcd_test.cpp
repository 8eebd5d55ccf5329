// SPDX-License-Identifier: MIT
#include <sys/resource.h>

#include "dynamic_filter/cloud.hpp"
#include "support/bytes.hpp"

namespace dynamic_filter::io {
namespace pcd_test {

std::string header(const std::string& data, const std::string& points = "2") {
    return "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z i\nSIZE 4 4 4 1\nTYPE F F F U\n"
           "COUNT 1 1 1 1\nWIDTH " +
           points + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + points + "\nDATA " + data +
           "\n";
}

const std::string body = floats({1, 2, 3}) + "a" + floats({4, 5, 6}) + "b";

std::string lzf_literals(const std::string& bytes) {
    std::string stream;
    for (std::size_t at = 0; at < bytes.size(); at += 32) {
        const std::string run = bytes.substr(at, 32);
        stream += static_cast<char>(run.size() - 1) + run;
    }
    return stream;
}

std::string compressed(const std::string& stream, std::size_t expanded) {
    return bytes_of(static_cast<std::uint32_t>(stream.size())) +
           bytes_of(static_cast<std::uint32_t>(expanded)) + stream;
}

class Pcd : public testing::Test {
protected:
    Cloud read(const std::string& bytes) { return read_pcd(folder_.put("a.pcd", bytes)); }
    std::string error(const std::string& bytes) {
        return error_of([&] { read(bytes); });
    }
    void expect_two_points(const Cloud& cloud) {
        ASSERT_EQ(cloud.size(), 2U);
        EXPECT_EQ(positions(cloud), (Points{{1, 2, 3}, {4, 5, 6}}));
        EXPECT_EQ(column(cloud, "i"), (std::vector<double>{'a', 'b'}));
        EXPECT_FALSE(cloud.viewpoint);
    }
    /// Every prefix is an error, or the whole cloud (a text may lose its last line end or digit).
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

const std::string columns = floats({1, 4, 2, 5, 3, 6}) + "ab";

TEST_F(Pcd, Binary) {
    expect_two_points(read(header("binary") + body));
    expect_two_points(read(header("binary") + body + "padding of some writers"));
    expect_survives_truncation(header("binary") + body, 0);
    const std::string truncated =
        error((header("binary") + body).substr(0, header("").size() + 20));
    EXPECT_HAS(truncated, "1 of 2 points");
    EXPECT_HAS(truncated, "byte ");
}

TEST_F(Pcd, Ascii) {
    const std::string text = header("ascii") + "1 2 3 97\n4 5 6 98\n";
    expect_two_points(read(text));
    expect_survives_truncation(text, 2);
    std::string dos;
    for (const char c : text) dos += c == '\n' ? "\r\n" : std::string(1, c);
    expect_two_points(read(dos));
    EXPECT_EQ(read(header("ascii") + "nan inf -inf 0\n1 2 3 4").size(), 2U);
    EXPECT_HAS(error(header("ascii") + "1 2 3 97\n4 5 junk 98\n"), "line 13");
    EXPECT_HAS(error(header("ascii") + "1 2 3 97\n4 5 6\n"), "line 13");
    EXPECT_HAS(error(text + "7 8 9 10\n"), "more points");
    EXPECT_HAS(error(header("ascii") + "1,0 2 3 97\n4 5 6 98\n"), "'1,0'");
    EXPECT_HAS(error(header("ascii") + std::string(1U << 20U, '1')), "line 12");
}

TEST_F(Pcd, Compressed) {
    const std::string good =
        header("binary_compressed") + compressed(lzf_literals(columns), columns.size());
    expect_two_points(read(good));
    expect_survives_truncation(good, 0);
    const std::string damaged = header("binary_compressed");
    EXPECT_HAS(error(damaged + compressed(lzf_literals(columns), 25)), "declares 25");
    EXPECT_HAS(error(damaged + compressed(lzf_literals(columns) + "\x01", 26)), "damaged");
}

TEST_F(Pcd, CompressedWithRepeat) {
    // Two equal points: x, then "the same 4 bytes again" for each coordinate.
    std::string stream;
    for (const float value : {1.0F, 2.0F, 3.0F}) {
        stream += std::string("\x03") + floats({value}) + std::string("\x40\x03", 2);
    }
    stream += std::string("\x01") + "ab";
    const Cloud cloud = read(header("binary_compressed") + compressed(stream, 26));
    EXPECT_EQ(positions(cloud), (Points{{1, 2, 3}, {1, 2, 3}}));
}

TEST_F(Pcd, BombIsNotAllocated) {
    const std::string bytes = header("binary_compressed", "330382099") +
                              compressed(std::string(20, '\0'), 330382099UL * 13);
    struct rusage before {};
    struct rusage after {};
    ::getrusage(RUSAGE_SELF, &before);
    EXPECT_HAS(error(bytes), "damaged");
    EXPECT_HAS(error(header("ascii", "4000000000") + "1 2 3 4\n"), "1 of 4000000000");
    EXPECT_HAS(error(header("binary", "18446744073709551615")), "0 of 18446744073709551615");
    ::getrusage(RUSAGE_SELF, &after);
    EXPECT_LT(after.ru_maxrss - before.ru_maxrss, 64 * 1024);  // [KiB]
}

TEST_F(Pcd, PaddingOfNoBytesCapitalsAndIntegers) {
    const Cloud cloud = read(
        "FIELDS X Y _ Z _ Intensity\nSIZE 2 4 1 8 1 4\nTYPE I I U F U F\nCOUNT 1 1 4 1 0 1\n"
        "WIDTH 1\nHEIGHT 1\nDATA binary\n" +
        bytes_of(std::int16_t{-7}) + bytes_of(std::int32_t{70000}) + "pppp" + bytes_of(3.5) +
        floats({0.5F}));
    EXPECT_EQ(positions(cloud), (Points{{-7, 70000, 3.5F}}));
    EXPECT_EQ(cloud.find("x")->type, FieldType::f64);
    EXPECT_EQ(column(cloud, "intensity").at(0), 0.5);
    EXPECT_EQ(positions(read("FIELDS x y z X\nSIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 1\nWIDTH 1\n"
                             "HEIGHT 1\nDATA ascii\n1 2 3 9\n")),
              (Points{{1, 2, 3}}));
}

TEST_F(Pcd, PaddingAndOddOrder) {
    const std::string head =
        "FIELDS _ z _ y x n\nSIZE 1 4 1 8 4 2\nTYPE U F U F F I\nCOUNT 3 1 5 1 1 2\nWIDTH 1\n"
        "HEIGHT 2\nDATA ";
    const std::string numbers =
        floats({4.0F}) + bytes_of(std::int16_t{-1}) + bytes_of(std::int16_t{7});
    const std::string row = "ppp" + floats({2.0F}) + "ppppp" + bytes_of(3.0) + numbers;
    const std::string text = "0 0 0 2 0 0 0 0 0 3 4 -1 7\n";
    const std::string z = floats({2, 2}), y = bytes_of(3.0) + bytes_of(3.0), x = floats({4, 4});
    const std::string n = numbers.substr(4) + numbers.substr(4);
    const std::string lean = z + y + x + n, full = "pppppp" + z + "pppppppppp" + y + x + n;
    for (const std::string& bytes :
         {"binary\n" + row + row, "ascii\n" + text + text,
          "binary_compressed\n" + compressed(lzf_literals(lean), lean.size()),
          "binary_compressed\n" + compressed(lzf_literals(full), full.size())}) {
        const Cloud cloud = read(head + bytes);
        ASSERT_EQ(cloud.fields.size(), 4U);
        EXPECT_EQ(cloud.fields[0].name, "z");
        EXPECT_EQ(cloud.point_bytes, 20U);
        EXPECT_EQ(positions(cloud), (Points{{4, 3, 2}, {4, 3, 2}}));
        EXPECT_EQ(column(cloud, "n"), std::vector<double>(2, -1.0));
    }
}

TEST_F(Pcd, NoPoints) {
    EXPECT_EQ(read(header("binary", "0")).size(), 0U);
    EXPECT_EQ(read(header("ascii", "0")).size(), 0U);
    EXPECT_EQ(read(header("binary_compressed", "0") + compressed("", 0)).size(), 0U);
}

}  // namespace pcd_test
}  // namespace dynamic_filter::io
