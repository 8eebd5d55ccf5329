// SPDX-License-Identifier: MIT
#include "run/data_json.hpp"

#include <gtest/gtest.h>

#include "dynamic_filter/error.hpp"

namespace dynamic_filter::app {
namespace data_json_test {

DataOptions unusual() {
    DataOptions options;
    options.poses = "/data/poses.tum";
    options.format = "folder";
    options.topic = "/points";
    options.pose_topic = "/odom";
    options.pose_fix = "camera";
    options.time_unit = "ms";
    options.points_in_world = true;
    options.deskew = "off";
    options.sensor_at = "1,0,2";
    options.point_unit = "cm";
    options.mask = "mask.txt";
    options.first = 5;
    options.last = 90;
    options.stride = 3;
    return options;
}

TEST(DataJson, GivesBackEveryOption) {
    for (const DataOptions& options : {DataOptions{}, unusual()}) {
        EXPECT_EQ(json_of(data_options_of(json_of(options))), json_of(options));
    }
    const nlohmann::ordered_json plain = json_of(DataOptions{}), other = json_of(unusual());
    for (const auto& [name, value] : other.items()) {
        EXPECT_TRUE(!plain.contains(name) || plain[name] != value) << name;
    }
}

TEST(DataJson, PathsAreFullButNoPosesIsNoPath) {
    DataOptions options;
    options.poses = "poses.txt";
    EXPECT_EQ(json_of(options)["poses"], full_path("poses.txt"));
    EXPECT_EQ(full_path("poses.txt").front(), '/');
    options.poses = kNoPoses;
    EXPECT_EQ(data_options_of(json_of(options)).poses, kNoPoses);
}

TEST(DataJson, ImpossibleValuesAreRefused) {
    nlohmann::ordered_json json = json_of(DataOptions{});
    json["pose_fix"] = "upside_down";
    EXPECT_THROW(data_options_of(json), ConfigError);
}

}  // namespace data_json_test
}  // namespace dynamic_filter::app
