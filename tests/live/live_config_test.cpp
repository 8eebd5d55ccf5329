// SPDX-License-Identifier: MIT
#include "live/live_config.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

#include "dynamic_filter/error.hpp"
#include "support/temporary_folder.hpp"

namespace dynamic_filter::live {
namespace live_config_test {

using test::spill;
using test::TemporaryFolder;

std::string error_of(const app::ConfigOptions& options,
                     const std::vector<app::Assignment>& parameters = {}) {
    try {
        load_live_config(options, parameters);
    } catch (const ConfigError& error) {
        return error.what();
    }
    return "";
}

TEST(LiveConfig, SeveralSensorsNeedPosesAndEachItsOwnTopic) {
    LiveConfig config;
    config.input.cloud = " /front  /rear ";
    EXPECT_EQ(cloud_topics(config), (std::vector<std::string>{"/front", "/rear"}));
    EXPECT_NO_THROW(validate(config));
    config.input.pose = "none";
    EXPECT_THROW(validate(config), ConfigError);
    config.input.pose = "";
    config.input.mask = "boxes.txt";
    EXPECT_THROW(validate(config), ConfigError);
    config.input.mask = "";
    config.input.cloud = "/front /front";
    EXPECT_THROW(validate(config), ConfigError);
}

TEST(LiveConfig, WhatIsPrintedIsReadBackEqual) {
    const TemporaryFolder folder;
    app::ConfigOptions options;
    options.assignments = {"input.cloud=/os/points", "input.wait=0.35", "output.map_rate=2.5",
                           "foxglove.serve=true", "limits.threads=3"};
    const LiveConfig config = load_live_config(options, {});
    spill(folder / "live.toml", to_toml(config));
    app::ConfigOptions from_file;
    from_file.file = folder / "live.toml";
    const LiveConfig read = load_live_config(from_file, {});
    EXPECT_EQ(to_toml(read), to_toml(config));
    EXPECT_EQ(read.input.cloud, "/os/points");
    EXPECT_EQ(read.input.wait, 0.35);
    EXPECT_TRUE(read.foxglove.serve);
}

TEST(LiveConfig, OneFileHoldsTheSettingsOfTheFilterToo) {
    const TemporaryFolder folder;
    spill(folder / "robot.toml", "[input]\ncloud = \"/points\"\n[map]\nvoxel_size = 0.1\n");
    app::ConfigOptions options;
    options.file = folder / "robot.toml";
    const LiveConfig config = load_live_config(options, {});
    EXPECT_EQ(config.input.cloud, "/points");
    EXPECT_EQ(config.filter.map.voxel_size, 0.1);
}

TEST(LiveConfig, TextsWithQuotesAreReadBackEqual) {
    const TemporaryFolder folder;
    LiveConfig config;
    config.output.map_frame = "a \"map\" \\ of mine";
    spill(folder / "live.toml", to_toml(config));
    app::ConfigOptions options;
    options.file = folder / "live.toml";
    EXPECT_EQ(load_live_config(options, {}).output.map_frame, config.output.map_frame);
}

TEST(LiveConfig, LaterSourcesWin) {
    const TemporaryFolder folder;
    spill(folder / "robot.toml", "[input]\nwait = 0.5\nqueue = 4\n");
    app::ConfigOptions options;
    options.file = folder / "robot.toml";
    options.assignments = {"input.queue=5"};
    const LiveConfig config =
        load_live_config(options, {{"input.wait", "1", "here"}, {"input.silence", "7", "there"}});
    EXPECT_EQ(config.input.silence, 7.0) << "a parameter of ROS";
    EXPECT_EQ(config.input.wait, 0.5) << "the file";
    EXPECT_EQ(config.input.queue, 5) << "the assignment";
}

TEST(LiveConfig, AllMistakesAreNamedAtOnce) {
    const TemporaryFolder folder;
    spill(folder / "robot.toml", "[input]\nclod = \"/points\"\n[output]\nqos = \"best\"\n");
    app::ConfigOptions options;
    options.file = folder / "robot.toml";
    options.assignments = {"input.queue=0", "map.voxel_sise=1", "nonsense"};
    const std::string error = error_of(options, {{"bus.domain", "300", "parameter bus.domain"}});
    for (const char* part :
         {"parameter bus.domain", "whole number from 0 to 232", "line 2", "'input.cloud'?",
          "line 4", "one of reliable, best_effort", "--set input.queue=0", "'map.voxel_size'?",
          "--set nonsense: expected section.key=value"}) {
        EXPECT_NE(error.find(part), std::string::npos) << part << "\n" << error;
    }
}

TEST(LiveConfig, SettingsWithoutEffectAreRefused) {
    app::ConfigOptions options;
    options.preset = "paper";
    options.assignments = {"scans.max_keyframes=10"};
    EXPECT_NE(error_of(options).find("no effect"), std::string::npos);
}

TEST(LiveConfig, PrefixesAreNamesOfTopics) {
    app::ConfigOptions options;
    for (const char* wrong : {"output.prefix=filter", "output.prefix=/filter/", "output.prefix="}) {
        options.assignments = {wrong};
        EXPECT_NE(error_of(options).find("output.prefix"), std::string::npos) << wrong;
    }
}

TEST(LiveConfig, TheDomainComesFromTheEnvironment) {
    ::setenv("ROS_DOMAIN_ID", "42", 1);
    EXPECT_EQ(load_live_config({}, {}).bus.domain, 42);
    ::setenv("ROS_DOMAIN_ID", "many", 1);
    EXPECT_NE(error_of({}).find("ROS_DOMAIN_ID"), std::string::npos);
    ::unsetenv("ROS_DOMAIN_ID");
}

TEST(LiveConfig, OnlySomeSettingsChangeWhileRunning) {
    LiveConfig config;
    change(config, "output.map_rate", "5");
    EXPECT_EQ(config.output.map_rate, 5.0);
    EXPECT_THROW(change(config, "input.cloud", "/other"), ConfigError);
    EXPECT_THROW(change(config, "output.map_rate", "fast"), ConfigError);
    EXPECT_EQ(config.output.map_rate, 5.0) << "a wrong value leaves the old one";
}

}  // namespace live_config_test
}  // namespace dynamic_filter::live
