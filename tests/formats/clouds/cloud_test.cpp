// SPDX-License-Identifier: MIT
#include "dynamic_filter/cloud.hpp"

#include "dynamic_filter/writers.hpp"
#include "support/bytes.hpp"

namespace dynamic_filter::io {
namespace cloud_test {

TEST(Cloud, FieldsFollowEachOther) {
    Cloud cloud;
    add_field(cloud, "x", FieldType::f64);
    add_field(cloud, "n", FieldType::u8, 3);
    add_field(cloud, "i", FieldType::i16);
    EXPECT_EQ(cloud.point_bytes, 13U);
    EXPECT_EQ(cloud.find("i")->offset, 11U);
    EXPECT_EQ(cloud.find("q"), nullptr);
    EXPECT_EQ(cloud.size(), 0U);
    EXPECT_THROW(positions(cloud), Error);
    cloud.data.resize(13);
    EXPECT_THROW(add_field(cloud, "late", FieldType::u8), Error);
}

template <typename T>
double first_value(FieldType type, T value) {
    Cloud cloud;
    add_field(cloud, "_", FieldType::u8);
    add_field(cloud, "v", type);
    const std::string bytes = "p" + bytes_of(value);
    const auto raw = std::as_bytes(std::span(bytes));
    cloud.data.assign(raw.begin(), raw.end());
    return column(cloud, "v").at(0);
}

TEST(Cloud, ValuesOfEveryType) {
    EXPECT_EQ(first_value(FieldType::i8, std::int8_t{-5}), -5.0);
    EXPECT_EQ(first_value(FieldType::u8, std::uint8_t{200}), 200.0);
    EXPECT_EQ(first_value(FieldType::i16, std::int16_t{-500}), -500.0);
    EXPECT_EQ(first_value(FieldType::u16, std::uint16_t{50000}), 50000.0);
    EXPECT_EQ(first_value(FieldType::i32, std::int32_t{-70000}), -70000.0);
    EXPECT_EQ(first_value(FieldType::u32, std::uint32_t{4000000000U}), 4e9);
    EXPECT_EQ(first_value(FieldType::i64, std::int64_t{-1} << 40U), -1099511627776.0);
    EXPECT_EQ(first_value(FieldType::u64, std::uint64_t{1} << 40U), 1099511627776.0);
    EXPECT_EQ(first_value(FieldType::f32, 0.5F), 0.5);
    EXPECT_EQ(first_value(FieldType::f64, 0.1), 0.1);
}

TEST(Cloud, BinRoundTrip) {
    const TemporaryFolder folder;
    const Points points = {{1, 2, 3}, {-4, 5, 6}};
    write_bin(folder / "a.bin", points, std::vector<float>{0.5F, 0.25F});
    const Cloud cloud = read_cloud(folder / "a.bin");
    EXPECT_EQ(positions(cloud), points);
    EXPECT_EQ(column(cloud, "intensity"), (std::vector<double>{0.5, 0.25}));
}

TEST(Cloud, BinTruncatedAnywhere) {
    const TemporaryFolder folder;
    const std::string bytes = floats({1, 2, 3, 4, 5, 6, 7, 8});
    for (std::size_t n = 0; n < bytes.size(); ++n) {
        const auto file = folder.put("a.bin", bytes.substr(0, n));
        if (n == 16) {
            EXPECT_EQ(read_bin(file).size(), 1U);
        } else {
            EXPECT_THROW(read_bin(file), InputError) << n;
        }
    }
}

TEST(Cloud, BinSizeIsExplained) {
    const TemporaryFolder folder;
    const std::string five = error_of([&] { read_bin(folder.put("a.bin", std::string(20, '0'))); });
    EXPECT_HAS(five, "nuScenes");
    EXPECT_HAS(five, "20 bytes");
    EXPECT_HAS(error_of([&] { read_bin(folder.put("a.bin", std::string(12, '0'))); }), "3 floats");
    EXPECT_HAS(error_of([&] { read_bin(folder.put("a.bin", std::string(33, '0'))); }), "byte 32");
}

TEST(Cloud, KindsAreToldByExtension) {
    const TemporaryFolder folder;
    EXPECT_HAS(error_of([&] { read_cloud(folder.put("a.e57", "")); }), "unknown kind");
    EXPECT_HAS(error_of([&] { read_cloud(folder / "none.pcd"); }), "No such file");
    EXPECT_EQ(read_cloud(folder.put("a.BIN", floats({1, 2, 3, 4}))).size(), 1U);
}

}  // namespace cloud_test
}  // namespace dynamic_filter::io
