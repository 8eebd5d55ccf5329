// SPDX-License-Identifier: MIT
#include "dynamic_filter/writers.hpp"
#include "support/bytes.hpp"

namespace dynamic_filter::io {
namespace cloud_writers_test {

constexpr FieldType all_types[] = {FieldType::i8,  FieldType::u8,  FieldType::i16, FieldType::u16,
                                   FieldType::i32, FieldType::u32, FieldType::f32, FieldType::f64};

/// Fields of all types, one of them threefold.
Cloud mixed(std::size_t points, bool wide) {
    Cloud cloud;
    for (const char* name : {"x", "y", "z"}) add_field(cloud, name, FieldType::f32);
    int n = 0;
    for (const FieldType type : all_types) add_field(cloud, "f" + std::to_string(n++), type);
    add_field(cloud, "several", FieldType::i16, 3);
    if (wide) {
        add_field(cloud, "wide", FieldType::u64);
        add_field(cloud, "wider", FieldType::i64);
    }
    for (std::size_t i = 0; i < points * cloud.point_bytes; ++i) {
        cloud.data.push_back(static_cast<std::byte>(i * 7 % 61));
    }
    return cloud;
}

class CloudWriters : public testing::Test {
protected:
    TemporaryFolder folder_;
};

TEST_F(CloudWriters, PcdOfAllKinds) {
    for (const PcdData data : {PcdData::ascii, PcdData::binary, PcdData::compressed}) {
        for (const std::size_t points : {0U, 1U, 5000U}) {
            const Cloud cloud = mixed(points, true);
            write_pcd(folder_ / "a.pcd", cloud, data);
            const Cloud back = read_pcd(folder_ / "a.pcd");
            EXPECT_EQ(back.fields, cloud.fields);
            EXPECT_TRUE(back.data == cloud.data);
        }
    }
    EXPECT_LT(std::filesystem::file_size(folder_ / "a.pcd"), mixed(5000, true).data.size());
}

TEST_F(CloudWriters, PcdKeepsWhatIsNotFinite) {
    Cloud cloud = mixed(1, false);
    const std::string values = floats({std::nanf(""), -INFINITY, -0.0F});
    std::memcpy(cloud.data.data(), values.data(), values.size());
    write_pcd(folder_ / "a.pcd", cloud, PcdData::ascii);
    EXPECT_TRUE(read_pcd(folder_ / "a.pcd").data == cloud.data);
}

TEST_F(CloudWriters, PcdTruncatedAnywhere) {
    for (const PcdData data : {PcdData::ascii, PcdData::compressed}) {
        write_pcd(folder_ / "a.pcd", mixed(2, false), data);
        const std::string bytes = slurp(folder_ / "a.pcd");
        for (std::size_t n = 0; n < bytes.size(); ++n) {
            try {
                EXPECT_EQ(read_pcd(folder_.put("b.pcd", bytes.substr(0, n))).size(), 2U);
                EXPECT_EQ(data, PcdData::ascii);
                EXPECT_GE(n + 6, bytes.size());  // the last value's digits, or the line's end
            } catch (const InputError&) {
            }
        }
    }
}

TEST_F(CloudWriters, Ply) {
    const Cloud cloud = mixed(3, false);
    EXPECT_EQ(write_ply(folder_ / "a.ply", cloud), "");
    const Cloud back = read_ply(folder_ / "a.ply");
    EXPECT_TRUE(back.data == cloud.data);
    EXPECT_EQ(back.find("several_2")->type, FieldType::i16);
    const Cloud wide = mixed(3, true);
    EXPECT_HAS(write_ply(folder_ / "a.ply", wide), "wide, wider");
    EXPECT_EQ(read_ply(folder_ / "a.ply").find("wide")->type, FieldType::f64);
    EXPECT_EQ(column(read_ply(folder_ / "a.ply"), "wider"), column(wide, "wider"));
}

TEST_F(CloudWriters, Bin) {
    const Cloud cloud = mixed(3, false);
    EXPECT_HAS(write_bin(folder_ / "a.bin", cloud), "left out: f0, f1");
    const Cloud back = read_bin(folder_ / "a.bin");
    EXPECT_EQ(positions(back), positions(cloud));
    EXPECT_EQ(column(back, "intensity"), std::vector<double>(3, 0.0));
    Cloud exact;
    for (const char* name : {"z", "y", "x"}) add_field(exact, name, FieldType::f64);
    add_field(exact, "intensity", FieldType::u8);
    const std::string record = bytes_of(3.0) + bytes_of(2.0) + bytes_of(1.0) + "a";
    const auto raw = std::as_bytes(std::span(record));
    exact.data.assign(raw.begin(), raw.end());
    EXPECT_EQ(write_bin(folder_ / "a.bin", exact), "rounded to float32: x, y, z");
    EXPECT_EQ(slurp(folder_ / "a.bin"), floats({1, 2, 3, 'a'}));
}

TEST_F(CloudWriters, KindIsToldByExtension) {
    const Cloud cloud = mixed(2, false);
    for (const char* name : {"a.pcd", "a.PLY", "a.las", "a.npy", "a.bin", "a.xyz", "a.csv"}) {
        EXPECT_TRUE(can_write_cloud(name));
        EXPECT_EQ(write_cloud(folder_ / name, cloud).points, 2U);
        EXPECT_EQ(read_cloud(folder_ / name).size(), 2U) << name;
    }
    EXPECT_HAS(error_of<OutputError>([&] { write_cloud(folder_ / "a.obj", cloud); }), "unknown");
    EXPECT_FALSE(can_write_cloud("a.obj"));
    EXPECT_HAS(error_of<OutputError>([&] { write_ply(folder_ / "b.ply", Cloud{}); }), "'x'");
    EXPECT_FALSE(std::filesystem::exists(folder_ / "b.ply"));
}

}  // namespace cloud_writers_test
}  // namespace dynamic_filter::io
