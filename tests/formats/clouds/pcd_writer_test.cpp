// SPDX-License-Identifier: MIT
#include "dynamic_filter/writers.hpp"
#include "support/bytes.hpp"

namespace dynamic_filter::io {
namespace pcd_writer_test {

Cloud two_points() {
    Cloud cloud;
    for (const char* name : {"x", "y", "z"}) add_field(cloud, name, FieldType::f32);
    add_field(cloud, "id", FieldType::u8, 2);
    const std::string bytes = floats({0.1F, -2, 3}) + "\x01\xFF" + floats({4, 5, 6}) + "\x07\x08";
    const auto raw = std::as_bytes(std::span(bytes));
    cloud.data.assign(raw.begin(), raw.end());
    return cloud;
}

/// What follows the line DATA.
std::string data_of(const std::string& file) {
    return file.substr(file.find('\n', file.find("\nDATA") + 1) + 1);
}

TEST(PcdWriter, TextHasTheFewestDigitsThatAreReadBackAsTheSameNumber) {
    const TemporaryFolder folder;
    write_pcd(folder / "a.pcd", two_points(), PcdData::ascii);
    const std::string file = slurp(folder / "a.pcd");
    EXPECT_EQ(data_of(file), "0.1 -2 3 1 255\n4 5 6 7 8\n");
    EXPECT_HAS(file, "FIELDS x y z id\n");
    EXPECT_HAS(file, "COUNT 1 1 1 2\n");
    EXPECT_HAS(file, "VIEWPOINT 0 0 0 1 0 0 0\n");
    EXPECT_HAS(file, "\nPOINTS 2 ");  // with room for a larger number
}

TEST(PcdWriter, BinaryDataAreThoseOfTheCloud) {
    const TemporaryFolder folder;
    const Cloud cloud = two_points();
    write_pcd(folder / "a.pcd", cloud, PcdData::binary);
    const std::string data = data_of(slurp(folder / "a.pcd"));
    ASSERT_EQ(data.size(), cloud.data.size());
    EXPECT_EQ(std::memcmp(data.data(), cloud.data.data(), data.size()), 0);
}

TEST(PcdWriter, CompressedDataBeginWithTheirSizes) {
    const TemporaryFolder folder;
    write_pcd(folder / "a.pcd", two_points(), PcdData::compressed);
    const std::string data = data_of(slurp(folder / "a.pcd"));
    std::uint32_t sizes[2] = {};  // packed, and unpacked
    ASSERT_GE(data.size(), sizeof sizes);
    std::memcpy(sizes, data.data(), sizeof sizes);
    EXPECT_EQ(sizes[0], data.size() - sizeof sizes);
    EXPECT_EQ(sizes[1], 28U);
    EXPECT_EQ(read_pcd(folder / "a.pcd").data, two_points().data);
}

}  // namespace pcd_writer_test
}  // namespace dynamic_filter::io
