// SPDX-License-Identifier: MIT
#include "recording/common_fields.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "support/bytes.hpp"

namespace dynamic_filter::io {
namespace common_fields_test {

std::vector<std::string> names_of(const CommonFields& common) {
    std::vector<std::string> names;
    for (const Field& field : common.fields) names.push_back(field.name);
    return names;
}

Cloud cloud_of(const std::vector<std::pair<std::string, FieldType>>& fields,
               const std::string& bytes) {
    Cloud cloud;
    for (const auto& [name, type] : fields) add_field(cloud, name, type);
    const auto raw = std::as_bytes(std::span(bytes));
    cloud.data.assign(raw.begin(), raw.end());
    return cloud;
}

/// Two points of a sensor with double coordinates and absolute times.
Cloud wide() {
    std::string bytes;
    for (const double i : {0.0, 1.0}) {
        bytes += bytes_of(i) + bytes_of(2.0) + bytes_of(3.0) + bytes_of(std::uint16_t{7}) +
                 bytes_of(100.0 + 0.05 * i) + bytes_of(5.0F + static_cast<float>(i));
    }
    return cloud_of({{"x", FieldType::f64},
                     {"y", FieldType::f64},
                     {"z", FieldType::f64},
                     {"ring", FieldType::u16},
                     {"timestamp", FieldType::f64},
                     {"intensity", FieldType::f32}},
                    bytes);
}

/// A point of a sensor without times.
Cloud plain() {
    return cloud_of({{"x", FieldType::f32},
                     {"y", FieldType::f32},
                     {"z", FieldType::f32},
                     {"intensity", FieldType::f32}},
                    floats({1, 2, 3, 0.5F}));
}

TEST(CommonFields, AreThoseOfAllSensorsWithTimesAndTheSensor) {
    const CommonFields common = common_fields({wide(), plain()}, true);
    EXPECT_EQ(names_of(common),
              (std::vector<std::string>{"x", "y", "z", "intensity", "t", "sensor"}));
    EXPECT_EQ(common.left_out, "ring");
    const Cloud cloud =
        in_common_fields(wide(), {1, 0}, common, Pose(Eigen::Translation3d(0, 0, -1)), 100.0, 3);
    ASSERT_EQ(cloud.size(), 2U);
    EXPECT_EQ(positions(cloud), (Points{{1, 2, 2}, {0, 2, 2}}));
    EXPECT_EQ(values(cloud, *cloud.find("intensity")), (std::vector<double>{6, 5}));
    EXPECT_EQ(values(cloud, *cloud.find("sensor")), (std::vector<double>{3, 3}));
    const auto times = values(cloud, *cloud.find("t"));
    EXPECT_NEAR(times[0], 0.05, 1e-6);
    EXPECT_NEAR(times[1], 0.0, 1e-6);
    const Cloud untimed = in_common_fields(plain(), {0}, common, Pose::Identity(), 0.0, 0);
    EXPECT_EQ(values(untimed, *untimed.find("t")), std::vector<double>{0.0});
}

TEST(CommonFields, PointsAtTheOriginStayNoMeasurements) {
    Cloud cloud = plain();
    std::memset(cloud.data.data(), 0, 12);
    const CommonFields common = common_fields({cloud, plain()}, false);
    const Cloud moved =
        in_common_fields(cloud, {0}, common, Pose(Eigen::Translation3d(1, 1, 1)), 0.0, 0);
    EXPECT_EQ(positions(moved), (Points{{0, 0, 0}}));
}

TEST(CommonFields, AFieldOfTheNameSensorStaysThatOfTheFiles) {
    const Cloud cloud = cloud_of({{"x", FieldType::f32},
                                  {"y", FieldType::f32},
                                  {"z", FieldType::f32},
                                  {"sensor", FieldType::u8}},
                                 floats({1, 2, 3}) + bytes_of(std::uint8_t{9}));
    const CommonFields common = common_fields({cloud, cloud}, false);
    EXPECT_FALSE(common.with_sensor);
    const Cloud same = in_common_fields(cloud, {0}, common, Pose::Identity(), 0.0, 1);
    EXPECT_EQ(values(same, *same.find("sensor")), std::vector<double>{9});
}

}  // namespace common_fields_test
}  // namespace dynamic_filter::io
