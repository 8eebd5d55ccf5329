// SPDX-License-Identifier: MIT
#include "recording/data_options.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "support/bytes.hpp"

namespace dynamic_filter::app {
namespace data_options_test {

TEST(DataOptions, EachRowHasANameOfItsOwnAndHelp) {
    std::set<std::string> names, selecting;
    visit_reading(static_cast<const DataOptions&>(DataOptions{}),
                  [&](const ReadingOption& option, const auto&) {
                      EXPECT_TRUE(names.insert(option.name).second) << option.name;
                      EXPECT_NE(std::string(option.help), "");
                      if (option.selects) selecting.insert(option.name);
                  });
    EXPECT_EQ(names.size(), 14U);
    EXPECT_EQ(selecting, (std::set<std::string>{"first", "last", "stride"}));
}

TEST(DataOptions, WhatAnOptionIsByDefaultIsPossible) {
    EXPECT_NO_THROW(refuse_invalid({}, Asker::command));
}

std::string fault(const DataOptions& options, Asker asker) {
    return io::error_of<ConfigError>([&] { refuse_invalid(options, asker); });
}

TEST(DataOptions, FaultsAreNamedAsTheAskerTypesThem) {
    DataOptions options;
    options.pose_fix = "upside-down";
    EXPECT_HAS(fault(options, Asker::command), "--pose-fix: 'upside-down' is none of none, ");
    EXPECT_HAS(fault(options, Asker::python), "pose_fix: 'upside-down' is none of none, ");
    options = {};
    options.stride = 0;
    EXPECT_HAS(fault(options, Asker::command), "--stride: 0 is no whole number of 1 or more");
    EXPECT_EQ(fault(options, Asker::python).find("--"), std::string::npos);
    options = {};
    options.format = "kity";
    for (const std::string& name : io::layout_names()) {
        EXPECT_HAS(fault(options, Asker::python), name);
    }
}

TEST(DataOptions, APlaceIsThreeNumbersWithCommas) {
    EXPECT_EQ(place_of("0.9,-1,1.6"), Eigen::Vector3d(0.9, -1, 1.6));
    EXPECT_EQ(place_of("1, 2, 3"), Eigen::Vector3d(1, 2, 3));
    for (const char* text : {"", "1,2", "1,2,3,4", "1,2,nan", "1;2;3", "1,2,3m"}) {
        EXPECT_FALSE(place_of(text)) << text;
    }
    DataOptions options;
    options.sensor_at = "1,2";
    EXPECT_HAS(fault(options, Asker::command), "--sensor-at: '1,2' is no place; expected X,Y,Z");
}

}  // namespace data_options_test
}  // namespace dynamic_filter::app
