// SPDX-License-Identifier: MIT
// Corrections by hand: what edits.json may hold, and what becomes of points.
#include "run/edits.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <random>

#include "commands/edit_server.hpp"
#include "dynamic_filter/error.hpp"
#include "run/apply_edits.hpp"
#include "run/edit_lookup.hpp"
#include "run/map_gaps.hpp"
#include "support/temporary_folder.hpp"

namespace dynamic_filter::app {
namespace edits_test {

constexpr std::size_t kFromStatic = 1, kFromDynamic = 2;

Edit edit(Label label, std::size_t from, std::vector<CellRun> runs) {
    Edit result{.label = label, .cells = {}, .scans = {}, .how = "click"};
    result.cells[from] = std::move(runs);
    return result;
}

Edits some() {
    Edits edits{0.2, {}};
    edits.edits.push_back(edit(Label::static_, kFromDynamic, {{-3, 4, 5, 7}, {0, 0, 0, 1}}));
    edits.edits.push_back(edit(Label::unknown, kFromStatic, {{25'000'000, -1, 2, 2}}));
    edits.edits.back().scans = {3, 9};
    return edits;
}

std::string error_of(const std::string& text) {
    try {
        parse_edits(text, "edits.json");
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

TEST(Edits, ReadBackAsWritten) {
    const Edits edits = some(), read = parse_edits(text_of(edits), "edits.json");
    EXPECT_EQ(read.cell_size, edits.cell_size);
    EXPECT_EQ(read.edits, edits.edits);
    EXPECT_EQ(text_of(read), text_of(edits));
}

TEST(Edits, DamagedFilesAreRefusedWithTheirPlace) {
    const std::string good = text_of(some());
    for (std::size_t n = 0; n + 2 < good.size(); n += 7) {
        EXPECT_NE(error_of(good.substr(0, n)), "") << n;
    }
    const auto with = [&](const std::string& from, const std::string& to) {
        std::string text = good;
        text.replace(text.find(from), from.size(), to);
        return error_of(text);
    };
    EXPECT_NE(with("\"version\": 1", "\"version\": 2").find("is of version 2"), std::string::npos);
    EXPECT_NE(with("0.2", "-1").find("cell_size"), std::string::npos);
    EXPECT_NE(with("\"label\":\"static\"", "\"label\":\"moving\"").find("edit 1"),
              std::string::npos);
    EXPECT_NE(with("[3,9]", "[9,3]").find("edit 2"), std::string::npos);
    EXPECT_NE(with("-3,4,5,7", "-3,4,5").find("x, y, z, count"), std::string::npos);
    EXPECT_NE(with("-3,4,5,7", "-3,4,5,0").find("whole number"), std::string::npos);
    EXPECT_NE(with("-3,4,5,7", "-3,4.5,5,7").find("whole number"), std::string::npos);
    EXPECT_NE(with("-3,4,5,7", "18446744073709551615,4,5,7").find("whole number"),
              std::string::npos);
    EXPECT_EQ(error_of(good), "");
}

TEST(EditLookup, ChangesOnlyTheVerdictThatWasChosenFrom) {
    const EditLookup lookup(some());
    const Eigen::Vector3d in(-0.5, 0.9, 1.1), beside(0.9, 0.9, 1.1);
    EXPECT_EQ(lookup.label_of(in, Label::dynamic, 0), Label::static_);
    EXPECT_EQ(lookup.label_of(in, Label::unknown, 0), Label::unknown);
    EXPECT_EQ(lookup.label_of(beside, Label::dynamic, 0), Label::dynamic);
    EXPECT_EQ(lookup.label_of({NAN, 0, 0}, Label::dynamic, 0), Label::dynamic);
    EXPECT_EQ(lookup.label_of({1e300, 0, 0}, Label::dynamic, 0), Label::dynamic);
}

TEST(EditLookup, TheLastEditHoldsWhereItsScansReach) {
    Edits edits{1.0, {}};
    edits.edits = {edit(Label::static_, kFromDynamic, {{0, 0, 0, 2}}),
                   edit(Label::unknown, kFromDynamic, {{0, 0, 0, 1}}),
                   edit(Label::dynamic, kFromDynamic, {{0, 0, 0, 1}})};
    edits.edits.back().scans = {5, 6};
    const EditLookup lookup(edits);
    const Eigen::Vector3d first(0.5, 0.5, 0.5), second(1.5, 0.5, 0.5);
    EXPECT_EQ(lookup.label_of(first, Label::dynamic, 4), Label::unknown);
    EXPECT_EQ(lookup.label_of(first, Label::dynamic, 5), Label::dynamic);
    EXPECT_EQ(lookup.label_of(first, Label::dynamic, 7), Label::unknown);
    EXPECT_EQ(lookup.label_of(second, Label::dynamic, 5), Label::static_);
}

TEST(EditLookup, TenThousandEditsAreQuick) {
    Edits edits{0.2, {}};
    std::mt19937 random(1);
    const auto at = [&] { return static_cast<std::int32_t>(random() % 1000); };
    for (int i = 0; i < 10'000; ++i) {
        std::vector<CellRun> runs(20);
        for (CellRun& run : runs) run = {at(), at(), at() % 20, 5};
        edits.edits.push_back(edit(Label::static_, kFromDynamic, runs));
    }
    const auto began = std::chrono::steady_clock::now();
    const EditLookup lookup(parse_edits(text_of(edits), "edits.json"));
    std::size_t changed = 0;
    for (int i = 0; i < 1'000'000; ++i) {
        const Eigen::Vector3d place(0.2 * at(), 0.2 * at(), 0.2 * (at() % 20));
        if (lookup.label_of(place, Label::dynamic, 0) == Label::static_) ++changed;
    }
    EXPECT_GT(changed, 10'000U);
    EXPECT_LT(std::chrono::steady_clock::now() - began, std::chrono::seconds(20));
}

TEST(MapGaps, ReadBackAsWritten) {
    const test::TemporaryFolder folder;
    const Points points{Point(1, 0, 0), Point::Zero(), Point(NAN, 0, 0), Point(2, 0, 0),
                        Point::Zero()};
    const std::vector<Gaps> gaps{gaps_of(points), {}};
    EXPECT_EQ(gaps.front(), (Gaps{{1, 2}, {4, 1}}));
    write_gaps(folder.path(), gaps);
    EXPECT_EQ(read_gaps(folder.path()), gaps);
    const std::string bytes = test::slurp(folder / kGapsFile);
    test::spill(folder / kGapsFile, bytes.substr(0, bytes.size() - 6));
    EXPECT_THROW(read_gaps(folder.path()), InputError);
}

TEST(ApplyEdits, AFolderThatIsNoRunIsRefused) {
    const test::TemporaryFolder folder;
    EXPECT_THROW(apply_edits(folder.path(), some(), false), InputError);
    EXPECT_THROW(EditServer{folder.path()}, InputError);
}

}  // namespace edits_test
}  // namespace dynamic_filter::app
