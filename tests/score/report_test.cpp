// SPDX-License-Identifier: MIT
#include "score/report.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace dynamic_filter::app {
namespace report_test {

eval::Scores some_scores() {
    eval::Scores scores;
    scores.voxel["excluded"] = eval::voxel_score(100, 95, 50, 2);
    scores.voxel["majority"] = eval::voxel_score(100, 95, 0, 0);
    scores.point.sa = 0.5;
    scores.dynamic_share = 0.25;
    return scores;
}

TEST(Report, JsonHoldsFractionsAndNullWhereUndefined) {
    const auto json = to_json(some_scores());
    EXPECT_DOUBLE_EQ(json["voxel"]["excluded"]["pr"], 0.95);
    EXPECT_DOUBLE_EQ(json["voxel"]["excluded"]["rr"], 0.96);
    EXPECT_TRUE(json["voxel"]["majority"]["f1"].is_null());
    EXPECT_DOUBLE_EQ(json["point"]["sa"], 0.5);
    EXPECT_TRUE(json["point"]["da"].is_null());
    EXPECT_TRUE(json["point"]["iou"].is_null());
}

TEST(Report, TableIsGolden) {
    EXPECT_EQ(table(some_scores()),
              "  mixed voxels              PR [%]  RR [%]     F1\n"
              "  excluded                   95.00   96.00  0.955\n"
              "  majority                   95.00       -      -\n"
              "  points: SA 50.00  DA -  AA -  HA -  moving IoU -\n");
}

TEST(Report, TheShiftedGridHasRowsAndAKeyOfItsOwn) {
    eval::Scores both = some_scores();
    EXPECT_FALSE(to_json(both).contains("voxel_shifted"));
    both.voxel_shifted["excluded"] = eval::voxel_score(100, 90, 50, 4);
    EXPECT_DOUBLE_EQ(to_json(both)["voxel_shifted"]["excluded"]["pr"], 0.9);
    EXPECT_NE(table(both).find("\n  excluded, shifted          90.00   92.00  0.910\n"),
              std::string::npos);
}

TEST(Report, StageTimesAreMillisecondsByRank) {
    StageTimes times;
    for (int i = 100; i >= 1; --i) times["work"].add(1e-3 * i);
    const auto json = to_json(times)["work"];
    EXPECT_EQ(json["count"], 100);
    EXPECT_NEAR(json["mean"], 50.5, 1e-9);
    EXPECT_NEAR(json["p50"], 50.0, 1e-9);
    EXPECT_NEAR(json["p95"], 95.0, 1e-9);
    EXPECT_NEAR(json["p99"], 99.0, 1e-9);
    EXPECT_NEAR(json["max"], 100.0, 1e-9);
}

}  // namespace report_test
}  // namespace dynamic_filter::app
