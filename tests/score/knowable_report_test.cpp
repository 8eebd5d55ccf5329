// SPDX-License-Identifier: MIT
#include "score/knowable_report.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace dynamic_filter::app {
namespace knowable_report_test {

eval::KnowableScores some_knowable() {
    eval::KnowableScores scores;
    scores.groups.resize(eval::knowable_groups().size());
    scores.groups[0] = {.points = 1000, .removed_points = 900, .voxels = 80, .removed_voxels = 60};
    scores.bins[5] = {.points = 10, .removed_points = 10, .voxels = 4, .removed_voxels = 3};
    return scores;
}

TEST(KnowableReport, JsonHoldsNumbersAndSharesAndNullWhereUndefined) {
    const auto json = to_json(some_knowable());
    EXPECT_EQ(json["groups"]["all"]["points"], 1000);
    EXPECT_DOUBLE_EQ(json["groups"]["all"]["points_removed"], 0.9);
    EXPECT_EQ(json["groups"]["all"]["voxels"], 80);
    EXPECT_DOUBLE_EQ(json["groups"]["all"]["rr"], 0.75);
    EXPECT_TRUE(json["groups"]["never"]["rr"].is_null());
    ASSERT_EQ(json["bins"].size(), 6U);
    EXPECT_EQ(json["bins"][1]["from"], 1);
    EXPECT_EQ(json["bins"][1]["to"], 2);
    EXPECT_TRUE(json["bins"][1]["points_removed"].is_null());
    EXPECT_EQ(json["bins"][5]["from"], 100);
    EXPECT_TRUE(json["bins"][5]["to"].is_null());
    EXPECT_DOUBLE_EQ(json["bins"][5]["rr"], 0.75);
}

TEST(KnowableReport, TableIsGolden) {
    EXPECT_EQ(table(some_knowable()),
              "  what is dynamic                  points removed [%]    voxels  RR [%]\n"
              "  all                                1000       90.00        80   75.00\n"
              "  passed by 1 beam or more              0           -         0       -\n"
              "  passed by 3 or more                   0           -         0       -\n"
              "  passed by 10 or more                  0           -         0       -\n"
              "  moves                                 0           -         0       -\n"
              "  rests, was seen to move               0           -         0       -\n"
              "  rests, will be seen to move           0           -         0       -\n"
              "  rests, is never seen to move          0           -         0       -\n"
              "  knowable                              0           -         0       -\n");
}

}  // namespace knowable_report_test
}  // namespace dynamic_filter::app
