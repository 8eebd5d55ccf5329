// SPDX-License-Identifier: MIT
#include "upkeep/changes_page.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace dynamic_filter::app {
namespace changes_page_test {

ChangesOfMap sample() {
    Change car;
    car.box.extend(Eigen::Vector3d(1.0, 2.0, 0.0)).extend(Eigen::Vector3d(5.0, 4.0, 1.5));
    car.collected.resize(700);
    car.scans = 12;
    car.first = 3.5;
    car.last = 9.0;
    ChangesOfMap changes;
    changes.went = {car, car};
    changes.came = {car};
    changes.voxels.at_both = 100;
    changes.voxels.old_only = 20;
    changes.voxels.new_only = 3;
    return changes;
}

TEST(ChangesPage, TablesSayTheSame) {
    const std::string csv = changes_csv(sample());
    EXPECT_NE(csv.find("went,2,3.000,3.000,0.750,4.00,2.00,1.50,700,12,3.500,9.000\n"),
              std::string::npos);
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 4);
    const auto json = nlohmann::json::parse(changes_json(sample()));
    EXPECT_EQ(json["went"], 2);
    EXPECT_EQ(json["voxels"]["old_only"], 20);
    EXPECT_EQ(json["changes"][2]["change"], "came");
    EXPECT_EQ(json["changes"][2]["size"], nlohmann::json({4.0, 2.0, 1.5}));
    const std::string page = changes_page(sample());
    EXPECT_NE(page.find("2 went, 1 came"), std::string::npos);
    EXPECT_NE(page.find("<td>came<td>1<td>3.0, 3.0, 0.8"), std::string::npos);
}

TEST(ChangesPage, WhatChangedIsDrawnAboveAllElse) {
    const Points kept = {{0.0F, 0.0F, 0.0F}, {16.0F, 12.0F, 5.0F}, {8.0F, 6.0F, 5.0F}};
    Eigen::AlignedBox3f box;
    for (const Point& point : kept) box.extend(point);
    const io::Image image = date_from_above(kept, {{8.0F, 6.0F, 0.0F}}, box, kCameColor);
    const bool is_green =
        std::any_of(image.pixels.begin(), image.pixels.end(),
                    [](const io::Color& c) { return c[0] < 100 && c[1] > 80 && c[2] < 100; });
    EXPECT_TRUE(is_green);
}

}  // namespace changes_page_test
}  // namespace dynamic_filter::app
