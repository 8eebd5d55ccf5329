// SPDX-License-Identifier: MIT
#include "settings/config_file.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "dynamic_filter/error.hpp"
#include "support/temporary_folder.hpp"

namespace dynamic_filter::app {
namespace config_file_test {

using test::spill;
using test::TemporaryFolder;

std::string error_of(const std::string& toml) {
    const TemporaryFolder folder;
    spill(folder / "c.toml", toml);
    try {
        load_config({.file = folder / "c.toml"});
    } catch (const ConfigError& error) {
        return error.what();
    }
    return "";
}

TEST(ConfigFile, WhatIsPrintedIsReadBackEqual) {
    Config config = preset("paper");
    set(config, "front_end.reverting", "none");
    set(config, "map.voxel_size", "0.123");
    set(config, "back_end.incident_correction", "false");
    set(config, "submap.keyframes", "7");
    const TemporaryFolder folder;
    spill(folder / "c.toml", to_toml(config));
    const Config read = load_config({.file = folder / "c.toml"});
    EXPECT_EQ(to_toml(read), to_toml(config));
    EXPECT_NE(to_toml(read), to_toml(Config{}));
}

TEST(ConfigFile, NamesFileLineAndNearestKey) {
    const std::string error = error_of("[map]\nvoxel_size = 0.1\nvoxle_size = 0.2\n");
    EXPECT_NE(error.find("c.toml"), std::string::npos) << error;
    EXPECT_NE(error.find("line 3"), std::string::npos) << error;
    EXPECT_NE(error.find("'map.voxel_size'"), std::string::npos) << error;
}

TEST(ConfigFile, ReportsAllWrongLinesAtOnce) {
    const std::string error = error_of("[submap]\nkeyframes = 2.5\n[front_end]\ntau = \"wide\"\n");
    EXPECT_NE(error.find("line 2"), std::string::npos) << error;
    EXPECT_NE(error.find("line 4"), std::string::npos) << error;
}

TEST(ConfigFile, RejectsWhatIsNotToml) {
    EXPECT_NE(error_of("[back_end\n").find("not TOML"), std::string::npos);
    EXPECT_NE(error_of("a = 1\na = 2\n").find("line 2"), std::string::npos);
    EXPECT_NE(error_of("back_end = 3\n").find("is a section"), std::string::npos);
}

/// What docs/parameters.md is made of.
TEST(ConfigFile, JsonHoldsEverySettingWithItsBounds) {
    const auto settings = nlohmann::json::parse(to_json(preset("paper")));
    const Config config = preset("paper");
    std::size_t i = 0;
    visit(config, [&](const Setting& setting, const auto& member) {
        if (!in_force(config, setting)) return;
        const nlohmann::json& entry = settings.at(i++);
        EXPECT_EQ(entry.at("key"), setting.key);
        EXPECT_EQ(entry.at("help"), setting.help);
        if constexpr (std::is_arithmetic_v<std::decay_t<decltype(member)>>) {
            EXPECT_EQ(entry.at("value"), member);
        } else {
            EXPECT_EQ(entry.at("value"), get(config, setting.key));
        }
        EXPECT_EQ(entry.contains("min"), setting.max > 0.0);
        EXPECT_EQ(entry.value("max", 0.0), setting.max);
    });
    EXPECT_EQ(settings.size(), i);
}

/// Deeper than any stack; and as deep as is let through.
TEST(ConfigFile, NestingWithoutEndIsAnError) {
    const auto times = [](int count, const std::string& text) {
        std::string all;
        for (int i = 0; i < count; ++i) all += text;
        return all;
    };
    for (const int depth : {999, 100000}) {
        const std::string name = "a" + times(depth, ".a");
        for (const std::string& toml :
             {name + " = 1\n", "[" + name + "]\nb = 1\n", "[[" + name + "]]\n",
              "a = " + times(depth, "["), "a = " + times(depth, "{a = ")}) {
            EXPECT_NE(error_of(toml), "") << depth << " " << toml.substr(0, 10);
        }
    }
}

TEST(LoadConfig, AppliesPresetFileThenAssignmentsAndChecksBounds) {
    const TemporaryFolder folder;
    spill(folder / "c.toml", "[map]\nvoxel_size = 0.1\n[back_end]\ndepth_channel = 0.3\n");
    ConfigOptions options{"paper", folder / "c.toml", {"map.voxel_size=0.4"}};
    const Config config = load_config(options);
    EXPECT_EQ(config.map.voxel_size, 0.4);
    EXPECT_EQ(config.back_end.depth_channel, 0.3);
    options.assignments = {"map.voxel_size"};
    EXPECT_THROW(load_config(options), ConfigError);
    options.assignments = {"map.voxel_size=-1"};
    EXPECT_THROW(load_config(options), ConfigError);
    options.assignments = {"method=scans"};  // so the file's depth_channel has no effect
    try {
        load_config(options);
        ADD_FAILURE();
    } catch (const ConfigError& error) {
        const std::string said = error.what();
        for (const char* part : {"c.toml: line 4", "'back_end.depth_channel'", "'submaps'"}) {
            EXPECT_NE(said.find(part), std::string::npos) << said;
        }
    }
    options = {"best", std::nullopt, {}};
    EXPECT_THROW(load_config(options), ConfigError);
    options = {"paper", folder / "missing.toml", {}};
    EXPECT_THROW(load_config(options), ConfigError);
}

TEST(LoadConfig, NamesTheMistakesOfAllSourcesAtOnce) {
    const TemporaryFolder folder;
    spill(folder / "c.toml", "[map]\nvoxel_size = 9\n");
    ConfigOptions options;
    options.file = folder / "c.toml";
    options.assignments = {"map.tim=latest", "nonsense", "keyframe.interval=-1",
                           "submap.keyframes=5"};
    try {
        load_config(options);
        ADD_FAILURE();
    } catch (const ConfigError& error) {
        const std::string said = error.what();
        for (const char* part :
             {"c.toml: line 2: setting 'map.voxel_size': '9' is not a number from 0.02 to 5 m",
              "--set map.tim=latest: unknown setting 'map.tim'; did you mean 'map.time'?",
              "--set nonsense: expected section.key=value",
              "--set keyframe.interval=-1: setting 'keyframe.interval': '-1' is not a number from "
              "0 "
              "to 3600 s",
              "--set submap.keyframes=5: setting 'submap.keyframes' belongs to the method "
              "'submaps'"}) {
            EXPECT_NE(said.find(part), std::string::npos) << part << "\n" << said;
        }
    }
}

}  // namespace config_file_test
}  // namespace dynamic_filter::app
