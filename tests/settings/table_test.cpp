// SPDX-License-Identifier: MIT
#include "settings/table.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "dynamic_filter/error.hpp"

namespace dynamic_filter {
namespace table_test {

enum class Pace { slow, fast };

struct Robot {
    bool lights = false;
    int wheels = 4;
    double speed = 1.5;
    Pace pace = Pace::slow;
    std::string name = "r2", bus = "can";
};

template <class C, class F>
requires std::same_as<std::remove_const_t<C>, Robot>
void visit(C& r, F&& f) {
    f(Setting{"body.lights", "", "", "whether it shines"}, r.lights);
    f(Setting{"body.wheels", "1", "", "how many", 0, 1e6}, r.wheels);
    f(Setting{"drive.speed", "m/s", "", "at most", 0.5, 2}, r.speed);
    f(Setting{"drive.pace", "", "", "how", 0, 0, kAllMethods, "slow fast"}, r.pace);
    f(Setting{"body.name", "", "", "what it is called"}, r.name);
    f(Setting{"body.bus", "", "", "of the motors", 0, 0, kAllMethods, "can spi"}, r.bus);
}

std::string error_of(std::string_view key, std::string_view text) {
    Robot robot;
    try {
        settings::assign(robot, key, text, "the manual");
    } catch (const ConfigError& error) {
        return error.what();
    }
    return "";
}

TEST(Table, MembersOfAllKindsAreRead) {
    Robot robot;
    for (const auto& [key, text] : {std::pair{"body.lights", "true"},
                                    {"body.wheels", "6"},
                                    {"drive.speed", "2"},
                                    {"drive.pace", "fast"},
                                    {"body.name", "any = \"text\""},
                                    {"body.bus", "spi"}}) {
        settings::assign(robot, key, text);
        EXPECT_EQ(settings::value_of(robot, key), text == std::string("2") ? "2.0" : text);
    }
    EXPECT_TRUE(robot.lights);
    EXPECT_EQ(robot.wheels, 6);
    EXPECT_EQ(robot.speed, 2.0);
    EXPECT_EQ(robot.pace, Pace::fast);
    EXPECT_EQ(robot.name, "any = \"text\"");
    EXPECT_EQ(robot.bus, "spi");
}

TEST(Table, WhatIsWrongIsSaidInOneWay) {
    EXPECT_EQ(error_of("body.lights", "on"),
              "setting 'body.lights': 'on' is not one of false, true");
    EXPECT_EQ(error_of("body.wheels", "-1"),
              "setting 'body.wheels': '-1' is not a whole number from 0 to 1000000");
    EXPECT_EQ(error_of("drive.speed", "2.5"),
              "setting 'drive.speed': '2.5' is not a number from 0.5 to 2 m/s");
    EXPECT_EQ(error_of("drive.speed", "nan"),
              "setting 'drive.speed': 'nan' is not a number from 0.5 to 2 m/s");
    EXPECT_EQ(error_of("drive.pace", ""), "setting 'drive.pace': '' is not one of slow, fast");
    EXPECT_EQ(error_of("body.bus", "i2c"), "setting 'body.bus': 'i2c' is not one of can, spi");
    EXPECT_EQ(error_of("sped", "1"), "unknown setting 'sped'; did you mean 'drive.speed'?");
    EXPECT_EQ(error_of("body", "1"), "'body' is a section: name a setting in it");
    EXPECT_EQ(error_of("entirely.else", "1"), "unknown setting 'entirely.else'; see the manual");
}

TEST(Table, OnlyNumbersHaveBounds) {
    Robot robot;
    robot.speed = std::nan("");
    robot.wheels = -2;
    std::vector<std::string> found;
    for (const settings::Row& row : settings::rows_of(robot)) {
        if (const auto fault = settings::out_of_bounds(row)) found.push_back(*fault);
    }
    EXPECT_EQ(found, (std::vector<std::string>{"body.wheels = -2 is outside 0.0 .. 1e+06",
                                               "drive.speed = nan is outside 0.5 .. 2.0"}));
}

/// The filter's table has a method; others have none.
TEST(Table, WithoutAMethodAllIsInForce) {
    const auto rows = settings::rows_of(Robot{});
    for (const settings::Row& row : rows) EXPECT_TRUE(settings::in_force(rows, row.setting));
    EXPECT_NO_THROW(settings::require_in_force(rows, "drive.pace"));
    EXPECT_THROW(settings::require_in_force(rows, "drive.price"), ConfigError);
}

}  // namespace table_test
}  // namespace dynamic_filter
