// SPDX-License-Identifier: MIT
#include "live/ros2_arguments.hpp"

#include <gtest/gtest.h>

#include "dynamic_filter/error.hpp"
#include "live/live_config.hpp"
#include "support/temporary_folder.hpp"

namespace dynamic_filter::live {
namespace ros2_arguments_test {

using dynamic_filter::test::spill;
using dynamic_filter::test::TemporaryFolder;

LiveConfig config_of(const std::vector<std::string>& words) {
    return load_live_config({}, ros2_parameters(words));
}

std::string error_of(const std::vector<std::string>& words) {
    try {
        config_of(words);
    } catch (const ConfigError& error) {
        return error.what();
    }
    return "";
}

TEST(Ros2Arguments, ParametersAreSettings) {
    const LiveConfig config =
        config_of({"-p", "input.cloud:=/ouster/points", "--param", "input.deskew:=True", "-p",
                   "output.map_frame:=\"true\"", "-p", "map.voxel_size:=0.1"});
    EXPECT_EQ(config.input.cloud, "/ouster/points");
    EXPECT_TRUE(config.input.deskew);
    EXPECT_EQ(config.output.map_frame, "true") << "what stands in quotes is a text";
    EXPECT_EQ(config.filter.map.voxel_size, 0.1);
}

TEST(Ros2Arguments, TheNameOfTheNodeIsThePrefix) {
    EXPECT_EQ(config_of({}).output.prefix, "/dynamicfilter");
    EXPECT_EQ(config_of({"-r", "__ns:=/front", "-r", "__node:=clean"}).output.prefix,
              "/front/clean");
    EXPECT_EQ(config_of({"--remap", "dynamicfilter:__ns:=/front"}).output.prefix,
              "/front/dynamicfilter");
    EXPECT_EQ(config_of({"-r", "__ns:=/front", "-p", "output.prefix:=/mine"}).output.prefix,
              "/mine");
}

TEST(Ros2Arguments, AFileHoldsParametersOfManyNodes) {
    const TemporaryFolder folder;
    spill(folder / "robot.yaml", R"(
/**:
  ros__parameters:
    use_sim_time: true
    input:
      queue: 3
      wait: 0.5
dynamicfilter:
  ros__parameters:
    input.wait: 0.4
front:
  dynamicfilter:
    ros__parameters: {input.cloud: /front/points}
/rear/dynamicfilter:
  ros__parameters: {input.cloud: /rear/points}
driver:
  ros__parameters: {rpm: 600}
)");
    const std::string file = (folder / "robot.yaml").string();
    const LiveConfig alone = config_of({"--params-file", file});
    EXPECT_EQ(alone.input.queue, 3);
    EXPECT_EQ(alone.input.wait, 0.4) << "later lines win";
    EXPECT_EQ(alone.input.cloud, "") << "of nodes in other namespaces";
    EXPECT_EQ(config_of({"--params-file", file, "-r", "__ns:=/front"}).input.cloud,
              "/front/points");
    EXPECT_EQ(config_of({"-r", "__ns:=/rear", "--params-file", file}).input.cloud, "/rear/points");
    EXPECT_EQ(config_of({"-p", "input.queue:=4", "--params-file", file}).input.queue, 4)
        << "-p wins over files, wherever it stands";
}

TEST(Ros2Arguments, NamesOfNodesHaveWildcards) {
    const TemporaryFolder folder;
    const auto cloud_of = [&](const std::string& pattern, const std::string& space) {
        spill(folder / "robot.yaml", pattern + ":\n  ros__parameters: {input.cloud: /points}\n");
        return config_of(
                   {"--params-file", (folder / "robot.yaml").string(), "-r", "__ns:=" + space})
            .input.cloud;
    };
    for (const char* pattern :
         {"/**", "/*", "/dynamicfilter", "dynamicfilter", "/**/dynamicfilter"}) {
        EXPECT_EQ(cloud_of(pattern, "/"), "/points") << pattern;
    }
    for (const char* pattern : {"/front/*", "/front/**", "/*/dynamicfilter", "/*/*", "/**/*"}) {
        EXPECT_EQ(cloud_of(pattern, "/front"), "/points") << pattern;
    }
    for (const char* pattern : {"/*", "/rear/**", "/dynamicfilter", "/front", "/front/*/*"}) {
        EXPECT_EQ(cloud_of(pattern, "/front"), "") << pattern;
    }
}

TEST(Ros2Arguments, RulesForOtherNodesHaveNoEffect) {
    const LiveConfig config = config_of({"-r", "camera:__node:=cam", "-p", "camera:input.cloud:=/a",
                                         "-p", "dynamicfilter:input.pose:=/odom"});
    EXPECT_EQ(config.output.prefix, "/dynamicfilter");
    EXPECT_EQ(config.input.cloud, "");
    EXPECT_EQ(config.input.pose, "/odom");
}

TEST(Ros2Arguments, NothingIsAnEmptyText) {
    EXPECT_EQ(config_of({"-p", "input.cloud:="}).input.cloud, "");
}

TEST(Ros2Arguments, WhatConcernsOnlyTheLibraryOfRosHasNoEffect) {
    EXPECT_EQ(error_of({"--log-level", "debug", "--disable-rosout-logs", "-e", "/enclave", "-p",
                        "use_sim_time:=true", "-p", "qos_overrides./tf.depth:=5"}),
              "");
}

TEST(Ros2Arguments, MistakesAreNamedWithTheirPlace) {
    const TemporaryFolder folder;
    const auto error_of_file = [&](const char* text) {
        spill(folder / "robot.yaml", text);
        return error_of({"--params-file", (folder / "robot.yaml").string()});
    };
    const std::vector<std::pair<std::string, std::string>> cases = {
        {error_of({"-p", "input.clod:=/points"}), "'input.cloud'"},
        {error_of({"-p", "input.cloud=/points"}), "NAME:=VALUE"},
        {error_of({"-p"}), "nothing follows '-p'"},
        {error_of({"-p", "input.cloud:=[/a, /b]"}), "is a list"},
        {error_of({"-r", "points:=/ouster/points"}), "input.cloud"},
        {error_of({"--what"}), "unknown argument '--what'"},
        {error_of({"--params-file", (folder / "none.yaml").string()}), "no such file"},
        {error_of_file("input:\n  cloud: /points\n"), "robot.yaml, line 2: 'cloud' stands outside"},
        {error_of_file("/**:\n  ros__parameters:\n    input.queue: 0\n"), "robot.yaml: line 3"},
        {error_of_file("/**:\n  ros__parameters: [\n"), "robot.yaml, line 3"},
        {error_of_file("/**:\n  ros__parameters:\n    input.cloud: [/a]\n"), "line 3: is a list"},
        {error_of_file("- a\n"), "line 1: is no table"},
        {error_of_file("/**:\n  ros__parameters: [a]\n"), "line 2: is no table"},
        {error_of_file("/**:\n  ros__parameters: &a\n    b: *a\n"), "line"},
        {error_of_file("a: &a\n  b: *a\n"), "stands outside"},
    };
    for (const auto& [error, part] : cases) {
        EXPECT_NE(error.find(part), std::string::npos) << part << "\n" << error;
    }
}

}  // namespace ros2_arguments_test
}  // namespace dynamic_filter::live
