// SPDX-License-Identifier: MIT
#include "arena/table.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

namespace dynamic_filter::app {
namespace arena_table_test {

TEST(ArenaTable, MeasuredRowsStandBeforeThePublishedOnesOfTheirEntry) {
    const std::string table = arena_markdown(
        arena_of("erasor"), {{"07", "ours", {0.9, 0.8, 0.8471}, {"poses of poses.txt"}}});
    const auto ours = table.find(
        "| 07 | ours | 90.00 | 80.00 | 0.847 | final verdicts | measured here; poses of");
    const auto paper =
        table.find("| 07 | DynamicFilter, in the paper | 87.94 | 86.80 | 0.874 | online |");
    EXPECT_NE(ours, std::string::npos) << table;
    EXPECT_NE(paper, std::string::npos) << table;
    EXPECT_LT(ours, paper);
    EXPECT_EQ(table.find("| 00 |"), std::string::npos);  // nobody measured it
}

TEST(ArenaTable, TheEntriesOfAGroupHaveAMeanBesideWhichThePublishedOnesStand) {
    std::vector<MeasuredFigure> figures = {{"station/sequence_1", "ours", {0.5, 0.6}, {"note"}},
                                           {"station/sequence_2", "ours", {0.7, std::nullopt}, {}},
                                           {"station/sequence_1", "theirs", {0.1, 0.2}, {}}};
    add_means_of_groups(arena_of("doals"), figures);
    ASSERT_EQ(figures.size(), 4U);  // of "theirs" one entry alone was measured
    EXPECT_EQ(figures[3].entry, "station");
    EXPECT_DOUBLE_EQ(*figures[3].scores[0], 0.6);
    EXPECT_DOUBLE_EQ(*figures[3].scores[1], 0.6);
    const std::string table = arena_markdown(arena_of("doals"), figures);
    EXPECT_NE(table.find("| station | Dynablox | 87.30 | 86.20 |"), std::string::npos) << table;
    EXPECT_EQ(table.find("| station/sequence_1 | Dynablox"), std::string::npos);
}

TEST(ArenaTable, JsonHasSharesAndTellsWhatWasMeasured) {
    const auto json = nlohmann::json::parse(arena_json(
        arena_of("moe"), {{"00", "ours", {std::nullopt}, {}}, {"05", "ours", {0.5}, {}}}));
    EXPECT_EQ(json["arena"], "moe");
    EXPECT_TRUE(json["rows"][0]["scores"]["IoU"].is_null());
    EXPECT_EQ(json["rows"][0]["measured"], true);
    EXPECT_EQ(json["rows"][1]["method"], "DOD");
    EXPECT_DOUBLE_EQ(json["rows"][1]["scores"]["IoU"], 0.786);
    EXPECT_EQ(json["rows"].back()["entry"], "05");
}

TEST(ArenaTable, WhatAnEarlierCallMeasuredIsReadBackWithoutMeans) {
    std::vector<MeasuredFigure> figures = {{"station/sequence_1", "ours", {0.5, 0.25}, {"note"}},
                                           {"station/sequence_2", "ours", {0.7, std::nullopt}, {}}};
    const std::vector<MeasuredFigure> measured = figures;
    add_means_of_groups(arena_of("doals"), figures);
    const auto read = measured_in(arena_of("doals"), arena_json(arena_of("doals"), figures));
    ASSERT_EQ(read.size(), 2U);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(read[i].entry, measured[i].entry);
        EXPECT_EQ(read[i].scores, measured[i].scores);
        EXPECT_EQ(read[i].notes, measured[i].notes);
    }
    EXPECT_TRUE(measured_in(arena_of("moe"), arena_json(arena_of("doals"), figures)).empty());
    EXPECT_TRUE(measured_in(arena_of("moe"), "{}").empty());
    EXPECT_TRUE(measured_in(arena_of("moe"), "no JSON").empty());
}

TEST(Arenas, PublishedFiguresAreOfEntriesThatTheyHave) {
    std::size_t figures = 0;
    for (const Arena& arena : arenas()) {
        std::set<std::string> groups;
        for (const std::string& entry : arena.entries) groups.insert(group_of_entry(entry));
        for (const std::string& group : groups) {
            for (const PublishedFigure& figure : published_figures(arena.name, group)) {
                EXPECT_EQ(figure.scores.size(), arena.columns.size());
                ++figures;
                for (const auto& score : figure.scores) {
                    const double share = score.value_or(0.5);
                    EXPECT_TRUE(share > 0.0 && share < 1.0) << figure.method;
                }
            }
        }
    }
    EXPECT_GT(figures, 90U);
}

}  // namespace arena_table_test
}  // namespace dynamic_filter::app
