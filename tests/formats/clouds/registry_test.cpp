// SPDX-License-Identifier: MIT
#include "formats/clouds/registry.hpp"

#include "support/bytes.hpp"

namespace dynamic_filter::io {
namespace cloud_registry_test {

TEST(CloudRegistry, ARowIsFoundByTheExtensionInAnyCase) {
    for (const CloudFormat& format : cloud_formats()) {
        EXPECT_EQ(cloud_format_of("a" + format.extension), &format);
        EXPECT_NE(format.read, nullptr) << format.extension;
    }
    EXPECT_EQ(cloud_format_of("A.PCD"), cloud_format_of("b.pcd"));
    EXPECT_EQ(cloud_format_of("a.obj"), nullptr);
    EXPECT_EQ(cloud_format_of("pcd"), nullptr);
}

TEST(CloudRegistry, WhatOneRowWritesItReadsBack) {
    const TemporaryFolder folder;
    Cloud cloud;
    for (const char* name : {"x", "y", "z", "intensity"}) add_field(cloud, name, FieldType::f32);
    const std::string bytes = floats({1, 2, 3, 0.5F, 4, 5, 6, 0.25F});
    const auto raw = std::as_bytes(std::span(bytes));
    cloud.data.assign(raw.begin(), raw.end());
    for (const CloudFormat& format : cloud_formats()) {
        if (format.write == nullptr) continue;
        const auto file = folder.path() / ("a" + format.extension);
        EXPECT_EQ(format.write(file, cloud).points, 2U) << format.extension;
        EXPECT_EQ(positions(format.read(file)), positions(cloud)) << format.extension;
    }
}

TEST(CloudRegistry, MessagesNameWhatCanBeDone) {
    EXPECT_EQ(cloud_extensions(Purpose::write), cloud_kinds_written());
    EXPECT_HAS(cloud_extensions(Purpose::read), ".bin");
    EXPECT_EQ(cloud_extensions(Purpose::read).find(".laz"), std::string::npos);
    EXPECT_EQ(cloud_extensions(Purpose::write).find(".laz"), std::string::npos);
}

TEST(CloudRegistry, TextIsNoScan) {
    EXPECT_EQ(scan_extensions(), (std::set<std::string>{".bin", ".las", ".npy", ".pcd", ".ply"}));
}

}  // namespace cloud_registry_test
}  // namespace dynamic_filter::io
