// SPDX-License-Identifier: MIT
#include "dynamic_filter/writers.hpp"

#include "dynamic_filter/recording.hpp"
#include "support/bytes.hpp"

namespace dynamic_filter::io {
namespace writers_test {

Cloud cloud_of(std::size_t points) {
    Cloud cloud;
    for (const char* name : {"x", "y", "z"}) add_field(cloud, name, FieldType::f32);
    add_field(cloud, "ring", FieldType::u16);
    add_field(cloud, "extra", FieldType::u8, 3);
    for (std::size_t i = 0; i < points * cloud.point_bytes; ++i) {
        cloud.data.push_back(static_cast<std::byte>(i % 251));
    }
    return cloud;
}

TEST(Writers, PcdRoundTrip) {
    const TemporaryFolder folder;
    Cloud cloud = cloud_of(5);
    cloud.viewpoint =
        Pose(Eigen::Translation3d(1, 2, 3) * Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitY()));
    write_pcd(folder / "a.pcd", cloud);
    const Cloud back = read_pcd(folder / "a.pcd");
    EXPECT_EQ(back.fields, cloud.fields);
    EXPECT_EQ(back.data, cloud.data);
    ASSERT_TRUE(back.viewpoint);
    EXPECT_TRUE(back.viewpoint->isApprox(*cloud.viewpoint, 1e-14));
}

TEST(Writers, PcdWriterCountsItself) {
    const TemporaryFolder folder;
    const Cloud cloud = cloud_of(100000);  // more than the file's buffer
    {
        PcdWriter writer(folder / "a.pcd", cloud.fields, cloud.point_bytes);
        writer.append(cloud.data);
        EXPECT_THROW(writer.append(std::span(cloud.data).first(3)), Error);
        writer.append(std::span(cloud.data).first(2 * cloud.point_bytes));
        EXPECT_EQ(writer.size(), 100002U);
        writer.commit();
    }
    EXPECT_EQ(read_pcd(folder / "a.pcd").size(), 100002U);
    PcdWriter empty(folder / "b.pcd", cloud.fields, cloud.point_bytes);
    empty.commit();
    EXPECT_EQ(read_pcd(folder / "b.pcd").size(), 0U);
}

TEST(Writers, LabelsRoundTrip) {
    const TemporaryFolder folder;
    const Labels labels = {Label::unknown, Label::static_, Label::dynamic};
    write_labels(folder / "a.label", labels);
    EXPECT_EQ(std::filesystem::file_size(folder / "a.label"), 12U);
    EXPECT_EQ(read_labels(folder / "a.label"), labels);
}

TEST(Writers, NumberedLabelsAreReadAsTheirLowerHalf) {
    const TemporaryFolder folder;
    const std::vector<std::uint32_t> labels = {9U, 259U | (7U << 16U), 251U,
                                               259U | (65535U << 16U)};
    write_numbered_labels(folder / "a.label", labels);
    EXPECT_EQ(read_labels(folder / "a.label"),
              (Labels{Label::static_, Label::dynamic, Label::dynamic, Label::dynamic}));
}

TEST(Writers, Faults) {
    const TemporaryFolder folder;
    EXPECT_THROW(write_bin(folder / "a.bin", Points(2), std::vector<float>(1)), OutputError);
    EXPECT_THROW(write_labels(folder / "none/a.label", {}), OutputError);
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace writers_test
}  // namespace dynamic_filter::io
