// SPDX-License-Identifier: MIT
#include "run/evidence_file.hpp"

#include <gtest/gtest.h>

#include "dynamic_filter/file.hpp"
#include "support/random.hpp"
#include "support/temporary_folder.hpp"

namespace dynamic_filter::app {
namespace evidence_file_test {

TileEvidence some_evidence() {
    test::Random random(1);
    TileEvidence evidence;
    for (int i = 0; i < 3000; ++i) {
        evidence.filter.push_back(static_cast<std::byte>(random.below(4)));
    }
    evidence.seen.emplace(3);
    evidence.seen->add({2, 5}, {0, 4});
    evidence.of_filter.still = 5;
    evidence.of_all.still = 8;
    evidence.of_all.high = {1.0, 1e7 + 0.1, -3.0};
    evidence.of_all.map_mark = "17 abcdef";
    return evidence;
}

TEST(EvidenceFile, GivesBackWhatWasWritten) {
    const test::TemporaryFolder folder;
    const std::filesystem::path file = folder / "a.evidence";
    write_evidence(file, some_evidence(), "mark");
    EXPECT_LT(std::filesystem::file_size(file), 2000U);  // packed
    const auto found = read_evidence(file, "mark");
    ASSERT_TRUE(found);
    EXPECT_EQ(found->filter, some_evidence().filter);
    ASSERT_TRUE(found->seen);
    EXPECT_EQ(found->seen->words(), 1U);
    EXPECT_EQ(found->seen->drives(4, 0), 4U);
    EXPECT_EQ(found->seen->voxels(), 2U);
    EXPECT_EQ(found->of_filter.still, 5U);
    EXPECT_EQ(found->of_all.high, some_evidence().of_all.high);
    EXPECT_EQ(found->of_all.map_mark, "17 abcdef");
}

TEST(EvidenceFile, WithoutScansBeforeAJumpThereIsNoneOfAFilter) {
    const test::TemporaryFolder folder;
    write_evidence(folder / "a.evidence", {}, "mark");
    const auto found = read_evidence(folder / "a.evidence", "mark");
    ASSERT_TRUE(found);
    EXPECT_FALSE(found->seen);
    EXPECT_TRUE(found->filter.empty());
}

TEST(EvidenceFile, WhatIsMissingOfOtherDrivesOrDamagedIsNotUsed) {
    const test::TemporaryFolder folder;
    const std::filesystem::path file = folder / "a.evidence";
    EXPECT_FALSE(read_evidence(file, "mark"));
    write_evidence(file, some_evidence(), "mark");
    EXPECT_FALSE(read_evidence(file, "another mark"));
    const std::string bytes = io::read_file(file);
    for (std::size_t at = 0; at < bytes.size(); at += 7) {
        std::string spoilt = bytes;
        spoilt[at] = static_cast<char>(spoilt[at] ^ 4);
        io::write_file(file, spoilt);
        EXPECT_FALSE(read_evidence(file, "mark")) << at;
    }
    io::write_file(file, bytes.substr(0, bytes.size() / 2));
    EXPECT_FALSE(read_evidence(file, "mark"));
}

}  // namespace evidence_file_test
}  // namespace dynamic_filter::app
