// SPDX-License-Identifier: MIT
#include "run/label_store.hpp"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>

#include "dynamic_filter/error.hpp"
#include "support/random.hpp"
#include "support/temporary_folder.hpp"

namespace dynamic_filter::app {
namespace label_store_test {

TEST(LabelStore, GivesBackWhatWasPutInAnyOrder) {
    const test::TemporaryFolder folder;
    LabelStore store(folder.path());
    test::Random random(3);
    std::vector<Labels> put;
    for (const std::size_t count : {0U, 1U, 2U, 3U, 4U, 5U, 1001U}) {
        Labels labels(count);
        for (Label& label : labels) {
            label = std::array{Label::unknown, Label::static_, Label::dynamic}[random.below(3)];
        }
        store.put(2 * put.size(), labels);
        put.push_back(labels);
    }
    for (std::size_t i = put.size(); i-- > 0;) EXPECT_EQ(store.get(2 * i), put[i]) << i;
    EXPECT_TRUE(store.get(1).empty());
}

TEST(LabelStore, LeavesNothingInTheFolder) {
    const test::TemporaryFolder folder;
    LabelStore store(folder.path());
    store.put(0, Labels(100, Label::dynamic));
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(LabelStore, NamesAFolderThatCannotHoldAFile) {
    LabelStore store("/proc");
    EXPECT_THROW(store.put(0, Labels(1)), OutputError);
}

}  // namespace label_store_test
}  // namespace dynamic_filter::app
