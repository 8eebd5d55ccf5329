// SPDX-License-Identifier: MIT
#include "score/protocols.hpp"

#include <gtest/gtest.h>

namespace dynamic_filter::app {
namespace protocols_test {

eval::Scores scores() {
    eval::Scores s;
    s.voxel["excluded"] = {0.91, 0.81, 0.85};
    s.voxel["erasor"] = {0.92, 0.82, 0.86};
    s.voxel["static_wins"] = {0.93, 0.83, 0.87};
    s.point = {0.94, 0.84, 0.88, 0.89, 0.77};
    return s;
}

bool says(const std::string& protocol, const std::string& text) {
    return protocol_table(protocol, scores(), 0.1).find(text) != std::string::npos;
}

TEST(Protocols, EachPrintsItsScoresOnly) {
    EXPECT_TRUE(says("voxel", "PR 91.00 %  RR 81.00 %  F1 0.850"));
    EXPECT_TRUE(says("erasor", "PR 92.00 %  RR 82.00 %  F1 0.860"));
    EXPECT_TRUE(says("strict", "PR 93.00 %  RR 83.00 %  F1 0.870"));
    EXPECT_TRUE(says("benchmark", "SA 94.00 %  DA 84.00 %  AA 88.00 %  HA 89.00 %"));
    EXPECT_TRUE(says("mos", "moving IoU 77.00 %"));
    EXPECT_FALSE(says("mos", "F1"));
    EXPECT_FALSE(says("voxel", "0.860"));
}

TEST(Protocols, OnlyThatOfTheProjectPrintsTheShiftedGrid) {
    eval::Scores both = scores();
    both.voxel_shifted["excluded"] = {0.61, 0.51, 0.55};
    both.voxel_shifted["static_wins"] = {0.62, 0.52, 0.56};
    EXPECT_NE(
        protocol_table("voxel", both, 0.2)
            .find("\nPR 61.00 %  RR 51.00 %  F1 0.550  on the grid shifted by half a voxel\n"),
        std::string::npos);
    EXPECT_EQ(protocol_table("strict", both, 0.2), protocol_table("strict", scores(), 0.2));
    EXPECT_FALSE(says("voxel", "shifted"));
}

TEST(Protocols, RulesNameTheVoxelsThatWereCounted) {
    EXPECT_TRUE(says("voxel", "voxels of 0.1 m"));
    EXPECT_TRUE(says("erasor", "within 0.087 m"));  // half the diagonal
}

TEST(Protocols, AllPrintsEveryReading) {
    for (const char* text : {"excluded", "erasor", "static_wins", "moving IoU"}) {
        EXPECT_TRUE(says("all", text)) << text;
    }
}

TEST(Protocols, NamesAreThoseThatAreTaken) {
    for (const std::string& name : protocol_names()) {
        EXPECT_EQ(protocol_table(name, scores(), 0.2).empty(), false) << name;
    }
    EXPECT_EQ(protocol_names().front(), "all");
}

}  // namespace protocols_test
}  // namespace dynamic_filter::app
